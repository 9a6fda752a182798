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
FixStyle(solidem/bonds,FixSolidemBonds)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_BONDS_H
#define LMP_FIX_SOLIDEM_BONDS_H

#include "fix.h"
#include "solidem_bond_values.h"

namespace LAMMPS_NS {

/// The memory of a bonded solid: owns atom->bond_hist for the bond style in use, and the
/// orientation of every atom (a `fix property/atom` of that name). No atom style of its own is
/// needed.
class FixSolidemBonds : public Fix {
 public:
  FixSolidemBonds(class LAMMPS*, int, char**);
  ~FixSolidemBonds();
  void post_create();
  int setmask();
  void init();
  void setup_pre_force(int);
  void pre_force(int);
  void setup_pre_exchange();
  void pre_exchange();
  void post_run();
  double extend_cut_ghost();

  void write_restart(FILE*);
  void restart(char*);
  void grow_arrays(int);
  void copy_arrays(int, int, int);
  void set_arrays(int);
  int pack_exchange(int, double*);
  int unpack_exchange(int, double*);
  int pack_restart(int, double*);
  void unpack_restart(int, int);
  int size_restart(int);
  int maxsize_restart();
  double memory_usage();

 private:
  SolidemBondValues* history;
  bool list_is_current;  // does neighbor->bondhistlist hold newer history than atom->bond_hist?

  void store_history();
};

}  // namespace LAMMPS_NS

#endif
#endif
