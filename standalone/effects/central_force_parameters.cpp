// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/central_force_parameters.hpp"

namespace solidem {

const char* name_of(CentralForceParameters::Equilibrium equilibrium) {
  return equilibrium == CentralForceParameters::Equilibrium::initial ? "initial" : "radii";
}

const char* name_of(CentralForceParameters::Neighbours neighbours) {
  return neighbours == CentralForceParameters::Neighbours::changing ? "changing" : "fixed";
}

}  // namespace solidem
