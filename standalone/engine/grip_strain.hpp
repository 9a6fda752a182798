// SPDX-License-Identifier: GPL-2.0-or-later
//
// What the grips of a scene will do to its body, before anything runs.
#ifndef SOLIDEM_ENGINE_GRIP_STRAIN_HPP
#define SOLIDEM_ENGINE_GRIP_STRAIN_HPP

#include <string>
#include <vector>

#include "engine/simulation.hpp"
#include "laws/rupture_law.hpp"

namespace solidem {

/// A strain that two grips impose, as if it spread evenly over the body between them.
struct NominalStrain {
  double size = 0;           ///< of the stretch along the line between them, or half the shear
  double time = 0;           ///< s, at which it is reached
  bool is_pressure = false;  ///< they approach each other
  std::string first, second;
  Vector middle;     ///< between the grips at rest, m
  Vector direction;  ///< from the first to the second, unit length
  Vector gradient;   ///< of the displacement along it

  /// Displacement of a place, were the body strained evenly, m.
  Vector displacement_at(const Vector& place) const {
    return dot(place - middle, direction) * gradient;
  }
};

/// Strains of a bond, or of a pair under central forces, that is pulled along itself.
struct PairLimits {
  double yield = unlimited;    ///< it flows, or attraction is at its largest
  double rupture = unlimited;  ///< it breaks, or is out of range
};

struct StrainForecast {
  NominalStrain strain;  ///< the largest at any time of the run
  double alignment = 1;  ///< strain of the bond that lies most along it, over the strain
  PairLimits limits;
  double flowing_share = 0;          ///< of the run, in which bonds will flow
  std::vector<std::string> sayings;  ///< the forecast in words, a sentence each
};

/// Of a simulation of so long, s.
StrainForecast foretell_strain(const Simulation& simulation, double duration);

}  // namespace solidem

#endif
