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
FixStyle(solidem/conduction,FixSolidemConduction)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_CONDUCTION_H
#define LMP_FIX_SOLIDEM_CONDUCTION_H

#include <vector>

#include "fix.h"
#include "solidem_bond_values.h"

namespace LAMMPS_NS {

/// Heat conduction along bonds, explicit in time; the law is laws/platonic_conduction.hpp.
/// Temperatures are LIGGGHTS' property Temp. Rest distances stay with the bonds, the number of
/// bonds with the atoms (property coordination), so conductances never change once a bond has been
/// seen.
class FixSolidemConduction : public Fix {
 public:
  FixSolidemConduction(class LAMMPS*, int, char**);
  ~FixSolidemConduction();
  void post_create();
  int setmask();
  void init();
  void setup_pre_force(int);
  void pre_force(int);
  void post_force(int);
  double compute_scalar();
  double extend_cut_ghost();

  /// Heat capacity of local atom i, J/K.
  double heat_capacity(int i) const;

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
  struct Conductor {
    int i, j;            // i is local, j may be a ghost
    double conductance;  // W/K
  };

  double conductivity, specific_heat, density, initial_temperature;
  double*** rest_distance;  // [local atom][bond][0]; zero marks a bond not yet seen
  SolidemBondValues* rest_distances;
  std::vector<Conductor> conductors;
  std::vector<double> step_over_capacity;  // of local atoms, K/W
  double step_of_capacities;
  class FixPropertyAtom *temperature, *heat_flux, *coordination;

  class FixPropertyAtom* property(const char*, const char*, const char*, const char*);
  void find_properties();
  bool see_new_bonds();
  void count_bonds();
  void build_conductors();
};

}  // namespace LAMMPS_NS

#endif
#endif
