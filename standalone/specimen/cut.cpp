// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/error.hpp"
#include "specimen/mesh_walls.hpp"

namespace solidem {

namespace {

constexpr double least_volume = 1e-9;  // that a cut takes, of the body's

// Half of the extent of a part along a direction of its own axes.
double half_extent(const Shape::Part& part, int axis) {
  if (part.kind == Shape::Kind::box) return 0.5 * component(part.size, axis);
  const bool is_length = part.kind == Shape::Kind::cylinder && axis == part.axis;
  return is_length ? 0.5 * part.length : part.radius;
}

// Half of the extent of a turned part along an axis of the world; of a box that holds it.
double half_extent(const Cut& cut, int axis) {
  if (cut.mesh != nullptr) {
    const auto [lower, upper] = bounds(cut.mesh->mesh());
    return 0.5 * component(upper - lower, axis);
  }
  Vector unit{};
  component(unit, axis) = 1;
  const Vector local = rotate(conjugate(cut.turned), unit);
  double half = 0;
  for (int k = 0; k < 3; ++k)
    if (component(local, k) != 0) half += std::abs(component(local, k)) * half_extent(cut.part, k);
  return half;
}

Vector middle_of(const Cut& cut) {
  if (cut.mesh == nullptr) return cut.part.offset;
  const auto [lower, upper] = bounds(cut.mesh->mesh());
  return 0.5 * (lower + upper);
}

std::string called(std::size_t number) {
  return fmt::format("[specimen] cut {}", number + 1);
}

void check_sides(const Domain& body, const Cut& cut, std::size_t number) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!body.periodic[static_cast<std::size_t>(axis)]) continue;
    const double low = component(body.lower, axis), high = component(body.upper, axis);
    const double middle = component(middle_of(cut), axis), half = half_extent(cut, axis);
    const bool lies_within = middle - half >= low && middle + half <= high;
    if (!lies_within && std::isfinite(half))
      throw InputError(fmt::format(
          "{}: it reaches from {:.6g} to {:.6g} m along {}, along which the body repeats itself "
          "from {:.6g} to {:.6g} m: expected a cut within the period, or a cylinder without length",
          called(number), middle - half, middle + half, "xyz"[axis], low, high));
  }
}

// What two meshes share would count twice.
void check_meshes_apart(const std::vector<Cut>& cuts) {
  for (std::size_t k = 0; k < cuts.size(); ++k)
    for (std::size_t other = 0; other < k; ++other) {
      if (cuts[k].mesh == nullptr || cuts[other].mesh == nullptr) continue;
      const auto [low, high] = bounds(cuts[k].mesh->mesh());
      const auto [from, to] = bounds(cuts[other].mesh->mesh());
      if (low.x < to.x && from.x < high.x && low.y < to.y && from.y < high.y && low.z < to.z &&
          from.z < high.z)
        throw InputError(called(other) + ": the box around its mesh overlaps that of cut " +
                         std::to_string(k + 1) +
                         ", and what both take would count twice: expected one mesh of both");
    }
}

// The volume that is left by the cuts up to each one, all of which must take something.
double checked_volume(const Domain& body, const std::vector<Cut>& cuts, const FacetTree* surface) {
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    check_sides(body, cuts[k], k);
    if (volume_left(body, {cuts[k]}, surface) < (1 - least_volume) * body.volume) continue;
    throw InputError(fmt::format(
        "{}: it lies outside of the body, which stands between ({:.6g}, {:.6g}, {:.6g}) and "
        "({:.6g}, {:.6g}, {:.6g}) m: expected one that takes something away",
        called(k), body.lower.x, body.lower.y, body.lower.z, body.upper.x, body.upper.y,
        body.upper.z));
  }
  check_meshes_apart(cuts);
  const double left = volume_left(body, cuts, surface);
  if (!(left > least_volume * body.volume))
    throw InputError("[specimen] cut: the cuts leave nothing of the body: expected smaller ones");
  return left;
}

// The narrowest way through a cut, m.
double width_of(const Cut& cut) {
  double width = std::numeric_limits<double>::infinity();
  if (cut.mesh != nullptr) return 2 * largest_inner_radius(*cut.mesh);
  for (int k = 0; k < 3; ++k) width = std::min(width, 2 * half_extent(cut.part, k));
  return width;
}

void check_width(const Cut& cut, std::size_t number, const Specimen& specimen) {
  const double widest = 2 * *std::max_element(specimen.radius.begin(), specimen.radius.end());
  if (!(width_of(cut) < widest)) return;
  throw InputError(fmt::format(
      "{}: it is {:.3g} m wide, less than an element (up to {:.3g} m), so that bonds would join "
      "what it parts: expected a wider one, or smaller elements",
      called(number), width_of(cut), widest));
}

// Which elements stay.
std::vector<bool> outside_of(const Specimen& specimen, const std::vector<Cut>& cuts) {
  std::vector<bool> stays(specimen.size(), true);
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    check_width(cuts[k], k, specimen);
    bool takes_some = false;
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      const double reach = cuts[k].takes_touched ? specimen.radius[i] : 0.0;
      if (cuts[k].distance(specimen.position[i]) > reach) continue;
      takes_some = true;
      stays[i] = false;
    }
    if (!takes_some)
      throw InputError(called(k) +
                       ": no element has its centre in it, so it would change nothing but the "
                       "volume: expected a larger one, or smaller elements");
  }
  if (std::none_of(stays.begin(), stays.end(), [](bool stay) { return stay; }))
    throw InputError(
        "[specimen] cut: no element has its centre in what the cuts leave: expected smaller cuts "
        "or smaller "
        "elements");
  return stays;
}

void keep(Specimen& specimen, const std::vector<bool>& stays) {
  std::vector<std::int32_t> number(specimen.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < stays.size(); ++i) {
    if (!stays[i]) continue;
    number[i] = static_cast<std::int32_t>(kept);
    specimen.position[kept] = specimen.position[i];
    specimen.radius[kept] = specimen.radius[i];
    ++kept;
  }
  specimen.position.resize(kept);
  specimen.radius.resize(kept);
  specimen.bonds.clear();
  for (auto& [name, elements] : specimen.sets) {
    std::vector<std::int32_t> left;
    for (const std::int32_t element : elements)
      if (number[static_cast<std::size_t>(element)] >= 0)
        left.push_back(number[static_cast<std::size_t>(element)]);
    elements = std::move(left);
  }
}

}  // namespace

void cut_out(Specimen& specimen, const std::vector<Cut>& cuts,
             std::shared_ptr<const FacetTree> surface) {
  if (cuts.empty()) return;
  Domain& body = specimen.domain;
  if (body.cuts > 0 || (surface == nullptr && !body.has_walls()))
    throw InputError("[specimen] cut: the body of the file is " +
                     (body.cuts > 0 ? std::string("cut already")
                                    : "a " + body.shape + ", of which no shape is known") +
                     ": expected a whole body of a known shape");
  const double left = checked_volume(body, cuts, surface.get());
  keep(specimen, outside_of(specimen, cuts));
  body.volume = left;
  body.cuts = static_cast<int>(cuts.size());
  specimen.outline = std::make_shared<const Outline>(Outline{std::move(surface), cuts});
}

}  // namespace solidem
