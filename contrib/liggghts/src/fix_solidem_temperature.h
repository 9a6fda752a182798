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
  void setup(int);
  void end_of_step();
  double compute_scalar();
  void write_restart(FILE*);
  void restart(char*);

 private:
  class SolidemNumber* imposed;  // K
  double heat_supplied;          // of all ranks, J
  class FixSolidemConduction* conduction;
  class FixPropertyAtom* temperature;

  double impose();
};

}  // namespace LAMMPS_NS

#endif
#endif
