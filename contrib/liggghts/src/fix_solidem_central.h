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
FixStyle(solidem/central,FixSolidemCentral)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_CENTRAL_H
#define LMP_FIX_SOLIDEM_CENTRAL_H

#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

/// The memory of pair_style solidem/central, which makes one of id solidem_central: which atoms
/// were neighbours at the start, and how far apart. It stays with the atoms for ever: through
/// rebuilds of lists, migration, runs in a row and restart files. Global vector: pairs within
/// range, deepest interpenetration since the start, dissipated energy.
class FixSolidemCentral : public Fix {
 public:
  static const char* const ID;

  FixSolidemCentral(class LAMMPS*, int, char**);
  ~FixSolidemCentral();
  int setmask();
  void init();
  void setup_pre_neighbor();
  void pre_neighbor();
  double extend_cut_ghost();
  double compute_vector(int);

  /// Keeps an initial pair of a local atom and one with a tag; both of two local atoms need a call.
  void keep(int i, int tag, double distance);
  /// To be called on every rank when all initial pairs have been kept.
  void end_of_keeping();
  /// Are the initial pairs known?
  bool knows() const { return known; }
  /// The initial distance of local atom i and one with this tag; 0 when they were no neighbours.
  double initial_distance(int i, int tag) const;

  /// Adds up what is dissipated from pose to pose; of this rank, W.
  void dissipate(double power);
  struct Totals {
    double interactions;      // at present, of this rank
    double interpenetration;  // since the start, of this rank
    double dissipated;        // J, since the start, of this rank
  } totals;

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
  struct Partner {
    int tag;
    double distance;
  };
  std::vector<std::vector<Partner> > partners;  // of local atoms
  std::vector<int> tags;                        // under which their partners know local atoms
  bool known;
  bigint atoms_known;  // how many atoms there were when tags were last looked at; -1: not yet
  int most_partners;   // of any atom on any rank
  double last_power;   // W

  class PairSolidemCentral* pair() const;
  void reserve_buffers();
  bool were_renumbered() const;
  void follow_renumbering();
  void note_tags();
  std::vector<int> new_tags() const;
};

}  // namespace LAMMPS_NS

#endif
#endif
