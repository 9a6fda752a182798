// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_bonds.h"

#include <string.h>

#include <algorithm>

#include "atom.h"
#include "atom_vec.h"
#include "bond.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_property_atom.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "solidem_reach.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixSolidemBonds::FixSolidemBonds(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg), history(NULL), list_is_current(false) {
  if (narg != 3) error->fix_error(FLERR, this, "takes no arguments");
  if (igroup != 0) error->fix_error(FLERR, this, "must be used with group 'all'");
  if (!atom->avec->bonds_allow)
    error->fix_error(FLERR, this, "needs 'atom_style hybrid granular molecular'");
  if (!force->bond || atom->n_bondhist == 0)
    error->fix_error(FLERR, this, "comes after 'bond_style', with a bond style that keeps history");
  if (atom->bond_hist) error->fix_error(FLERR, this, "the bonds' history already has an owner");

  restart_global = 1;
  restart_peratom = 1;
  history = new SolidemBondValues(liggghts, atom->bond_hist, atom->n_bondhist);
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixSolidemBonds::~FixSolidemBonds() {
  if (!history) return;
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  delete history;
}

void FixSolidemBonds::post_create() {
  if (modify->find_fix_property("orientation", "property/atom", "vector", 4, 0, style, false))
    return;
  const char* orientation[] = {
      "orientation", "all", "property/atom", "orientation", "vector", "yes", "yes", "no", "1", "0",
      "0",           "0"};
  modify->add_fix_property_atom(12, const_cast<char**>(orientation), style);
}

int FixSolidemBonds::setmask() {
  return PRE_EXCHANGE | PRE_FORCE;
}

void FixSolidemBonds::init() {
  if (!force->bond || atom->n_bondhist != history->width())
    error->fix_error(FLERR, this, "the bond style was changed: define the fix again after it");
}

// The neighbour lists were just built: from now on the bond style works on neighbor->bondhistlist.
void FixSolidemBonds::setup_pre_force(int) {
  list_is_current = true;
}

void FixSolidemBonds::pre_force(int) {
  list_is_current = true;
}

// At the start of a run Neighbor::init has emptied the list; post_run stored it in time.
void FixSolidemBonds::setup_pre_exchange() {
  list_is_current = false;
}

void FixSolidemBonds::pre_exchange() {
  store_history();
}

void FixSolidemBonds::post_run() {
  store_history();
}

double FixSolidemBonds::extend_cut_ghost() {
  return solidem_reach(atom, world);
}

/* ----------------------------------------------------------------------
   put the history of the bond list back to the atoms, before they move on;
   the loop runs in the order in which Neighbor::bond_all made the list
------------------------------------------------------------------------- */

void FixSolidemBonds::store_history() {
  if (!list_is_current) return;
  list_is_current = false;

  const int width = history->width();
  double** list = neighbor->bondhistlist;
  double*** bond_hist = atom->bond_hist;
  int n = 0;
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < atom->num_bond[i]; m++) {
      if (atom->bond_type[i][m] <= 0) continue;
      const int j = domain->closest_image(i, atom->map(atom->bond_atom[i][m]));
      if (!force->newton_bond && i > j) continue;
      if (n >= neighbor->nbondlist || neighbor->bondlist[n][0] != i)
        error->one(FLERR, "Bonds changed since the bond list was built: history would be mixed up");
      std::copy_n(list[n], width, bond_hist[i][m]);
      if (!force->newton_bond &&
          j < atom->nlocal) {  // both atoms list the bond, the list has it once
        const int* first = atom->bond_atom[j];
        const int* last = first + atom->num_bond[j];
        const int mirror = static_cast<int>(std::find(first, last, atom->tag[i]) - first);
        if (mirror < atom->num_bond[j]) std::copy_n(list[n], width, bond_hist[j][mirror]);
      }
      n++;
    }
}

/* ----------------------------------------------------------------------
   restart files may be written in mid-run: store first, the atoms follow
------------------------------------------------------------------------- */

void FixSolidemBonds::write_restart(FILE* fp) {
  const bool running = list_is_current;
  store_history();
  list_is_current = running;
  if (comm->me != 0) return;
  const int bytes = sizeof(double);
  const double width = history->width();
  fwrite(&bytes, sizeof(int), 1, fp);
  fwrite(&width, sizeof(double), 1, fp);
}

void FixSolidemBonds::restart(char* buffer) {
  double width;
  memcpy(&width, buffer, sizeof(double));
  if (static_cast<int>(width) != history->width())
    error->fix_error(FLERR, this, "the restart file holds another bond style's history");
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
  history->unpack_restart(i, nth);
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
