// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/conduction_parameters.hpp"

namespace solidem {

const char* name_of(ConductionParameters::Law law) {
  switch (law) {
    case ConductionParameters::Law::platonic:
      return "platonic";
    case ConductionParameters::Law::platonic_calibrated:
      return "platonic-calibrated";
    case ConductionParameters::Law::voronoi:
      break;
  }
  return "voronoi";
}

const char* name_of(ConductionParameters::Integrator integrator) {
  switch (integrator) {
    case ConductionParameters::Integrator::explicit_euler:
      return "explicit";
    case ConductionParameters::Integrator::rkl2:
      return "rkl2";
    case ConductionParameters::Integrator::implicit:
      return "implicit";
    case ConductionParameters::Integrator::automatic:
      break;
  }
  return "auto";
}

}  // namespace solidem
