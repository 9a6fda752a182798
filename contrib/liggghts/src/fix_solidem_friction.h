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
FixStyle(solidem/friction,FixSolidemFriction)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_FRICTION_H
#define LMP_FIX_SOLIDEM_FRICTION_H

#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

/// Heat of friction between atoms that touch: what slip takes in pair_style gran model
/// hooke/stiffness tangential history, by laws/linear_contact.hpp, heats both, half each. The
/// springs of all contacts are noted before the pair style acts; what it leaves of them tells the
/// slip.
class FixSolidemFriction : public Fix {
 public:
  FixSolidemFriction(class LAMMPS*, int, char**);
  void post_create();
  int setmask();
  void init();
  void pre_force(int);
  void post_force(int);
  double compute_scalar();
  double memory_usage();
  void write_restart(FILE*);
  void restart(char*);

  /// Enters the heat of this step beside what waits. Fix solidem/conduction asks for it where heat
  /// steps after the forces.
  void enter();

 private:
  double fraction;              // of the work of slip that becomes heat
  double work;                  // of slip so far, this rank's share, J
  std::vector<double> springs;  // of the listed pairs before they act, m
  class PairGran* contacts;
  class FixPropertyGlobal* stiffness;  // k_t, N/m
  class FixSolidemConduction* conduction;
  class FixPropertyAtom* waiting_heat;

  void require_order() const;
  double slip_work(int i, int j, const double* before, const double* after) const;
};

}  // namespace LAMMPS_NS

#endif
#endif
