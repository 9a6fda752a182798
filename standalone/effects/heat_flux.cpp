// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_flux.hpp"

namespace solidem {

void HeatFlux::powers(double time, const double* /*temperature*/,
                      std::vector<ElementValue>& powers) const {
  const double flux = flux_(time);
  for (const WallFace& face : faces_) powers.push_back({face.element, flux * face.area});
}

}  // namespace solidem
