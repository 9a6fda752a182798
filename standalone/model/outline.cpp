// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/outline.hpp"

#include <algorithm>
#include <cmath>

namespace solidem {

double Cut::distance(const Vector& point) const {
  if (mesh != nullptr) return std::max(0.0, mesh->signed_distance(point));
  Vector local = rotate(conjugate(turned), point - part.offset);
  if (part.kind == Shape::Kind::sphere) return std::max(0.0, norm(local) - part.radius);
  for (int k = 0; k < 3; ++k) {
    if (part.kind == Shape::Kind::cylinder && k != part.axis) continue;
    const double half =
        part.kind == Shape::Kind::box ? 0.5 * component(part.size, k) : 0.5 * part.length;
    component(local, k) = std::max(0.0, std::abs(component(local, k)) - half);
  }
  if (part.kind == Shape::Kind::box) return norm(local);
  const double beyond = component(local, part.axis);
  component(local, part.axis) = 0;
  return std::hypot(beyond, std::max(0.0, norm(local) - part.radius));
}

bool Outline::holds(const Vector& point) const {
  if (surface != nullptr && !surface->contains(point)) return false;
  return std::all_of(cuts.begin(), cuts.end(),
                     [&](const Cut& cut) { return cut.distance(point) > 0; });
}

}  // namespace solidem
