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

#include <algorithm>

#include "atom.h"
#include "error.h"
#include "memory.h"

using namespace LAMMPS_NS;

SolidemBondValues::SolidemBondValues(LAMMPS* liggghts, double***& array, int width)
    : Pointers(liggghts), array_(array), width_(width), bonds_per_atom_(0), rows_(0) {
  array_ = NULL;
}

SolidemBondValues::~SolidemBondValues() {
  memory->destroy(array_);
  array_ = NULL;
}

void SolidemBondValues::grow(int nmax) {
  if (array_ && bonds_per_atom_ != atom->bond_per_atom)
    error->all(FLERR,
               "The number of bonds per atom changed while values are kept with the bonds: reserve "
               "room with the header line 'N extra bond per atom' of the data file");
  if (nmax <= rows_) return;
  bonds_per_atom_ = atom->bond_per_atom;
  memory->grow(array_, nmax, std::max(bonds_per_atom_, 1), width_, "solidem:bond_values");
  for (int i = rows_; i < nmax; i++)
    for (int m = 0; m < bonds_per_atom_; m++) std::fill_n(array_[i][m], width_, 0.0);
  rows_ = nmax;
}

void SolidemBondValues::copy(int from, int to) {
  for (int m = 0; m < atom->num_bond[from]; m++)
    std::copy_n(array_[from][m], width_, array_[to][m]);
}

void SolidemBondValues::clear(int i) {
  for (int m = 0; m < bonds_per_atom_; m++) std::fill_n(array_[i][m], width_, 0.0);
}

void SolidemBondValues::forget(int i, int m) {
  const int last = atom->num_bond[i] - 1;
  if (m != last) std::copy_n(array_[i][last], width_, array_[i][m]);
  std::fill_n(array_[i][last], width_, 0.0);
}

int SolidemBondValues::pack_exchange(int i, double* buffer) const {
  int n = 0;
  buffer[n++] = atom->num_bond[i];
  for (int m = 0; m < atom->num_bond[i]; m++)
    for (int k = 0; k < width_; k++) buffer[n++] = array_[i][m][k];
  return n;
}

int SolidemBondValues::unpack_exchange(int i, const double* buffer) {
  int n = 0;
  const int bonds = static_cast<int>(buffer[n++]);
  for (int m = 0; m < bonds; m++)
    for (int k = 0; k < width_; k++) array_[i][m][k] = buffer[n++];
  return n;
}

// LIGGGHTS' convention: the first number of a fix's restart data is its length.

int SolidemBondValues::pack_restart(int i, double* buffer) const {
  buffer[0] = 1 + pack_exchange(i, buffer + 1);
  return static_cast<int>(buffer[0]);
}

void SolidemBondValues::unpack_restart(int i, int nth) {
  const double* stored = atom->extra[i];
  for (int fix = 0; fix < nth; fix++) stored += static_cast<int>(stored[0]);
  unpack_exchange(i, stored + 1);
}

int SolidemBondValues::size_restart(int i) const {
  return 2 + width_ * atom->num_bond[i];
}

int SolidemBondValues::maxsize_restart() const {
  return 2 + width_ * atom->bond_per_atom;
}

double SolidemBondValues::memory_usage() const {
  return static_cast<double>(rows_) * bonds_per_atom_ * (width_ * sizeof(double) + sizeof(double*));
}

int SolidemBondValues::most_numbers_of_an_atom() const {
  int most = 0;
  for (int i = 0; i < atom->nlocal; i++) most = std::max(most, atom->num_bond[i]);
  return 1 + most * width_;
}
