// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_BOND_MEMORY_H
#define LMP_SOLIDEM_BOND_MEMORY_H

#include <cmath>

namespace LAMMPS_NS {

/// What a bond remembers, from the lower tag to the higher: places in its row of numbers. An
/// elastic bond needs the first four alone.
struct SolidemBondMemory {
  enum Place {
    NORMAL_I = 0,        ///< 3: normal of the section at i, in body axes of i
    REST_LENGTH = 3,     ///< at the reference temperature; zero: the bond was not yet seen
    NORMAL_J = 4,        ///< 3: the same at j, in body axes of j
    EXTENSION = 7,       ///< plastic part
    TWIST = 8,           ///< plastic part
    PLASTIC_STRAIN = 9,  ///< equivalent, never decreasing
    PLASTIC_WORK = 10,   ///< so far
    RUPTURE = 11,  ///< 0: whole; s + 1: broke at step s; s + 1.5: cut at step s; -(s + 2): made
                   ///< anew at step s, from the next one on it is whole; GONE: apart for good
    FLOW = 12,     ///< s + 1: last flowed at step s; broken: where its atoms touch; made anew: the
                   ///< push at that step
    ENERGY = 13,   ///< broken: its energy when it acted for the last time
    LAST = 14,  ///< 9: elastic deformation in the last pose: leans of both ends, extension (beyond
                ///< REST_LENGTH, however warm the bond was), twist; and, broken, the contact's push
                ///< there
    LAST_TURN = 23,       ///< 4: quaternion by which j stood turned against i there, in axes of i
    REST_DIRECTION = 27,  ///< 3: direction when it was made, in body axes
    FLOW_RATE = 30,       ///< of the plastic strain, averaged, when it last flowed
  };
  /// Numbers of a bond that is elastic; may break; may flow; flows by the scaled offset; feels the
  /// rate of its flow.
  enum Width { ELASTIC = 4, BREAKING = 23, FLOWING = 27, WITH_REST_DIRECTION = 30, WITH_RATE = 31 };
  static constexpr double GONE = -1.0;
  static bool is_gone(const double* memory) { return memory[RUPTURE] == GONE; }
  static bool is_cut(const double* memory) {
    return memory[RUPTURE] > 0.0 && memory[RUPTURE] != std::floor(memory[RUPTURE]);
  }
  static bool is_whole(const double* memory) {
    return memory[RUPTURE] == 0.0 || memory[RUPTURE] < GONE;
  }
};

}  // namespace LAMMPS_NS

#endif
