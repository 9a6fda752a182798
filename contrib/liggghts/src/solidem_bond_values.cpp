// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_bond_values.h"

#include <stdlib.h>

#include <algorithm>

#include "atom.h"
#include "error.h"
#include "memory.h"
#include "solidem_restart.h"

using namespace LAMMPS_NS;

SolidemBondValues::SolidemBondValues(LAMMPS* liggghts, double***& array, int width)
    : Pointers(liggghts), array_(array), width_(width), bonds_per_atom_(0), rows_(0) {
  array_ = NULL;
}

SolidemBondValues::~SolidemBondValues() {
  memory->destroy(array_);
  array_ = NULL;
}

// The bond that stands at place m of atom i's list; switched off it is still the same bond.
SolidemBondValues::Key SolidemBondValues::listed(int i, int m) const {
  if (m >= atom->num_bond[i]) return {0, 0};
  return {atom->bond_atom[i][m], abs(atom->bond_type[i][m])};
}

void SolidemBondValues::settle(int i) {
  Key* known = keys(i);
  bool settled = true;
  for (int m = 0; m < bonds_per_atom_; m++) settled = settled && known[m] == listed(i, m);
  if (settled) return;

  std::vector<Key> old(known, known + bonds_per_atom_);
  const std::vector<double> rows(array_[i][0], array_[i][0] + bonds_per_atom_ * width_);
  clear(i);
  for (const bool of_type : {true, false})
    for (int m = 0; m < atom->num_bond[i]; m++) {
      const Key bond = listed(i, m);
      if (known[m] == bond) continue;
      const auto found = std::find_if(old.begin(), old.end(), [&](const Key& key) {
        return of_type ? key == bond : key.partner == bond.partner;
      });
      if (found == old.end()) continue;
      std::copy_n(&rows[(found - old.begin()) * width_], width_, array_[i][m]);
      known[m] = bond;
      *found = {0, 0};
    }
  for (int m = 0; m < bonds_per_atom_; m++) {
    known[m] = listed(i, m);
    if (old[m].partner != 0 && when_forgotten) when_forgotten(&rows[m * width_]);
  }
}

void SolidemBondValues::settle_all() {
  for (int i = 0; i < atom->nlocal; i++) settle(i);
}

double* SolidemBondValues::find(int i, int partner, int type, int nth) const {
  const Key bond = {partner, type};
  for (int m = 0; m < bonds_per_atom_; m++)
    if (keys(i)[m] == bond && nth-- == 0) return array_[i][m];
  return NULL;
}

void SolidemBondValues::grow(int nmax) {
  if (array_ && bonds_per_atom_ != std::max(atom->bond_per_atom, 1))
    error->all(FLERR,
               "The number of bonds per atom changed while values are kept with the bonds: reserve "
               "room with the header line 'N extra bond per atom' of the data file");
  if (nmax <= rows_) return;
  bonds_per_atom_ = std::max(atom->bond_per_atom, 1);
  memory->grow(array_, nmax, bonds_per_atom_, width_, "solidem:bond_values");
  keys_.resize(static_cast<std::size_t>(nmax) * bonds_per_atom_);
  for (int i = rows_; i < nmax; i++) clear(i);
  rows_ = nmax;
}

void SolidemBondValues::copy(int from, int to) {
  settle(from);
  std::copy_n(array_[from][0], bonds_per_atom_ * width_, array_[to][0]);
  std::copy_n(keys(from), bonds_per_atom_, keys(to));
}

void SolidemBondValues::clear(int i) {
  std::fill_n(array_[i][0], bonds_per_atom_ * width_, 0.0);
  std::fill_n(keys(i), bonds_per_atom_, Key{0, 0});
}

int SolidemBondValues::pack_exchange(int i, double* buffer) {
  settle(i);
  const int count = atom->num_bond[i] * width_;
  buffer[0] = atom->num_bond[i];
  std::copy_n(array_[i][0], count, buffer + 1);
  return 1 + count;
}

int SolidemBondValues::unpack_exchange(int i, const double* buffer) {
  clear(i);
  const int bonds = static_cast<int>(buffer[0]);
  std::copy_n(buffer + 1, bonds * width_, array_[i][0]);
  for (int m = 0; m < bonds; m++) keys(i)[m] = listed(i, m);
  return 1 + bonds * width_;
}

// In a restart file a row follows its key: atom and type.

int SolidemBondValues::pack_restart(int i, double* buffer) {
  settle(i);
  double* number = buffer + SOLIDEM_RESTART_HEAD;
  for (int m = 0; m < atom->num_bond[i]; m++) {
    *number++ = keys(i)[m].partner;
    *number++ = keys(i)[m].type;
    number = std::copy_n(array_[i][m], width_, number);
  }
  return solidem_seal(buffer, static_cast<int>(number - buffer) - SOLIDEM_RESTART_HEAD);
}

void SolidemBondValues::unpack_restart(Fix* owner, int i, int nth) {
  const SolidemStored stored = solidem_unseal(error, atom, owner, i, nth);
  const int stride = 2 + width_, bonds = stored.count / stride;
  if (stored.count != bonds * stride || bonds > bonds_per_atom_)
    solidem_damaged(error, atom, owner, i);
  clear(i);
  for (int m = 0; m < bonds; m++) {
    const double* row = stored.numbers + m * stride;
    keys(i)[m] = {static_cast<int>(row[0]), static_cast<int>(row[1])};
    std::copy_n(row + 2, width_, array_[i][m]);
  }
}

int SolidemBondValues::size_restart(int i) const {
  return SOLIDEM_RESTART_HEAD + (2 + width_) * atom->num_bond[i];
}

int SolidemBondValues::maxsize_restart() const {
  return SOLIDEM_RESTART_HEAD + (2 + width_) * atom->bond_per_atom;
}

double SolidemBondValues::memory_usage() const {
  return static_cast<double>(rows_) * bonds_per_atom_ *
         (width_ * sizeof(double) + sizeof(double*) + sizeof(Key));
}

int SolidemBondValues::most_numbers_of_an_atom() const {
  int most = 0;
  for (int i = 0; i < atom->nlocal; i++) most = std::max(most, atom->num_bond[i]);
  return 1 + most * width_;
}
