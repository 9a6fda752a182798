// SPDX-License-Identifier: GPL-2.0-or-later
//
// The bodies of a specimen one by one, each where it was made: before it was turned and moved.
#ifndef SOLIDEM_SPECIMEN_MADE_BODIES_HPP
#define SOLIDEM_SPECIMEN_MADE_BODIES_HPP

#include <string>
#include <vector>

#include "model/error.hpp"
#include "model/outline.hpp"
#include "specimen/walls.hpp"

namespace solidem {

/// One of several bodies where it was made; or the only one.
struct MadeBody {
  const Specimen& specimen;  ///< its elements alone, without bonds
  const Body* body;          ///< null: the only one
  const PlacedOutline* place;

  /// The number of an element in the whole specimen, and the name of a wall there: "body.wall".
  std::int32_t element(std::int32_t own) const {
    return body == nullptr ? own : body->elements[static_cast<std::size_t>(own)];
  }
  std::string wall(const std::string& own) const {
    return body == nullptr ? own : body->name + "." + own;
  }
  /// Where a point is, given from the centre of an element where the body was made.
  Vector at(const Specimen& whole, std::int32_t own, const Vector& from_centre) const {
    return whole.position[static_cast<std::size_t>(element(own))] +
           (place == nullptr ? from_centre : rotate(place->turned, from_centre));
  }
};

/// One of several bodies alone, where it was made.
Specimen made_alone(const Specimen& specimen, std::size_t body);

/// Whether it is known how each of several bodies was made and placed; true of a single one.
bool bodies_are_known(const Specimen& specimen);

/// Calls visit(const MadeBody&) for each body. What that throws says which body it is about. For a
/// specimen whose bodies are known.
template <class Visit>
void for_each_made_body(const Specimen& specimen, const Visit& visit) {
  if (specimen.bodies.empty()) return visit(MadeBody{specimen, nullptr, nullptr});
  for (std::size_t b = 0; b < specimen.bodies.size(); ++b) {
    const Body& body = specimen.bodies[b];
    const std::string where = "body \"" + body.name + "\", where it was made: ";
    const Specimen alone = made_alone(specimen, b);
    try {
      visit(MadeBody{alone, &body, &specimen.outline->bodies[b]});
    } catch (const InputError& error) {
      throw InputError(where + error.what());
    } catch (const RunError& error) {
      throw RunError(where + error.what());
    }
  }
}

/// The walls of the shapes of all bodies, cut or not, at their places.
std::vector<Wall> walls_of_shapes(const Specimen& specimen);

}  // namespace solidem

#endif
