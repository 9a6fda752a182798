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
FixStyle(solidem/damage,FixSolidemDamage)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_DAMAGE_H
#define LMP_FIX_SOLIDEM_DAMAGE_H

#include "fix.h"
#include "laws/algebra.hpp"

namespace LAMMPS_NS {

/// Micro-cracks of a solid under pair_style solidem/central: finds the atoms on faces of cracks
/// (laws/crack_face.hpp), which the pair style then lets push those opposite and no more, and takes
/// isolated atoms out. Per-atom array: crack face, neighbours, removed, barycentre shown (3),
/// neighbours at the start. Global vector: crack faces, removed atoms.
class FixSolidemDamage : public Fix {
 public:
  FixSolidemDamage(class LAMMPS*, int, char**);
  ~FixSolidemDamage();
  int setmask();
  void init();
  void setup_pre_force(int);
  void pre_force(int);
  double compute_vector(int);

  bool finds_crack_faces() const { return crack_threshold > 0.0; }
  bool is_removed(int i) const { return state[i][REMOVED] != 0.0; }
  /// What local or ghost atom i shows, m: 0 when it is on none.
  solidem::Vector3<double> barycentre(int i) const {
    const double* shown = state[i] + SHOWN;
    return {shown[0], shown[1], shown[2]};
  }

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
  int pack_comm(int, int*, double*, int, int*);
  void unpack_comm(int, int, double*);
  double memory_usage();

 private:
  enum { CRACK_FACE, NEIGHBOURS, REMOVED, SHOWN, AT_START = SHOWN + 3, WIDTH };

  double crack_threshold;  // C; 0: crack faces are not looked for
  int every;               // steps between looks at the barycentres
  int minimal_neighbours;  // atoms that lost neighbours and keep fewer are removed; 0: never
  int removal_every;
  bool begun;           // are the neighbours at the start known?
  bigint last_removal;  // step; -1: none
  double** state;       // of local and ghost atoms
  class PairSolidemCentral* pair;

  void look_around(bool for_crack_faces);
  void remove_isolated_atoms();
};

}  // namespace LAMMPS_NS

#endif
#endif
