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
FixStyle(solidem/exchange,FixSolidemExchange)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_EXCHANGE_H
#define LMP_FIX_SOLIDEM_EXCHANGE_H

#include <string>
#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

/// Heat exchange of some atoms with an outer temperature, each through a conductance of its own:
/// walls of given temperature, and convection. The conductances come from a text file.
class FixSolidemExchange : public Fix {
 public:
  FixSolidemExchange(class LAMMPS*, int, char**);
  ~FixSolidemExchange();
  int setmask();
  void init();
  void setup_pre_force(int);
  void setup(int);
  void pre_force(int);
  void post_force(int);
  void end_of_step();
  double compute_scalar();
  /// Adds the power through the wall to the atoms' heatFlux, and counts its heat over a step of so
  /// long, s.
  void exchange(double time);
  /// Adds each local atom's conductance to this wall, W/K.
  void add_conductances(double* of_atoms) const;
  void write_restart(FILE*);
  void restart(char*);
  double memory_usage();

 private:
  struct Contact {
    int atom;            // number of the atom (its tag); in `local`, its index on this rank
    double conductance;  // W/K
  };

  std::string file, name;
  std::vector<Contact> contacts;  // all of them, on every rank
  std::vector<Contact> local;     // those of the local atoms
  class SolidemNumber* outer;     // K
  double outer_now;               // at the start of the present step, K
  double heat_supplied;           // to the local atoms so far, J
  class FixSolidemConduction* conduction;
  class FixPropertyAtom *temperature, *heat_flux;

  void read_file();
  void find_local();
};

}  // namespace LAMMPS_NS

#endif
#endif
