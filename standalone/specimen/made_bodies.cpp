// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/made_bodies.hpp"

namespace solidem {

Specimen made_alone(const Specimen& specimen, std::size_t body) {
  const PlacedOutline& place = specimen.outline->bodies[body];
  Specimen alone;
  alone.domain = place.domain;
  alone.outline = place.outline;
  alone.contact_margin = specimen.contact_margin;
  for (const std::int32_t element : specimen.bodies[body].elements) {
    const auto i = static_cast<std::size_t>(element);
    alone.position.push_back(place.from_place(specimen.position[i]));
    alone.radius.push_back(specimen.radius[i]);
  }
  return alone;
}

bool bodies_are_known(const Specimen& specimen) {
  return specimen.bodies.empty() ||
         (specimen.outline != nullptr && specimen.outline->bodies.size() == specimen.bodies.size());
}

std::vector<Wall> walls_of_shapes(const Specimen& specimen) {
  std::vector<Wall> walls;
  if (!bodies_are_known(specimen)) return walls;
  for_each_made_body(specimen, [&](const MadeBody& made) {
    for (Wall wall : walls_of_shape(made.specimen.domain)) {
      wall.name = made.wall(wall.name);
      if (made.place != nullptr) {
        wall.point = made.place->to_place(wall.point);
        wall.direction = rotate(made.place->turned, wall.direction);
      }
      walls.push_back(std::move(wall));
    }
  });
  return walls;
}

}  // namespace solidem
