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

#include <string>
#include <vector>

#include "fix.h"
#include "solidem_touch.h"

namespace LAMMPS_NS {

/// Heat of friction between atoms that touch, and of atoms with walls and meshes: what slip takes
/// in model hooke/stiffness tangential history, by laws/linear_contact.hpp, heats both sides; two
/// atoms half each, an atom and a tool as their effusivities say. The springs of all pairs are
/// noted before the pair style acts; what it leaves of them tells the slip. Walls tell theirs
/// themselves.
class FixSolidemFriction : public Fix, public SolidemTouchWatcher {
 public:
  FixSolidemFriction(class LAMMPS*, int, char**);
  ~FixSolidemFriction();
  void post_create();
  int setmask();
  void init();
  void pre_force(int);
  void post_force(int);
  double compute_scalar();
  double compute_vector(int);
  double memory_usage();
  void write_restart(FILE*);
  void restart(char*);

  /// Enters the heat of this step beside what waits. Fix solidem/conduction asks for it where heat
  /// steps after the forces.
  void enter();

  /// Enters the heat of an atom and a wall.
  void see(const SolidemTouch&);

 private:
  struct Tool {
    std::string id;     // of its fix
    double effusivity;  // W s^½/(m² K)
    double heat;        // that it took so far, this rank's share, J
    const Fix* fix;     // NULL: there is none
  };

  double fraction;              // of the work of slip that becomes heat
  double usual_reach;           // of LIGGGHTS between pre_force and post_force, m
  double work;                  // of slip so far, this rank's share, J
  std::vector<Tool> tools;      // that take heat
  std::vector<double> springs;  // of the listed pairs before they act, m
  class PairGran* contacts;
  class FixPropertyGlobal* stiffness;  // k_t, N/m
  class FixSolidemConduction* conduction;
  class FixPropertyAtom* waiting_heat;

  void read_arguments(int, char**);
  void find_pair_style();
  void require_order() const;
  double slip_work(int i, int j, const double* before, const double* after) const;
  double total(double) const;
};

}  // namespace LAMMPS_NS

#endif
#endif
