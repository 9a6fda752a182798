// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// The memory of bonds between the lists of LIGGGHTS, its atoms, its ranks and its restart files.
#include "fix_solidem_bonds.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "atom.h"
#include "bond_solidem_beam.h"
#include "comm.h"
#include "error.h"
#include "fix_property_atom.h"
#include "force.h"
#include "neighbor.h"
#include "solidem_restart.h"

using namespace LAMMPS_NS;

namespace {

typedef SolidemBondMemory Row;

}  // namespace

/* ----------------------------------------------------------------------
   put the history of the bond list back to the atoms, before they move on;
   a bond that has left its atom's list meanwhile takes its history along
------------------------------------------------------------------------- */

void FixSolidemBonds::store_history() {
  if (!list_is_current) return;
  list_is_current = false;

  int** list = neighbor->bondlist;
  for (int n = 0; n < neighbor->nbondlist; n++) {
    const int i = list[n][0], j = list[n][1], type = list[n][2];
    int nth = 0;  // of several alike between two atoms; the list goes by first atoms
    for (int before = n - 1; before >= 0 && list[before][0] == i; before--)
      nth += atom->tag[list[before][1]] == atom->tag[j] && list[before][2] == type;
    store_row(n, i, atom->tag[j], nth);
    const bool listed_by_both = !force->newton_bond && j < atom->nlocal;
    if (listed_by_both) store_row(n, j, atom->tag[i], nth);
  }
}

void FixSolidemBonds::store_row(int n, int i, int partner, int nth) {
  double* row = history->find(i, partner, neighbor->bondlist[n][2], nth);
  if (row) std::copy_n(neighbor->bondhistlist[n], history->width(), row);
}

/* ----------------------------------------------------------------------
   bonds that are gone for good leave the lists: their atoms may part, and
   would not be found. The history is with the atoms, ghosts are still known
------------------------------------------------------------------------- */

void FixSolidemBonds::drop_gone_bonds() {
  if (!lost) return;
  double* lost_bonds = lost->vector_atom;
  std::fill_n(lost_bonds + atom->nlocal, atom->nghost, 0.0);
  double dropped = 0.0, all_dropped;
  history->settle_all();
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = atom->num_bond[i] - 1; m >= 0; m--) {
      if (!Row::is_gone(atom->bond_hist[i][m])) continue;
      lost_bonds[i] += 1.0;
      if (force->newton_bond) lost_bonds[atom->map(atom->bond_atom[i][m])] += 1.0;
      dropped += force->newton_bond ? 1.0 : 0.5;  // else both atoms list it

      const int last = --atom->num_bond[i];
      atom->bond_atom[i][m] = atom->bond_atom[i][last];
      atom->bond_type[i][m] = atom->bond_type[i][last];
      history->settle(i);
    }
  MPI_Allreduce(&dropped, &all_dropped, 1, MPI_DOUBLE, MPI_SUM, world);
  if (all_dropped == 0.0) return;
  atom->nbonds -= static_cast<bigint>(all_dropped + 0.5);
  if (force->newton_bond) lost->do_reverse_comm();
}

double FixSolidemBonds::plastic_work() {
  const bool running = list_is_current;
  store_history();
  list_is_current = running;
  history->settle_all();
  double work = gone_plastic_work;
  const double fraction = force->newton_bond ? 1.0 : 0.5;
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < atom->num_bond[i]; m++)
      work += fraction * atom->bond_hist[i][m][Row::PLASTIC_WORK];
  return work;
}

/* ----------------------------------------------------------------------
   restart files may be written in mid-run: store first, the atoms follow
------------------------------------------------------------------------- */

void FixSolidemBonds::write_restart(FILE* fp) {
  const bool running = list_is_current;
  store_history();
  list_is_current = running;

  SolidemLedger mine;
  if (beams) mine = beams->ledger;
  const double never = std::numeric_limits<double>::max();
  double sums[5] = {mine.broken, mine.formed, mine.fracture_energy, gone_plastic_work,
                    mine.damping};
  double first = mine.first_rupture == 0.0 ? never : mine.first_rupture;
  double sum[5], earliest;
  MPI_Reduce(sums, sum, 5, MPI_DOUBLE, MPI_SUM, 0, world);
  MPI_Reduce(&first, &earliest, 1, MPI_DOUBLE, MPI_MIN, 0, world);
  if (comm->me != 0) return;
  if (earliest == never) earliest = 0.0;
  solidem_write_restart(fp, {static_cast<double>(history->width()), sum[0], sum[1], sum[2], sum[3],
                             earliest, sum[4]});
}

void FixSolidemBonds::restart(char* buffer) {
  const std::vector<double> stored = solidem_read_restart(error, this, buffer, 7);
  if (static_cast<int>(stored[0]) != history->width())
    error->fix_error(FLERR, this, "the restart file holds another bond style's history");
  BondSolidemBeam* bonds = dynamic_cast<BondSolidemBeam*>(force->bond);
  if (!bonds || comm->me != 0) return;
  bonds->ledger = {stored[1], stored[2], stored[3], stored[5], stored[6]};
  gone_plastic_work = stored[4];
}

void FixSolidemBonds::grow_arrays(int nmax) {
  history->grow(nmax);
}
void FixSolidemBonds::copy_arrays(int i, int j, int) {
  history->copy(i, j);
}
void FixSolidemBonds::set_arrays(int i) {
  history->clear(i);
}
int FixSolidemBonds::pack_exchange(int i, double* buffer) {
  return history->pack_exchange(i, buffer);
}
int FixSolidemBonds::unpack_exchange(int i, double* buffer) {
  return history->unpack_exchange(i, buffer);
}
int FixSolidemBonds::pack_restart(int i, double* buffer) {
  return history->pack_restart(i, buffer);
}
void FixSolidemBonds::unpack_restart(int i, int nth) {
  history->unpack_restart(this, i, nth);
}
int FixSolidemBonds::size_restart(int i) {
  return history->size_restart(i);
}
int FixSolidemBonds::maxsize_restart() {
  return history->maxsize_restart();
}
double FixSolidemBonds::memory_usage() {
  return history->memory_usage();
}
