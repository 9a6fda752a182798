// SPDX-License-Identifier: GPL-2.0-or-later
//
// Fields that frames of the trajectory show where a scene asks for them: [output] fields.
#ifndef SOLIDEM_ENGINE_FRAME_FIELDS_HPP
#define SOLIDEM_ENGINE_FRAME_FIELDS_HPP

#include <string>
#include <vector>

#include "effects/effect.hpp"

namespace solidem {

class Simulation;

/// A field by its name.
struct FieldName {
  std::string name;
  std::string meaning;  ///< with its components and their unit
};

/// All that a scene may ask for.
const std::vector<FieldName>& frame_field_names();

/// Works out fields of a simulation.
class FrameFields {
 public:
  /// A field at one instant.
  struct Values {
    std::string name;
    int components;
    std::vector<double> values;  ///< all of an element, or bond, side by side
    bool of_bonds;
  };

  /// `names`: of frame_field_names(). Throws InputError where the simulation has not what one of
  /// them shows.
  FrameFields(const Simulation& simulation, std::vector<std::string> names);

  /// The fields now. `frame`: what the effects show, and the bonds that it draws.
  std::vector<Values> of_now(const Frame& frame) const;

 private:
  const Simulation& simulation_;
  std::vector<std::string> names_;
};

}  // namespace solidem

#endif
