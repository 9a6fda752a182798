// SPDX-License-Identifier: GPL-2.0-or-later
//
// The keys of a shape that may move: what it is, where it starts, how it moves.
#ifndef SOLIDEM_EFFECTS_MOVING_SHAPE_HPP
#define SOLIDEM_EFFECTS_MOVING_SHAPE_HPP

#include <array>
#include <optional>
#include <vector>

#include "keys/section.hpp"
#include "model/shape.hpp"
#include "model/time_function.hpp"

namespace solidem {

/// A path as it is read: a start and a velocity, or a table.
struct ReadPath {
  Vector centre{}, velocity{};
  std::array<TimeFunction, 3> table;
};

/// A shape of one part or several.
Rule shape(std::optional<Shape>& target);

/// The keys centre, velocity and path.
std::vector<Key> path_keys(ReadPath& path);

/// The names of those keys.
const std::vector<std::string>& path_key_names();

/// What those keys say; refuses those that do not go together.
std::array<TimeFunction, 3> finish_path(const Section& section, const ReadPath& path);

}  // namespace solidem

#endif
