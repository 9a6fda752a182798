// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_KERNELS_H
#define LMP_SOLIDEM_KERNELS_H

namespace LAMMPS_NS {

/// Eight numbers in a cache line of their own: of one atom, or one number of eight bonds.
struct alignas(64) SolidemRow {
  double number[8];
};

/// Bonds of one type, many at a time, and what they act on. Where they stand one after the other,
/// i, j and memory go on to a multiple of eight with the last bond again.
struct SolidemBeamPacks {
  int bonds;
  const int *i, *j;           ///< atoms: that of the lower tag, and of the higher
  double* const* memory;      ///< rows of SolidemBondMemory
  const SolidemRow* beam;     ///< of eight bonds: axial, bending, shear, torsion, radius
  bool one_beam;              ///< the same for all
  double shear_ratio;         ///< G / E
  const SolidemRow* stretch;  ///< of their rest lengths; NULL: none
  const SolidemRow* limit;    ///< strains up to which they neither flow nor break; NULL: never
  bool flows;
  const SolidemRow* poses;  ///< of atoms: centre, one that is free, orientation
  SolidemRow* loads;        ///< of atoms, added to: force, one that is free, moment, the same
  double damping_ratio;
  const SolidemRow* motion;  ///< of atoms: v, 1 / mass, omega, 1 / inertia; NULL: no damping
  const SolidemRow* owned;   ///< this rank's share of eight bonds; NULL: all
  SolidemRow* told;          ///< of bonds: elastic energy, force on i; NULL: nobody asks
  int* apart;                ///< bonds that broke or may be at their limit: left alone here
  // Found:
  int bonds_apart;
  double damping_power;
};

/// Atoms that move by their forces, and turn.
struct SolidemMovingAtoms {
  int atoms;
  double *x, *v, *omega, *orientation;
  const double *f, *torque, *mass, *radius;
  const char* moves;  ///< each of them?
  bool translates;
  double kick;   ///< half a time step, in the units of forces
  double drift;  ///< a time step; 0: velocities alone
};

/// Pairs of atoms under a central law, many at a time. Where they stand one after the other, i and
/// j go on to a multiple of eight with the last pair again.
struct SolidemCentralPacks {
  int pairs;
  const int *i, *j;
  const SolidemRow* equilibrium;  ///< of eight pairs: their distance there
  const SolidemRow* owned;        ///< of eight pairs: this rank's share
  const SolidemRow* atoms;  ///< centre, radius (far below zero: it takes no part), velocity, free
  const SolidemRow* faces;  ///< barycentre that an atom shows; NULL: nobody looks for cracks
  SolidemRow* loads;        ///< of atoms, added to: force
  SolidemRow* told;         ///< of pairs: force over distance, distance, inside; NULL: nobody asks
  double range, interpenetration, dissipation;
  const void* law;  ///< one of CentralLaws
  /// Its force where two atoms are too near for it.
  double (*continued_force)(const void* law, double interpenetration, double distance,
                            double equilibrium);
  // Found:
  double interactions, compression_ratio, power;
};

/// Pairs of atoms that conduct, each with both of its sides: rows of one neighbour for each of
/// eight atoms that follow one another. Where there is none stands the atom itself.
struct SolidemConductors {
  int atoms;
  const int* first_row;           ///< of eight atoms; then where the last end
  const int* neighbour;           ///< of eight atoms
  const SolidemRow* conductance;  ///< to it, W/K
  const double* temperature;      ///< of all atoms, K
  double* flux;                   ///< of atoms, added to, W
};

/// The loops that take nearly all of the time of a run, compiled for one instruction set.
struct SolidemKernels {
  void (*act)(SolidemBeamPacks&);
  void (*move)(const SolidemMovingAtoms&);
  void (*conduct)(const SolidemConductors&);
  void (*const* pull)(SolidemCentralPacks&);  ///< by laws in the order of CentralLaws
};

/// The best of this machine. SOLIDEM_INSTRUCTION_SET (baseline, x86_64_v3, x86_64_v4) asks for
/// another.
const SolidemKernels& solidem_kernels();

}  // namespace LAMMPS_NS

#endif
