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
FixStyle(solidem/temperature,FixSolidemTemperature)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_TEMPERATURE_H
#define LMP_FIX_SOLIDEM_TEMPERATURE_H

#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

/// Holds a group at a temperature, constant or an equal-style variable, and counts the heat this
/// takes.
class FixSolidemTemperature : public Fix {
 public:
  FixSolidemTemperature(class LAMMPS*, int, char**);
  ~FixSolidemTemperature();
  int setmask();
  void init();
  void setup_pre_force(int);
  void pre_force(int);
  void setup(int);
  void end_of_step();
  double compute_scalar();
  /// Gives the group the temperature that it has had since the last step; that of the present step.
  void hold();
  void move_on();
  void write_restart(FILE*);
  void restart(char*);

 private:
  class SolidemNumber* imposed;  // K
  double target;                 // what was imposed last, K; heat that waits keeps it
  double heat_supplied;          // this rank's share, J
  std::vector<int> held;         // local atoms of the group
  class FixSolidemConduction* conduction;
  class FixPropertyAtom* temperature;

  void find_held();
};

}  // namespace LAMMPS_NS

#endif
#endif
