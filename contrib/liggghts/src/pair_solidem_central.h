// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifdef PAIR_CLASS

// clang-format off
PairStyle(solidem/central,PairSolidemCentral)
// clang-format on

#else

#ifndef LMP_PAIR_SOLIDEM_CENTRAL_H
#define LMP_PAIR_SOLIDEM_CENTRAL_H

#include <string>
#include <vector>

#include "laws/algebra.hpp"
#include "pair.h"
#include "solidem_central.h"
#include "solidem_kernels.h"

namespace LAMMPS_NS {

/// Central forces between the atoms of a continuous solid: laws/central_laws.hpp within the range
/// and with the dissipation of laws/central_interaction.hpp. Atoms that were neighbours at the
/// start keep the distance they had then as their equilibrium; a fix of the style's own remembers
/// it.
class PairSolidemCentral : public Pair {
 public:
  explicit PairSolidemCentral(class LAMMPS*);
  ~PairSolidemCentral();

  void settings(int, char**);
  void coeff(int, char**);
  void init_style();
  double init_one(int, int);
  void compute(int eflag, int vflag);
  double single(int i, int j, int, int, double square, double, double, double& force_over_distance);
  void write_restart(FILE*);
  void read_restart(FILE*, const int, const int);
  void write_restart_settings(FILE*);
  void read_restart_settings(FILE*, const int, const int);
  double memory_usage();

  const SolidemCentral& settings_of_style() const { return settings_; }

  /// Two atoms that may interact before the neighbour list is built anew. A pair of two local atoms
  /// is listed once, one of a local atom i and a ghost j on the ranks of both.
  struct Listed {
    int i, j;
    double equilibrium;
  };
  /// All such pairs of this rank.
  const std::vector<Listed>& listed();
  void forget_list() { list_is_current_ = false; }

  /// Atom j seen from atom i.
  struct Seen {
    solidem::Vector3<double> chord;
    double distance;
    bool inside;  // within range, neither of them removed
  };
  Seen see(int i, int j) const;

 private:
  SolidemCentral settings_;
  class FixSolidemCentral* memory_;
  class FixSolidemDamage* damage_;
  std::vector<double> largest_radius_;  // of each atom type
  std::vector<Listed> listed_;
  bool list_is_current_;
  // The same in columns, and what a step needs of atoms: SolidemCentralPacks.
  std::vector<int> i_, j_;
  std::vector<SolidemRow> equilibrium_, owned_, atoms_, faces_, loads_, told_;

  void allocate();
  std::string read_words(FILE*);
  void provide_memory();
  void require_wide_cell() const;
  void remember_initial_pairs();
  void make_list();
  double equilibrium(int i, int j) const;
  bool are_on_opposite_faces(int i, int j, const solidem::Vector3<double>& chord) const;
  void make_columns();
  void gather_atoms();
  void gather_faces();
  void hand_loads_on();
  void tally_pairs();
};

}  // namespace LAMMPS_NS

#endif
#endif
