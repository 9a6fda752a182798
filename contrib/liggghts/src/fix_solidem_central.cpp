// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_central.h"

#include <string.h>

#include <algorithm>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "pair_solidem_central.h"
#include "solidem_restart.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

const char* const FixSolidemCentral::ID = "solidem_central";

FixSolidemCentral::FixSolidemCentral(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      totals(),
      known(false),
      atoms_known(-1),
      most_partners(0),
      last_power(0.0) {
  if (strcmp(id, ID) != 0 || !pair())
    error->fix_error(FLERR, this, "is made by 'pair_style solidem/central', not by hand");
  vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  just_created = 0;  // else the first setup would empty the arrays after they were filled
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixSolidemCentral::~FixSolidemCentral() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

PairSolidemCentral* FixSolidemCentral::pair() const {
  return dynamic_cast<PairSolidemCentral*>(force->pair_match("solidem/central", 1));
}

int FixSolidemCentral::setmask() {
  return PRE_NEIGHBOR;
}

void FixSolidemCentral::init() {
  reserve_buffers();
}

void FixSolidemCentral::setup_pre_neighbor() {
  pre_neighbor();
}

// What the pair style made of the neighbour list is about to be wrong.
void FixSolidemCentral::pre_neighbor() {
  pair()->forget_list();
  if (were_renumbered()) follow_renumbering();
}

/* ----------------------------------------------------------------------
   delete_atoms gives those that are left new tags, and later atoms may get
   tags of those that are gone: partners are told the new ones
------------------------------------------------------------------------- */

bool FixSolidemCentral::were_renumbered() const {
  if (!known) return false;
  int here = atoms_known >= 0 && atoms_known != atom->natoms, any;
  here = here || !std::equal(tags.begin(), tags.begin() + atom->nlocal, atom->tag);
  MPI_Allreduce(&here, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

void FixSolidemCentral::follow_renumbering() {
  const std::vector<int> now = new_tags();
  for (int i = 0; i < atom->nlocal; i++) {
    std::vector<Partner> kept;
    for (const Partner& partner : partners[i]) {
      const size_t before = static_cast<size_t>(partner.tag);
      if (before < now.size() && now[before] > 0) kept.push_back({now[before], partner.distance});
    }
    partners[i].swap(kept);
  }
  note_tags();
}

void FixSolidemCentral::note_tags() {
  std::copy_n(atom->tag, atom->nlocal, tags.begin());
  atoms_known = atom->natoms;
}

// By the tag before; 0: that atom is gone.
std::vector<int> FixSolidemCentral::new_tags() const {
  int here = 0, largest;
  for (int i = 0; i < atom->nlocal; i++) here = std::max(here, tags[i]);
  MPI_Allreduce(&here, &largest, 1, MPI_INT, MPI_MAX, world);
  std::vector<int> mine(largest + 1, 0), all(largest + 1);
  for (int i = 0; i < atom->nlocal; i++) mine[tags[i]] = atom->tag[i];
  mine[0] = 0;  // of atoms that are new
  MPI_Allreduce(mine.data(), all.data(), largest + 1, MPI_INT, MPI_MAX, world);
  return all;
}

/* ----------------------------------------------------------------------
   LIGGGHTS takes atoms for ghosts as if they acted no farther than their
   surfaces; these do. Half of what is asked for here, with the skin and the
   atom's own radius, must be the reach of the largest atoms
------------------------------------------------------------------------- */

double FixSolidemCentral::extend_cut_ghost() {
  double radius = 0.0, largest;
  for (int i = 0; i < atom->nlocal; i++) radius = std::max(radius, atom->radius[i]);
  MPI_Allreduce(&radius, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  return (4.0 * pair()->settings_of_style().reach() - 2.0) * largest;
}

void FixSolidemCentral::keep(int i, int tag, double distance) {
  partners[i].push_back(Partner{tag, distance});
}

void FixSolidemCentral::end_of_keeping() {
  size_t most = 0;
  for (int i = 0; i < atom->nlocal; i++) most = std::max(most, partners[i].size());
  const int here = static_cast<int>(most);
  MPI_Allreduce(&here, &most_partners, 1, MPI_INT, MPI_MAX, world);
  known = true;
  note_tags();
  reserve_buffers();
}

// For migrating atoms Comm keeps this much room besides its own.
void FixSolidemCentral::reserve_buffers() {
  comm->maxexchange_fix = std::max(comm->maxexchange_fix, maxsize_restart());
}

double FixSolidemCentral::initial_distance(int i, int tag) const {
  for (const Partner& partner : partners[i])
    if (partner.tag == tag) return partner.distance;
  return 0.0;
}

// A run begins with another look at the pose in which the run before ended.
void FixSolidemCentral::dissipate(double power) {
  if (!update->setupflag) totals.dissipated += 0.5 * (last_power + power) * update->dt;
  last_power = power;
}

double FixSolidemCentral::compute_vector(int n) {
  double here = n == 0   ? totals.interactions
                : n == 1 ? totals.interpenetration
                         : totals.dissipated,
         all;
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, n == 1 ? MPI_MAX : MPI_SUM, world);
  return all;
}

void FixSolidemCentral::write_restart(FILE* fp) {
  const std::vector<double> stored = {static_cast<double>(known),
                                      static_cast<double>(most_partners), compute_vector(1),
                                      compute_vector(2)};
  if (comm->me == 0) solidem_write_restart(fp, stored);
}

void FixSolidemCentral::restart(char* buffer) {
  const std::vector<double> stored = solidem_read_restart(error, this, buffer, 4);
  known = stored[0] != 0.0;
  most_partners = static_cast<int>(stored[1]);
  totals.interpenetration = stored[2];
  if (comm->me == 0) totals.dissipated = stored[3];
}

void FixSolidemCentral::grow_arrays(int nmax) {
  partners.resize(nmax);
  tags.resize(nmax);
}

void FixSolidemCentral::copy_arrays(int from, int to, int) {
  partners[to] = partners[from];
  tags[to] = tags[from];
}

void FixSolidemCentral::set_arrays(int i) {
  partners[i].clear();
  tags[i] = 0;
}

int FixSolidemCentral::pack_exchange(int i, double* buffer) {
  int n = 0;
  buffer[n++] = tags[i];
  buffer[n++] = static_cast<double>(partners[i].size());
  for (const Partner& partner : partners[i]) {
    buffer[n++] = partner.tag;
    buffer[n++] = partner.distance;
  }
  return n;
}

int FixSolidemCentral::unpack_exchange(int i, double* buffer) {
  tags[i] = static_cast<int>(buffer[0]);
  const int count = static_cast<int>(buffer[1]);
  partners[i].clear();
  for (int k = 0; k < count; k++) keep(i, static_cast<int>(buffer[2 + 2 * k]), buffer[3 + 2 * k]);
  return 2 + 2 * count;
}

int FixSolidemCentral::pack_restart(int i, double* buffer) {
  return solidem_seal(buffer, pack_exchange(i, buffer + SOLIDEM_RESTART_HEAD));
}

void FixSolidemCentral::unpack_restart(int i, int nth) {
  const SolidemStored stored = solidem_unseal(error, atom, this, i, nth);
  if (stored.count < 2 || stored.count != 2 + 2 * static_cast<int>(stored.numbers[1]))
    solidem_damaged(error, atom, this, i);
  unpack_exchange(i, const_cast<double*>(stored.numbers));
}

int FixSolidemCentral::size_restart(int i) {
  return SOLIDEM_RESTART_HEAD + 2 + 2 * static_cast<int>(partners[i].size());
}

int FixSolidemCentral::maxsize_restart() {
  return SOLIDEM_RESTART_HEAD + 2 + 2 * most_partners;
}

double FixSolidemCentral::memory_usage() {
  double bytes = static_cast<double>(partners.capacity() * sizeof(partners[0]));
  for (const std::vector<Partner>& list : partners)
    bytes += static_cast<double>(list.capacity() * sizeof(Partner));
  return bytes;
}
