// SPDX-License-Identifier: GPL-2.0-or-later
//
// How laws of yield and of rupture of bonds describe their parameters. All limits are stresses over
// Young's modulus E of the beam, so that a law knows strains alone; whoever reads a law (a scene, a
// bond style) may take a parameter as a stress as well.
#ifndef SOLIDEM_LAWS_BOND_LAW_HPP
#define SOLIDEM_LAWS_BOND_LAW_HPP

#include <cmath>
#include <cstddef>

namespace solidem {

/// The values that make sense.
enum class LawBound { above_zero, from_zero };

/// What a parameter is that is no stress.
enum class LawUnit { number, temperature, rate };

/// A parameter of a law, as a scene, a bond style or a script names it.
template <class Law>
struct BondLawParameter {
  const char* name;         ///< of the number
  const char* stress_name;  ///< of the same times E, Pa; null: it is not a stress over E
  double Law::*member;
  LawBound bound;
  bool is_required;  ///< otherwise a law without it has the initial value of the member
  const char* meaning;
  LawUnit unit = LawUnit::number;  ///< K or 1/s

  constexpr bool allows(double value) const {
    return bound == LawBound::above_zero ? value > 0 : value >= 0;
  }
};

/// One of several choices and its name.
template <class Choice>
struct NamedChoice {
  const char* name;
  Choice choice;
};

/// The name of one.
template <class Choice, std::size_t count>
constexpr const char* name_in(const NamedChoice<Choice> (&table)[count], Choice choice) {
  for (const auto& named : table)
    if (named.choice == choice) return named.name;
  return "";
}

/// Where along a beam its bending is judged: its bending moment goes linearly from end to end.
enum class JudgedSection {
  middle,  ///< at mid-length, where shear with held rotations bends nothing
  ends,    ///< at the end that is bent more
  worst    ///< wherever it is largest
};

/// What scenes and bond styles call them.
inline constexpr NamedChoice<JudgedSection> judged_sections[] = {{"middle", JudgedSection::middle},
                                                                 {"ends", JudgedSection::ends},
                                                                 {"worst", JudgedSection::worst}};

/// The strains of a bond, each a stress in the judged section over E: elastic, but for the plastic
/// one.
template <class Real>
struct BondStrain {
  Real equivalent;  ///< σ_e / E
  Real plastic;     ///< κ
  Real normal;      ///< of F_x / S, above 0 in tension
  Real bending;     ///< at the edge of the section, never negative
  Real twist;       ///< τ / E at the edge of the section, of either sign
};

}  // namespace solidem

#endif
