// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifdef FIX_CLASS

// clang-format off
FixStyle(nve/solidem,FixNVESolidem)
// clang-format on

#else

#ifndef LMP_FIX_NVE_SOLIDEM_H
#define LMP_FIX_NVE_SOLIDEM_H

#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

/// Velocity Verlet for spheres with orientation: position, velocity, angular velocity, and the
/// orientation that `fix solidem/bonds` keeps.
class FixNVESolidem : public Fix {
 public:
  FixNVESolidem(class LAMMPS*, int, char**);
  int setmask();
  void init();
  void reset_dt();
  void initial_integrate(int);
  void final_integrate();

 private:
  double half_step_over_force_unit, step;
  bool translates;
  class FixPropertyAtom *orientation, *removed;

  std::vector<char> moving;  // each atom?

  void move(double drift);
};

}  // namespace LAMMPS_NS

#endif
#endif
