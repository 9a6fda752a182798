// SPDX-License-Identifier: GPL-2.0-or-later
//
// A law of central force between two elements, sampled: what `solidem law plot` shows.
#ifndef SOLIDEM_APP_LAW_CURVE_HPP
#define SOLIDEM_APP_LAW_CURVE_HPP

#include <string>
#include <vector>

#include "laws/central_laws.hpp"

namespace solidem {

/// A law as it acts between two elements.
struct ShownLaw {
  std::string label;
  CentralLaw law;
  double equilibrium = 3e-4;      ///< δ_eq = R_i + R_j, m
  double range = 1.2;             ///< α: δ_lim = α δ_eq
  double interpenetration = 0.1;  ///< a: below (1 − a) δ_eq the law goes on with its tangent
};

/// Which of the expressions of central_interaction.hpp holds.
enum class LawPart { continuation, law, beyond };
const char* name_of(LawPart part);

struct LawPoint {
  double distance;   ///< δ, m
  double force;      ///< F, N
  double stiffness;  ///< −dF/dδ, N/m
  double potential;  ///< J, none beyond the range
  LawPart part;
};

/// The law at a distance, m, from 0.
LawPoint law_at(const ShownLaw& shown, double distance);

/// From one distance over that of equilibrium to another: `count` distances alike, and both sides
/// of the places where one part follows another.
std::vector<LawPoint> sample(const ShownLaw& shown, double from, double to, int count);

/// What one wants to know of a law before a run.
struct LawFigures {
  double stiffness;            ///< at δ_eq, N/m
  double attraction;           ///< the largest within the range, N
  double attraction_distance;  ///< the least at which it acts, m
  double end_force;            ///< where the range ends, N: F jumps from it to none
  double well;                 ///< −Φ(δ_eq), J
  double deepest_force;        ///< at (1 − a) δ_eq, N
  double deepest_stiffness;    ///< there, N/m: the time step follows from it
};
LawFigures figures_of(const ShownLaw& shown);

}  // namespace solidem

#endif
