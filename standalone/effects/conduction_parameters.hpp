// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a scene may ask of heat conduction: plain data in SI units, filled by the scene reader and
// read by the effect.
#ifndef SOLIDEM_EFFECTS_CONDUCTION_PARAMETERS_HPP
#define SOLIDEM_EFFECTS_CONDUCTION_PARAMETERS_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace solidem {

/// Two materials that touch imperfectly.
struct Contact {
  std::string first, second;  ///< names of the materials
  double conductance = 0;     ///< h_c, W/(m² K)
};

/// Heat conduction between neighbouring elements.
struct ConductionParameters {
  enum class Law {
    platonic,             ///< contacts; areas and volumes of platonic solids
    platonic_calibrated,  ///< the same, scaled to the conductivity and mass of the body
    voronoi               ///< faces and volumes of radical Voronoi cells
  };
  enum class Integrator { explicit_euler, rkl2, implicit, automatic };
  enum class BrokenBonds {
    insulate,  ///< a pair whose bond broke conducts no heat any more
    conduct    ///< it goes on as before
  };
  Law law = Law::platonic;
  double initial_temperature = 0;     ///< K
  std::optional<double> area_factor;  ///< of platonic_calibrated; none: found by a steady bar test
  Integrator integrator = Integrator::explicit_euler;
  std::optional<double> tolerance;  ///< error allowed in time integration, K; none: fixed steps
  std::vector<Contact> contacts{};
  std::optional<BrokenBonds> broken_bonds;  ///< with rupture only; none: insulate
  std::int64_t every = 1;                   ///< steps of the motion from one heat step to the next
  std::optional<double> largest_change;     ///< of a temperature between two heat steps, K: their
                                            ///< number is chosen
};

/// As a scene spells them.
const char* name_of(ConductionParameters::Law law);
const char* name_of(ConductionParameters::Integrator integrator);

}  // namespace solidem

#endif
