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

#include <cmath>
#include <limits>

#include "laws/beam_plasticity.hpp"
#include "laws/beam_rupture.hpp"

namespace LAMMPS_NS {

/// What a bond remembers, from the lower tag to the higher: places in its row of numbers. An
/// elastic bond needs the first four alone.
struct SolidemBondMemory {
  enum Place {
    NORMAL_I = 0,        ///< 3: normal of the section at i, in body axes of i
    REST_LENGTH = 3,     ///< zero: the bond was not yet seen
    NORMAL_J = 4,        ///< 3: the same at j, in body axes of j
    EXTENSION = 7,       ///< plastic part
    TWIST = 8,           ///< plastic part
    PLASTIC_STRAIN = 9,  ///< equivalent, never decreasing
    PLASTIC_WORK = 10,   ///< so far
    RUPTURE = 11,  ///< 0: whole; s + 1: broke at step s; s + 1.5: cut at step s; -(s + 2): made
                   ///< anew at step s, from the next one on it is whole; GONE: apart for good
    FLOW = 12,     ///< s + 1: last flowed at step s; when made anew, the rest length before
    REST_DIRECTION = 13,  ///< 3: direction when it was made, in body axes
  };
  /// Numbers of a bond that is elastic; may flow or break; flows by the scaled offset.
  enum Width { ELASTIC = 4, CHANGING = 13, WITH_REST_DIRECTION = 16 };
  static constexpr double GONE = -1.0;
  static bool is_gone(const double* memory) { return memory[RUPTURE] == GONE; }
  static bool is_cut(const double* memory) {
    return memory[RUPTURE] > 0.0 && memory[RUPTURE] != std::floor(memory[RUPTURE]);
  }
  static bool is_whole(const double* memory) {
    return memory[RUPTURE] == 0.0 || memory[RUPTURE] < GONE;
  }
};

/// Where the two atoms of a bond stand; i has the lower tag.
struct SolidemBondEnds {
  solidem::Vector3<double> chord;  ///< from i to j
  solidem::Quaternion<double> orientation_i, orientation_j;
  double radius_i, radius_j;
};

/// What a bond does to its atoms.
struct SolidemBondAction {
  solidem::BeamLoad<double> load = {};
  double elastic_energy = 0.0;   ///< of the beam
  double contact_energy = 0.0;   ///< of a broken bond whose atoms push each other
  double fracture_energy = 0.0;  ///< lost in this step, by rupture or by a bond made anew
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
  enum Plasticity { NONE, RADIAL_RETURN, SCALED_OFFSET };

  static constexpr double NEVER = std::numeric_limits<double>::infinity();

  double young_modulus = 0.0, shear_modulus = 0.0;
  double radius = 0.0;  ///< of the beam; 0: `ratio` times the mean radius of its atoms
  double ratio = 0.0;
  Law law = EULER_BERNOULLI;
  double shear_coefficient = 0.9;  ///< of TIMOSHENKO
  Plasticity plasticity = NONE;
  solidem::BeamYield<double> yield = {NEVER, 0.0};
  solidem::BeamRupture<double> rupture = {NEVER, NEVER};
  double contact_ratio = 0.0;  ///< stiffness of contacts over E S / l; 0: no contact
  double rebonding_pressure = NEVER;

  bool may_break() const {
    return std::isfinite(rupture.elastic_strain) || std::isfinite(rupture.strain);
  }
  bool may_change() const { return plasticity != NONE || may_break(); }
  /// Numbers of SolidemBondMemory that a bond of this type needs.
  int width() const;

  /// What the bond does in the pose of this step, which is thereby accepted: the memory moves on. A
  /// second call in the same pose at the same step gives the same loads and changes nothing. A bond
  /// that breaks in a pose still acts there, but its energy is no longer elastic. `energies`:
  /// whether the elastic energy is wanted; that of a contact is always told.
  SolidemBondAction act(double* memory, const SolidemBondEnds& ends, double step,
                        bool energies) const;
  /// What it looks like in a pose that it has acted in.
  SolidemBondFigures figures(const double* memory, const SolidemBondEnds& ends, double step) const;
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
  solidem::YieldingBeam<double> beam(const SolidemBondEnds& ends, double rest_length) const;
  solidem::BeamHistory<double> history(const double* memory) const;
  Pose pose(const double* memory, const SolidemBondEnds& ends) const;
  bool acts_as_beam(const double* memory, double step) const;
  bool made_anew(const double* memory, double step) const;

  void make(double* memory, const SolidemBondEnds& ends) const;
  bool flow(double* memory, const SolidemBondEnds& ends, const solidem::YieldingBeam<double>& bond,
            const State& elastic, double step) const;
  Contact contact(double rest_length, const SolidemBondEnds& ends) const;
  SolidemBondAction act_apart(double* memory, const SolidemBondEnds& ends, double step) const;
};

}  // namespace LAMMPS_NS

#endif
