// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_STATICS_STATIC_GRIPS_HPP
#define SOLIDEM_SOLVE_STATICS_STATIC_GRIPS_HPP

#include <vector>

#include "effects/grip_parameters.hpp"
#include "solve/statics/static_equilibrium.hpp"

namespace solidem {

/// What grips hold and load at one time.
struct GripConditions {
  std::vector<Constraint> constraints;
  std::vector<ElementLoad> loads;
};

/// Adds a grip as it stands at a time: displacements (a velocity's since time 0), turns held at
/// nothing where they are fixed, and forces, shared by mass. `mass` of each element of the
/// specimen, kg.
void impose(const GripParameters& grip, const std::vector<std::int32_t>& elements,
            const std::vector<double>& mass, double time, GripConditions& conditions);

/// What a grip does to the body.
struct GripAction {
  Vector force;         ///< N
  Vector moment;        ///< about the middle of its elements at rest, N·m
  Vector displacement;  ///< mean of its elements, m
};
GripAction grip_action(const std::vector<std::int32_t>& elements, const GripConditions& conditions,
                       const Specimen& specimen, const Equilibrium& equilibrium);

}  // namespace solidem

#endif
