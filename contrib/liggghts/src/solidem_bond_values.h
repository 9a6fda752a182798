// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_BOND_VALUES_H
#define LMP_SOLIDEM_BOND_VALUES_H

#include <functional>
#include <vector>

#include "pointers.h"

namespace LAMMPS_NS {

/// `width` numbers for every bond an atom lists, kept beside atom->bond_atom: they follow the atom
/// through growth, sorting, migration and restart, and the bond through every change of the list.
/// A fix owns one and forwards its per-atom calls. `array[i][m][k]` is number k of bond m of local
/// atom i once that atom is settled; the owner may let it be atom->bond_hist.
class SolidemBondValues : protected Pointers {
 public:
  SolidemBondValues(class LAMMPS* lmp, double***& array, int width);
  ~SolidemBondValues();

  int width() const { return width_; }
  /// What is done with the row of a bond that its atom no longer lists.
  std::function<void(const double*)> when_forgotten;

  /// Commands and fixes change lists of bonds and know nothing of these rows. Puts the rows of atom
  /// i in the order of its list again: a bond is known by the atom it leads to, and by its type
  /// where several lead there. A bond not seen before has zeros, one no longer listed is forgotten.
  void settle(int i);
  void settle_all();
  /// The row of atom i's bond to an atom, number `nth` of those of that type; NULL: it has none.
  double* find(int i, int partner, int type, int nth) const;

  void grow(int nmax);
  void copy(int from, int to);
  void clear(int i);
  int pack_exchange(int i, double* buffer);
  int unpack_exchange(int i, const double* buffer);
  int pack_restart(int i, double* buffer);
  void unpack_restart(class Fix* owner, int i, int nth);
  int size_restart(int i) const;
  int maxsize_restart() const;
  double memory_usage() const;
  /// What the fullest atom of this rank takes along when it migrates.
  int most_numbers_of_an_atom() const;

 private:
  struct Key {
    int partner, type;  ///< partner 0: no bond
    bool operator==(const Key& other) const {
      return partner == other.partner && type == other.type;
    }
  };

  double***& array_;
  int width_;
  int bonds_per_atom_;
  int rows_;
  std::vector<Key> keys_;  ///< of the rows: [atom][bond]

  Key* keys(int i) { return &keys_[static_cast<std::size_t>(i) * bonds_per_atom_]; }
  const Key* keys(int i) const { return &keys_[static_cast<std::size_t>(i) * bonds_per_atom_]; }
  Key listed(int i, int m) const;
};

}  // namespace LAMMPS_NS

#endif
