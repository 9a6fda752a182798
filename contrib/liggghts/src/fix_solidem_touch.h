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
FixStyle(solidem/touch,FixSolidemTouch)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_TOUCH_H
#define LMP_FIX_SOLIDEM_TOUCH_H

#include <string>
#include <vector>

#include "fix.h"
#include "solidem_touch.h"

namespace LAMMPS_NS {

/// Heat that passes between atoms and the walls and meshes that they touch, by
/// laws/contact_exchange.hpp: of each step of heat the exact exponential, before heat is conducted.
class FixSolidemTouch : public Fix, public SolidemTouchWatcher {
 public:
  FixSolidemTouch(class LAMMPS*, int, char**);
  ~FixSolidemTouch();
  int setmask();
  void init();
  void pre_force(int);
  void setup_pre_force(int);
  double compute_scalar();
  double compute_vector(int);
  double memory_usage();
  void write_restart(FILE*);
  void restart(char*);

  void see(const SolidemTouch&);
  /// Exchanges heat for so long, s, through what touches, or touched in the last pose in which
  /// forces acted.
  void exchange(double time);

 private:
  struct Tool {
    std::string id;      // of its fix
    double temperature;  // K
    double heat;         // that it gave so far, this rank's share, J
    const Fix* fix;
  };
  struct Way {
    int atom, tool;
    double conductance;  // W/K
  };

  double conductance, coefficient;  // of a touch, W/K, or of its area, W/(m² K); one is 0
  std::vector<Tool> tools;
  std::vector<Way> ways;
  class FixSolidemConduction* conduction;
  class FixPropertyAtom* temperature;

  void read_arguments(int, char**);
  void exchange(const Way&, double time);
  double total(double) const;
};

}  // namespace LAMMPS_NS

#endif
#endif
