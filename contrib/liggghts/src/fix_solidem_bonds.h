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
FixStyle(solidem/bonds,FixSolidemBonds)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_BONDS_H
#define LMP_FIX_SOLIDEM_BONDS_H

#include <vector>

#include "fix.h"
#include "solidem_bond_values.h"
#include "solidem_contact_list.h"

namespace LAMMPS_NS {

/// The memory of a bonded solid: owns atom->bond_hist for the bond style in use, and the
/// orientation of every atom (a `fix property/atom` of that name). No atom style of its own is
/// needed. Bonds that are gone for good leave the atoms' lists here, and atoms that are left with
/// too few are taken out. Pairs that are bonded stand in no list of a granular pair style, unless
/// that is asked for, and are back in it as soon as their bond lets go. Global vector: plastic
/// work, fracture energy, broken bonds, contact energy, removed atoms, bonds formed, step of the
/// first rupture (-1: none), energy that damping took.
class FixSolidemBonds : public Fix {
 public:
  FixSolidemBonds(class LAMMPS*, int, char**);
  ~FixSolidemBonds();
  void post_create();
  int setmask();
  void init();
  void post_integrate();
  void setup_pre_force(int);
  void pre_force(int);
  void setup(int);
  void post_force(int);
  void setup_pre_exchange();
  void pre_exchange();
  void setup_pre_neighbor();
  void pre_neighbor();
  void post_run();
  double extend_cut_ghost();
  double compute_vector(int);

  /// Bonds that atoms have lost and that stand in no list any more; NULL when bonds cannot break.
  const double* lost_bonds() const;

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
  int pack_reverse_comm(int, int, double*);
  void unpack_reverse_comm(int, int*, double*);

 private:
  SolidemBondValues* history;
  bool list_is_current;  // does neighbor->bondhistlist hold newer history than atom->bond_hist?

  SolidemContactList contacts;
  bool bonded_contacts;           // does a granular pair style act between bonded atoms, too?
  bool contacts_are_new;          // was its list built since bonded pairs were hidden?
  std::vector<int> hidden_pairs;  // of which bonds, by their place in neighbor->bondlist
  int minimal_bonds;              // atoms that lost bonds and keep fewer are removed; 0: never
  class BondSolidemBeam* beams;   // NULL: another bond style
  class FixPropertyAtom *orientation, *lost, *removed;
  int moved, turned;  // groups of atoms of beams: those of 'move', and those of 'nve/solidem'
  double gone_plastic_work;                       // of bonds that left the lists of this rank
  std::vector<double> whole_bonds, broken_bonds;  // of every atom, ghosts included

  void read_options(int narg, char** arg);
  void find_properties();
  void require_one_list();
  void hide_bonded_pairs();
  void show_parted_pairs();
  bool holds(int n) const;
  bool is_held_by_another(int n) const;
  void require_turning();
  int bonded_and_unturned(int movers) const;
  void require_bonds_switched_on() const;
  void require_unit_orientations() const;
  class FixPropertyAtom* property(const char* name, const char* forward, const char* reverse);
  void keep_motion(const char* name, const char* forward);
  void store_history();
  void store_row(int n, int i, int partner, int nth);
  void drop_gone_bonds();
  void remove_atoms();
  void count_bonds();
  bool mark_loose_atoms();
  void cut_bonds_of_removed_atoms();
  double plastic_work();
};

}  // namespace LAMMPS_NS

#endif
#endif
