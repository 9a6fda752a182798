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

#include "pointers.h"

namespace LAMMPS_NS {

/// `width` numbers for every bond an atom lists, kept beside atom->bond_atom: they follow the atom
/// through growth, sorting, migration and restart. A fix owns one and forwards its per-atom calls.
/// `array[i][m][k]` is number k of bond m of local atom i; the owner may let it be atom->bond_hist.
class SolidemBondValues : protected Pointers {
 public:
  SolidemBondValues(class LAMMPS* lmp, double***& array, int width);
  ~SolidemBondValues();

  int width() const { return width_; }

  void grow(int nmax);
  void copy(int from, int to);
  void clear(int i);
  /// Forgets bond m of atom i, which is about to leave the list: the last one takes its place.
  void forget(int i, int m);
  int pack_exchange(int i, double* buffer) const;
  int unpack_exchange(int i, const double* buffer);
  int pack_restart(int i, double* buffer) const;
  void unpack_restart(int i, int nth);
  int size_restart(int i) const;
  int maxsize_restart() const;
  double memory_usage() const;
  /// What the fullest atom of this rank takes along when it migrates.
  int most_numbers_of_an_atom() const;

 private:
  double***& array_;
  int width_;
  int bonds_per_atom_;
  int rows_;
};

}  // namespace LAMMPS_NS

#endif
