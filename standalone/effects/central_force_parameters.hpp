// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a scene may ask of central forces and their damage: plain data in SI units, filled by the
// scene reader and read by the effects.
#ifndef SOLIDEM_EFFECTS_CENTRAL_FORCE_PARAMETERS_HPP
#define SOLIDEM_EFFECTS_CENTRAL_FORCE_PARAMETERS_HPP

#include <cstdint>
#include <optional>

#include "laws/central_laws.hpp"

namespace solidem {

/// Central forces between elements.
struct CentralForceParameters {
  enum class Equilibrium {
    initial,  ///< neighbours at the start keep the distance they had
    radii     ///< R_i + R_j
  };
  enum class Neighbours {
    changing,  ///< whoever is within range
    fixed      ///< those of the start, while within range
  };
  CentralLaw law;
  double range = 0;  ///< α: elements nearer than α (R_i + R_j) act on each other
  Equilibrium equilibrium = Equilibrium::initial;
  Neighbours neighbours = Neighbours::changing;
  double interpenetration = 0.1;      ///< a: deepest overlap, of the equilibrium distance, that the
                                      ///< time step allows for
  std::optional<double> dissipation;  ///< c, N·s/m
  std::optional<double> skin;         ///< of the lists of neighbours, mean radii; none: chosen as
                                      ///< elements move
  double bond_tolerance = 0;  ///< t: neighbours at the start are nearer than (1 + t)(R_i + R_j)

  /// Whether pairs of the start rest at the distance they had then.
  bool remembers_distances() const { return equilibrium == Equilibrium::initial; }
  bool neighbours_change() const { return neighbours == Neighbours::changing; }
};

/// Micro-cracks between elements, and elements that have lost their hold.
struct DamageParameters {
  std::optional<double> crack_threshold;  ///< C
  std::int64_t every = 1;                 ///< steps between two looks for crack faces
  int minimal_neighbours = 0;             ///< elements that keep fewer within range are removed
  std::int64_t removal_every = 100;       ///< steps between two such looks
  bool leaves_out_free_faces = false;     ///< faces of the start are none of cracks
  std::optional<double> range{};          ///< α, of beams; none: 1.2
};

/// As a scene spells them.
const char* name_of(CentralForceParameters::Equilibrium equilibrium);
const char* name_of(CentralForceParameters::Neighbours neighbours);

}  // namespace solidem

#endif
