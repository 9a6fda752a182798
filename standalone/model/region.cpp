// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/region.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "model/error.hpp"
#include "model/periodic_image.hpp"

namespace solidem {

namespace {

bool inside(const Vector& p, const Vector& lower, const Vector& upper) {
  return lower.x <= p.x && p.x <= upper.x && lower.y <= p.y && p.y <= upper.y && lower.z <= p.z &&
         p.z <= upper.z;
}

std::string known_sets(const Specimen& specimen) {
  if (specimen.sets.empty()) return "the specimen has no sets";
  std::string names = "the specimen's sets are";
  for (const auto& [name, elements] : specimen.sets) names += " " + name;
  return names;
}

/// The body of a name.
const Body& body_called(const std::string& name, const Specimen& specimen) {
  std::string known;
  for (const Body& body : specimen.bodies) {
    if (body.name == name) return body;
    known += (known.empty() ? "" : ", ") + body.name;
  }
  throw InputError("no body \"" + name + "\": " +
                   (known.empty() ? "the specimen is one body without a name"
                                  : "the specimen's bodies are " + known));
}

/// What a region of a body needs to know of the rest: that body as if it were alone.
Specimen alone(const Body& body, const Specimen& specimen) {
  Specimen part;
  for (const std::int32_t element : body.elements) {
    part.position.push_back(specimen.position[static_cast<std::size_t>(element)]);
    part.radius.push_back(specimen.radius[static_cast<std::size_t>(element)]);
  }
  part.domain.lower = body.lower;
  part.domain.upper = body.upper;
  return part;
}

}  // namespace

std::vector<std::int32_t> select(const Region& region, const Specimen& specimen) {
  if (!region.body.empty()) {
    const Body& body = body_called(region.body, specimen);
    Region there = region;
    there.body.clear();
    std::vector<std::int32_t> elements = select(there, alone(body, specimen));
    for (std::int32_t& element : elements)
      element = body.elements[static_cast<std::size_t>(element)];
    return elements;
  }
  if (region.kind == Region::Kind::set) {
    const auto found = specimen.sets.find(region.set);
    if (found == specimen.sets.end())
      throw InputError("no set \"" + region.set + "\": " + known_sets(specimen));
    return found->second;
  }
  const Domain& domain = specimen.domain;
  const double depth = region.layers > 0 ? region.layers * 2 * mean_radius(specimen) : region.depth;
  const double low = component(domain.lower, region.axis);
  const double high = component(domain.upper, region.axis);
  std::vector<std::int32_t> elements;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    const double along = component(p, region.axis);
    const bool chosen = region.kind == Region::Kind::all ? true
                        : region.kind == Region::Kind::box
                            ? inside(p, region.lower, region.upper)
                            : (region.high_side ? high - along : along - low) <= depth;
    if (chosen) elements.push_back(static_cast<std::int32_t>(i));
  }
  return elements;
}

std::vector<std::int32_t> elements_of_the_body(const std::vector<std::int32_t>& neighbours) {
  std::vector<std::int32_t> all(neighbours.size()), joined;
  std::iota(all.begin(), all.end(), 0);
  std::copy_if(all.begin(), all.end(), std::back_inserter(joined),
               [&](std::int32_t e) { return neighbours[static_cast<std::size_t>(e)] > 0; });
  return joined.empty() ? all : joined;
}

std::int32_t nearest_element(const Specimen& specimen, const std::vector<std::int32_t>& elements,
                             const Vector& point) {
  std::int32_t best = 0;
  double least = Region::infinity;
  for (const std::int32_t e : elements) {
    const Vector d =
        to_nearest_image(specimen.domain, specimen.position[static_cast<std::size_t>(e)] - point);
    if (dot(d, d) < least) {
      least = dot(d, d);
      best = e;
    }
  }
  return best;
}

}  // namespace solidem
