// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/body_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "specimen/report.hpp"
#include "specimen/shape.hpp"

namespace solidem {

namespace {

constexpr double least_margin = 1e-12, largest_margin = 1e-3;

std::string line(const char* key, const std::string& value) {
  return fmt::format("# solidem {} {}\n", key, value);
}

std::string numbers(const Vector& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x, v.y, v.z);
}

// What one comment says; its first words are "solidem" and the key.
void read_line(const TextLines& comment, Domain& domain) {
  const auto& words = comment.words();
  const std::string_view key = words.size() > 1 ? words[1] : std::string_view{};
  const auto insist = [&](std::size_t values, const char* what) {
    if (words.size() != values + 2) comment.fail(fmt::format("solidem {}: expected {}", key, what));
  };
  const auto axis_of = [&](std::size_t word) {
    if (words[word] != "x" && words[word] != "y" && words[word] != "z")
      comment.fail(fmt::format("solidem {} {}: expected x, y or z", key, words[word]));
    return words[word][0] - 'x';
  };
  if (key == "shape") {
    insist(1, "the name of a shape");
    domain.shape = std::string(words[2]);
  } else if (key == "lower" || key == "upper") {
    insist(3, "three numbers");
    (key == "lower" ? domain.lower : domain.upper) = {comment.number(2), comment.number(3),
                                                      comment.number(4)};
  } else if (key == "periodic") {
    for (std::size_t k = 2; k < words.size(); ++k)
      domain.periodic[static_cast<std::size_t>(axis_of(k))] = true;
  } else if (key == "axis") {
    insist(1, "x, y or z");
    domain.axis = axis_of(2);
  } else if (key == "cuts") {
    insist(1, "a number");
    domain.cuts = static_cast<int>(comment.number(2));
  } else if (key == "volume" || key == "radius" || key == "inner_radius" || key == "angle") {
    insist(1, "a number");
    (key == "volume"         ? domain.volume
     : key == "radius"       ? domain.radius
     : key == "inner_radius" ? domain.inner_radius
                             : domain.angle) = comment.number(2);
  } else {
    comment.fail(
        fmt::format("solidem \"{}\": expected shape, lower, upper, periodic, volume, axis, "
                    "radius, inner_radius, angle or cuts",
                    key));
  }
}

}  // namespace

std::string body_lines(const Specimen& specimen) {
  const Domain& body = specimen.domain;
  const bool is_estimated = specimen.report.count(estimated_volume) != 0;
  std::string text;
  if (body.shape == "imported" && is_estimated && !body.is_periodic()) return text;
  text += line("shape", body.shape) + line("lower", numbers(body.lower)) +
          line("upper", numbers(body.upper));
  if (!is_estimated) text += line("volume", fmt::format("{:.17g}", body.volume));
  std::string periodic;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (body.periodic[axis]) periodic += std::string(periodic.empty() ? "" : " ") + "xyz"[axis];
  if (!periodic.empty()) text += line("periodic", periodic);
  if (body.axis >= 0) text += line("axis", std::string(1, "xyz"[body.axis]));
  if (body.radius > 0) text += line("radius", fmt::format("{:.17g}", body.radius));
  if (body.inner_radius > 0)
    text += line("inner_radius", fmt::format("{:.17g}", body.inner_radius));
  if (body.cuts > 0) text += line("cuts", fmt::format("{}", body.cuts));
  if (body.angle > 0) text += line("angle", fmt::format("{:.17g}", body.angle));
  return text;
}

void read_body_lines(const std::string& text, const std::string& path, Domain& domain) {
  TextLines comments(text, path);
  while (comments.next_comment())
    if (comments.words()[0] == "solidem") read_line(comments, domain);
}

void put_in_box(Specimen& specimen) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vector lower{far, far, far}, upper{-far, -far, -far};
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    const double r = specimen.radius[i];
    lower = {std::min(lower.x, p.x - r), std::min(lower.y, p.y - r), std::min(lower.z, p.z - r)};
    upper = {std::max(upper.x, p.x + r), std::max(upper.y, p.y + r), std::max(upper.z, p.z + r)};
  }
  specimen.domain.shape = "imported";
  specimen.domain.lower = lower;
  specimen.domain.upper = upper;
}

double largest_coordinate(const Specimen& specimen) {
  double largest = 0;
  for (const Vector& p : specimen.position)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

double contact_margin(double round_off, const Specimen& specimen) {
  const double smallest = *std::min_element(specimen.radius.begin(), specimen.radius.end());
  // Two centres, each off by this much along each axis, and two radii.
  return std::clamp(4.0 * round_off / (2.0 * smallest), least_margin, largest_margin);
}

double contact_margin(const DecimalPrecision& precision, const Specimen& specimen) {
  return contact_margin(precision.round_off(largest_coordinate(specimen)), specimen);
}

}  // namespace solidem
