// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_contact_list.h"

#include <algorithm>

#include "atom.h"
#include "neigh_list.h"

using namespace LAMMPS_NS;

void SolidemContactList::begin(NeighList* list) {
  list_ = list;
  hidden_.assign(atom->nlocal, 0);
}

void SolidemContactList::hide(int i, int j) {
  if (!hide_at(i, j)) hide_at(j, i);
}

void SolidemContactList::show(int i, int j) {
  if (!show_at(i, j)) show_at(j, i);
}

bool SolidemContactList::hide_at(int i, int j) {
  if (i >= static_cast<int>(hidden_.size())) return false;
  const int found = find(i, j, 0, list_->numneigh[i]);
  if (found < 0) return false;
  swap(i, found, --list_->numneigh[i]);
  hidden_[i]++;
  return true;
}

bool SolidemContactList::show_at(int i, int j) {
  if (i >= static_cast<int>(hidden_.size())) return false;
  const int seen = list_->numneigh[i];
  const int found = find(i, j, seen, seen + hidden_[i]);
  if (found < 0) return false;
  swap(i, found, seen);
  list_->numneigh[i]++;
  hidden_[i]--;
  if (const NeighList* history = list_->listgranhistory) {
    history->firstneigh[i][seen] = 0;
    std::fill_n(history->firstdouble[i] + history->dnum * seen, history->dnum, 0.0);
  }
  return true;
}

// Where atom i has atom j between two places of its list, or -1.
int SolidemContactList::find(int i, int j, int begin, int end) const {
  const int* neighbours = list_->firstneigh[i];
  for (int k = begin; k < end; k++)
    if ((neighbours[k] & NEIGHMASK) == j) return k;
  return -1;
}

void SolidemContactList::swap(int i, int a, int b) {
  std::swap(list_->firstneigh[i][a], list_->firstneigh[i][b]);
  const NeighList* history = list_->listgranhistory;
  if (!history || a == b) return;
  std::swap(history->firstneigh[i][a], history->firstneigh[i][b]);
  double* numbers = history->firstdouble[i];
  std::swap_ranges(numbers + history->dnum * a, numbers + history->dnum * (a + 1),
                   numbers + history->dnum * b);
}
