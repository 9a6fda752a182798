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
FixStyle(solidem/bond/create,FixSolidemBondCreate)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_BOND_CREATE_H
#define LMP_FIX_SOLIDEM_BOND_CREATE_H

#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

/// Bonds all atoms of a group, at one step, that are nearer than a multiple of the sum of their
/// radii and not bonded yet. Global scalar: how many bonds it made.
class FixSolidemBondCreate : public Fix {
 public:
  FixSolidemBondCreate(class LAMMPS*, int, char**);
  int setmask();
  void init();
  void setup_pre_neighbor();
  void pre_neighbor();
  double extend_cut_ghost();
  double compute_scalar() { return made; }

 private:
  int bond_type;
  double tolerance;
  double made;  // bonds so far, of all ranks
  class FixSolidemBonds* bonds;
  class FixPropertyAtom* orientation;

  void create();
  void let_orientations_count_from_now();
  std::vector<std::vector<int> > partners() const;
  bool is_near(int i, int j) const;
  bool is_bonded(int i, int j) const;
  void bond(int i, int j);
  void require_unturned(int i, int j);
};

}  // namespace LAMMPS_NS

#endif
#endif
