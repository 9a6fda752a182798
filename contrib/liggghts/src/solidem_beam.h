// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_BEAM_H
#define LMP_SOLIDEM_BEAM_H

#include <stddef.h>

#include <limits>
#include <type_traits>

#include "laws/beam_flow.hpp"
#include "laws/bond_damping.hpp"
#include "laws/bond_limit.hpp"
#include "solidem_bond_memory.h"
#include "solidem_over_temperature.h"

namespace LAMMPS_NS {

/// Where the two atoms of a bond stand and how warm they are; i has the lower tag.
struct SolidemBondEnds {
  solidem::Vector3<double> chord;  ///< from i to j
  solidem::Quaternion<double> orientation_i, orientation_j;
  double radius_i, radius_j;
  double temperature_i = 0.0, temperature_j = 0.0;  ///< zero where none counts
  double time_step = 0.0;                           ///< of the motion
  double temperature() const { return 0.5 * (temperature_i + temperature_j); }
};

/// What a bond does to its atoms.
struct SolidemBondAction {
  solidem::BeamLoad<double> load = {};
  double elastic_energy = 0.0;   ///< of the beam
  double contact_energy = 0.0;   ///< of a broken bond whose atoms push each other
  double fracture_energy = 0.0;  ///< lost in this step, by rupture or by a bond made anew
  double heat_of_each = 0.0;     ///< for each of its atoms, of the flow in this step
  bool breaks = false, forms = false;
};

/// What a bond looks like to output.
struct SolidemBondFigures {
  double length;  ///< distance of the centres
  double force;   ///< tension of the beam, or minus the push of a contact
  double stress;  ///< equivalent, zero when broken
  double elastic_energy, contact_energy;
};

/// The beam of one bond type: its coefficients, and what a bond of it does in a pose. The laws are
/// those of laws/beam*.hpp and laws/contact.hpp. Plain data, written to restart files as it is.
struct SolidemBeam {
  enum Law { EULER_BERNOULLI, TIMOSHENKO, SPRING };

  static constexpr double NEVER = std::numeric_limits<double>::infinity();

  double young_modulus = 0.0, shear_modulus = 0.0;
  double radius = 0.0;  ///< of the beam; 0: `ratio` times the mean radius of its atoms
  double ratio = 0.0;
  Law law = EULER_BERNOULLI;
  double shear_coefficient = 0.9;  ///< of TIMOSHENKO
  bool flows = false;
  solidem::FlowRule flow_rule = solidem::FlowRule::radial_return;  ///< if it flows
  solidem::YieldLaw hardening;                                     ///< likewise
  solidem::JudgedSection yield_section = solidem::JudgedSection::middle;
  bool breaks = false;
  solidem::RuptureLaw rupture;  ///< if it breaks
  solidem::JudgedSection rupture_section = solidem::JudgedSection::middle;
  double contact_ratio = 0.0;  ///< stiffness of contacts over E S / l; 0: no contact
  double rebonding_pressure = NEVER;
  double damping_ratio = 0.0;  ///< critical ratio of the dashpots; 0: none
  SolidemBeamWarmth warmth;
  double rate_time = 0.0;     ///< over which the rate of flow is averaged, if that counts
  double plastic_heat = 0.0;  ///< of plastic work that becomes heat

  bool may_break() const { return breaks; }
  bool expands() const { return warmth.expansion_coefficient.is_given(); }
  bool softens() const { return warmth.modulus_ratio.is_given(); }
  bool feels_rate() const { return flows && solidem::follows_rate(hardening); }
  /// Whether the temperature of its atoms counts.
  bool follows_temperature() const {
    return expands() || softens() || (flows && solidem::follows_temperature(hardening));
  }
  bool is_offset() const { return flows && flow_rule == solidem::FlowRule::scaled_offset; }
  bool may_change() const { return flows || may_break(); }
  /// Are all bonds of this type as stiff as one another, however long they are?
  bool all_have_one_section() const { return radius > 0.0 && law != TIMOSHENKO && !softens(); }
  /// Is there a strain up to which no bond flows or breaks, seen at its middle alone?
  bool has_bound_of_limit() const {
    const solidem::JudgedSection middle = solidem::JudgedSection::middle;
    return !may_change() || (!is_offset() && yield_section == middle && rupture_section == middle);
  }
  /// Numbers of SolidemBondMemory that a bond of this type needs.
  int width() const;

  /// Makes a bond that was not yet seen: free of load in this pose.
  void make(double* memory, const SolidemBondEnds& ends) const;
  /// The bond as warm as its atoms are.
  solidem::YieldingBeam<double> beam(const double* memory, const SolidemBondEnds& ends) const;
  /// The strain up to which the bond surely neither flows nor breaks, if there is such a bound.
  double limit(const double* memory, const SolidemBondEnds& ends) const;

  /// What the bond does in the pose of this step, which is thereby accepted: the memory moves on. A
  /// second call in the same pose at the same step gives the same loads and changes nothing. A bond
  /// that breaks in a pose still acts there, but its energy is no longer elastic. `energies`:
  /// whether the elastic energy is wanted; that of a contact is always told.
  SolidemBondAction act(double* memory, const SolidemBondEnds& ends, double step,
                        bool energies) const;
  /// Whether dashpots act in the pose that the bond has just acted in, and what they do besides.
  bool damps(const double* memory) const;
  solidem::DashpotAction<double> damp(const double* memory, const SolidemBondEnds& ends,
                                      const solidem::BondMotion<double>& motion,
                                      const solidem::BondInertia<double>& inertia) const;
  /// What it looks like in a pose that it has acted in.
  SolidemBondFigures figures(const double* memory, const SolidemBondEnds& ends, double step) const;
  /// Whether at this step nothing but the bond acts between its atoms: as a beam, or as the contact
  /// of a broken one, which ends for good when the spheres are apart.
  bool holds(double* memory, const SolidemBondEnds& ends, double step) const;
  /// Takes the bond away for good, after this step; the energy that was stored in it.
  double cut(double* memory, const SolidemBondEnds& ends, double step) const;

 private:
  typedef solidem::Vector3<double> Vector;
  typedef solidem::BeamPose<double> Pose;
  typedef solidem::BeamDeformation<double> Deformation;

  struct State {
    Pose pose;
    Deformation deformation;
  };
  struct Contact {
    Vector force;  ///< on i
    double energy;
  };

  double beam_radius(const SolidemBondEnds& ends) const;
  solidem::YieldingBeam<double> cold_beam(const SolidemBondEnds& ends, double rest_length) const;
  solidem::BeamHistory<double> history(const double* memory) const;
  solidem::BeamModes<double> last_modes(const double* memory, double rest_length) const;
  void keep_last(double* memory, const SolidemBondEnds& ends, solidem::BeamModes<double> modes,
                 double rest_length, double strain) const;
  solidem::Quaternion<double> last_turn(const double* memory) const;
  void keep_turn(double* memory, const SolidemBondEnds& ends) const;
  State state(const double* memory, const SolidemBondEnds& ends, double rest_length) const;
  bool acts_as_beam(const double* memory, double step) const;
  bool made_anew(const double* memory, double step) const;

  bool may_reach_limit(const double* memory, const SolidemBondEnds& ends,
                       const solidem::YieldingBeam<double>& bond, const State& now) const;
  solidem::BondStrain<double> flow(double* memory, const SolidemBondEnds& ends,
                                   const solidem::YieldingBeam<double>& bond, State& now,
                                   double step, SolidemBondAction& action) const;
  double rate_left(const double* memory, const SolidemBondEnds& ends, double step) const;
  double rate_per_flow(const SolidemBondEnds& ends) const;
  template <class Yield>
  solidem::YieldCurve<Yield, double> yield_curve(const Yield& known, const double* memory,
                                                 const SolidemBondEnds& ends, double step) const;
  solidem::BeamResponse<double> response(const double* memory, const SolidemBondEnds& ends,
                                         const solidem::YieldingBeam<double>& bond,
                                         const State& now, double step) const;
  SolidemBondAction act_near_limit(double* memory, const SolidemBondEnds& ends,
                                   const solidem::YieldingBeam<double>& bond, State now,
                                   double step, bool energies) const;
  SolidemBondAction act_broken(double* memory, const SolidemBondEnds& ends, double step,
                               bool energies) const;
  double touching_distance(const double* memory, const SolidemBondEnds& ends,
                           const solidem::YieldingBeam<double>& bond, const Vector& force) const;
  double lost_by_last_act(double* memory, const SolidemBondEnds& ends, double step) const;
  Contact contact(const double* memory, const SolidemBondEnds& ends) const;
  SolidemBondAction act_apart(double* memory, const SolidemBondEnds& ends, double step) const;
};

static_assert(std::is_trivially_copyable<SolidemBeam>::value,
              "a beam is written to restart files as it is");

inline solidem::Vector3<double> solidem_vector(const double* a) {
  return {a[0], a[1], a[2]};
}

// What every bond does in every step stands here, to be compiled into the loop over the bonds.

inline double SolidemBeam::beam_radius(const SolidemBondEnds& ends) const {
  return radius > 0.0 ? radius : ratio * 0.5 * (ends.radius_i + ends.radius_j);
}

inline solidem::YieldingBeam<double> SolidemBeam::cold_beam(const SolidemBondEnds& ends,
                                                            double rest_length) const {
  const double thickness = beam_radius(ends);
  const solidem::BeamSection<double> section = {young_modulus, shear_modulus, thickness};
  // Without plasticity all that is told of a bond is told of where it breaks.
  const solidem::JudgedSection judged = flows ? yield_section : rupture_section;
  if (law == TIMOSHENKO)
    return {solidem::timoshenko_rigidity(section, rest_length, shear_coefficient),
            rest_length,
            thickness,
            shear_modulus / young_modulus,
            judged,
            rupture_section};
  if (law == SPRING)  // bears no bending and no torsion: neither strains it
    return {solidem::spring_rigidity(section), rest_length, 0.0, 0.0, judged, rupture_section};
  return {solidem::euler_bernoulli_rigidity(section),
          rest_length,
          thickness,
          shear_modulus / young_modulus,
          judged,
          rupture_section};
}

// As warm as its atoms are.
inline solidem::YieldingBeam<double> SolidemBeam::beam(const double* memory,
                                                       const SolidemBondEnds& ends) const {
  const double rest_length = memory[SolidemBondMemory::REST_LENGTH];
  solidem::YieldingBeam<double> bond = cold_beam(ends, rest_length);
  if (expands())
    bond.rest_length = rest_length * warmth.stretch(ends.temperature_i, ends.temperature_j);
  if (!softens()) return bond;
  const double stiffness = warmth.stiffness(ends.temperature_i, ends.temperature_j);
  for (double* part :
       {&bond.rigidity.axial, &bond.rigidity.bending, &bond.rigidity.shear, &bond.rigidity.torsion})
    *part *= stiffness;
  return bond;
}

inline solidem::BeamHistory<double> SolidemBeam::history(const double* memory) const {
  typedef SolidemBondMemory Row;
  const Vector normal_i = solidem_vector(memory + Row::NORMAL_I);
  if (!may_change()) return solidem::unyielded(normal_i);
  return {normal_i,
          solidem_vector(memory + Row::NORMAL_J),
          memory[Row::EXTENSION],
          memory[Row::TWIST],
          memory[Row::PLASTIC_STRAIN],
          {}};
}

// The deformation in the last pose, of a bond that is as long when free of load as it is now.
inline solidem::BeamModes<double> SolidemBeam::last_modes(const double* memory,
                                                          double rest_length) const {
  const double* last = memory + SolidemBondMemory::LAST;
  const double longer = rest_length - memory[SolidemBondMemory::REST_LENGTH];
  return {solidem_vector(last), solidem_vector(last + 3), last[6] - longer, last[7]};
}

// The deformation in this pose, which the next flow starts from.
inline void SolidemBeam::keep_last(double* memory, const SolidemBondEnds& ends,
                                   solidem::BeamModes<double> modes, double rest_length,
                                   double strain) const {
  modes.extension += rest_length - memory[SolidemBondMemory::REST_LENGTH];
  const Vector &i = modes.lean_i, &j = modes.lean_j;
  const double numbers[] = {i.x, i.y, i.z, j.x, j.y, j.z, modes.extension, modes.twist, strain};
  for (int k = 0; k < 9; k++) memory[SolidemBondMemory::LAST + k] = numbers[k];
  if (flows) keep_turn(memory, ends);
}

inline solidem::Quaternion<double> SolidemBeam::last_turn(const double* memory) const {
  const double* last = memory + SolidemBondMemory::LAST_TURN;
  return {last[0], solidem_vector(last + 1)};
}

inline void SolidemBeam::keep_turn(double* memory, const SolidemBondEnds& ends) const {
  const solidem::Quaternion<double> turn =
      solidem::conjugate(ends.orientation_i) * ends.orientation_j;
  const double numbers[] = {turn.w, turn.v.x, turn.v.y, turn.v.z};
  for (int k = 0; k < 4; k++) memory[SolidemBondMemory::LAST_TURN + k] = numbers[k];
}

inline SolidemBeam::State SolidemBeam::state(const double* memory, const SolidemBondEnds& ends,
                                             double rest_length) const {
  const solidem::BeamHistory<double> kept = history(memory);
  State now;
  now.pose = solidem::beam_pose(ends.chord, kept.normal_i, kept.normal_j, ends.orientation_i,
                                ends.orientation_j);
  now.deformation = solidem::elastic_deformation(rest_length, now.pose, kept);
  return now;
}

inline double SolidemBeam::limit(const double* memory, const SolidemBondEnds& ends) const {
  return solidem::limit_strain(flows ? &hardening : NULL, solidem::FlowRule::radial_return,
                               breaks ? &rupture : NULL, memory[SolidemBondMemory::PLASTIC_STRAIN],
                               {}, ends.temperature());
}

// Most bonds are far from any limit, which a bound without a root tells.
inline bool SolidemBeam::may_reach_limit(const double* memory, const SolidemBondEnds& ends,
                                         const solidem::YieldingBeam<double>& bond,
                                         const State& now) const {
  if (!has_bound_of_limit()) return true;
  const double most = bond.rest_length * limit(memory, ends);
  return solidem::bound_of_squared_extension(bond.radius, bond.shear_ratio, now.pose,
                                             now.deformation) > most * most;
}

inline SolidemBondAction SolidemBeam::act(double* memory, const SolidemBondEnds& ends, double step,
                                          bool energies) const {
  if (memory[SolidemBondMemory::REST_LENGTH] == 0.0) make(memory, ends);
  const bool changes = may_change();
  if (changes && memory[SolidemBondMemory::RUPTURE] != 0.0)
    return act_broken(memory, ends, step, energies);
  const solidem::YieldingBeam<double> bond = beam(memory, ends);
  const State now = state(memory, ends, bond.rest_length);
  if (changes && may_reach_limit(memory, ends, bond, now))
    return act_near_limit(memory, ends, bond, now, step, energies);
  if (flows)
    keep_last(memory, ends, solidem::beam_modes(now.pose, now.deformation, ends.orientation_i),
              bond.rest_length,
              solidem::equivalent_strain(bond.yield_section, bond, now.pose, now.deformation));
  SolidemBondAction action;
  action.load = solidem::beam_load(bond.rigidity, now.pose, now.deformation);
  if (energies)
    action.elastic_energy = solidem::beam_energy(bond.rigidity, now.pose, now.deformation);
  return action;
}

}  // namespace LAMMPS_NS

#endif
