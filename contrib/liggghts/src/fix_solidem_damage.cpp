// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_damage.h"

#include <string.h>

#include <algorithm>
#include <string>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "laws/crack_face.hpp"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_solidem_central.h"
#include "solidem_restart.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

typedef solidem::Vector3<double> Vector;

}  // namespace

FixSolidemDamage::FixSolidemDamage(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      crack_threshold(0.0),
      every(1),
      minimal_neighbours(0),
      removal_every(100),
      begun(false),
      last_removal(-1),
      state(NULL),
      pair(NULL) {
  if (igroup != 0) error->fix_error(FLERR, this, "must be used with group 'all'");
  for (int k = 3; k < narg; k += 2) {
    const std::string name = arg[k];
    if (name != "crack_threshold" && name != "every" && name != "minimal_neighbours" &&
        name != "removal_every")
      error->fix_error(FLERR, this,
                       ("unknown word '" + name +
                        "'; known are crack_threshold, every, minimal_neighbours, removal_every")
                           .c_str());
    if (k + 1 == narg) error->fix_error(FLERR, this, ("'" + name + "' has no value").c_str());
    const double value = force->numeric(FLERR, arg[k + 1]);
    const bool is_count = name != "crack_threshold";
    const double least = name == "minimal_neighbours" ? 0.0 : 1.0;
    if (is_count && (value < least || value != static_cast<int>(value)))
      error->fix_error(FLERR, this,
                       (name + " must be a whole number from " + (least == 0.0 ? "0" : "1") +
                        ", not " + arg[k + 1])
                           .c_str());
    if (!is_count && !(value > 0.0))
      error->fix_error(FLERR, this,
                       ("crack_threshold must be above 0, not " + std::string(arg[k + 1])).c_str());
    if (name == "crack_threshold") crack_threshold = value;
    if (name == "every") every = static_cast<int>(value);
    if (name == "minimal_neighbours") minimal_neighbours = static_cast<int>(value);
    if (name == "removal_every") removal_every = static_cast<int>(value);
  }
  if (crack_threshold == 0.0 && minimal_neighbours == 0)
    error->fix_error(FLERR, this,
                     "looks for nothing: give crack_threshold C, such as crack_threshold 0.4, or "
                     "minimal_neighbours M");

  vector_flag = 1;
  size_vector = 2;
  global_freq = 1;
  extvector = 0;
  peratom_flag = 1;
  size_peratom_cols = WIDTH;
  peratom_freq = 1;
  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  just_created = 0;  // else the first setup would empty the arrays after they were filled
  comm_forward = 4;
  grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixSolidemDamage::~FixSolidemDamage() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  memory->destroy(state);
}

int FixSolidemDamage::setmask() {
  return PRE_FORCE;
}

void FixSolidemDamage::init() {
  pair = dynamic_cast<PairSolidemCentral*>(force->pair_match("solidem/central", 1));
  if (!pair) error->fix_error(FLERR, this, "needs 'pair_style solidem/central'");
  int damages = 0;
  for (int k = 0; k < modify->nfix; k++)
    if (dynamic_cast<FixSolidemDamage*>(modify->fix[k])) damages++;
  if (damages > 1) error->fix_error(FLERR, this, "must be the only one of its style");
}

void FixSolidemDamage::setup_pre_force(int vflag) {
  pre_force(vflag);
}

/* ----------------------------------------------------------------------
   positions are those of this step, forces are about to be
------------------------------------------------------------------------- */

void FixSolidemDamage::pre_force(int) {
  const bigint step = update->ntimestep;
  const bool removes =
      minimal_neighbours > 0 && step % removal_every == 0 && step != last_removal && begun;
  if (neighbor->ago == 0) comm->forward_comm_fix(this);  // there are new ghosts
  if (removes) {
    look_around(false);
    remove_isolated_atoms();
    last_removal = step;
  }
  if (!begun || step % every == 0) look_around(finds_crack_faces());
  if (begun) return;
  for (int i = 0; i < atom->nlocal; i++) state[i][AT_START] = state[i][NEIGHBOURS];
  begun = true;
}

// Counts neighbours and, if so wanted, finds crack faces.
void FixSolidemDamage::look_around(bool for_crack_faces) {
  std::vector<Vector> sum(atom->nlocal);
  std::vector<double> count(atom->nlocal, 0.0);
  for (const PairSolidemCentral::Listed& listed : pair->listed()) {
    const PairSolidemCentral::Seen seen = pair->see(listed.i, listed.j);
    if (!seen.inside) continue;
    sum[listed.i] += seen.chord;
    count[listed.i] += 1.0;
    if (listed.j >= atom->nlocal) continue;
    sum[listed.j] -= seen.chord;
    count[listed.j] += 1.0;
  }
  for (int i = 0; i < atom->nlocal; i++) {
    double* mine = state[i];
    mine[NEIGHBOURS] = count[i];
    if (!for_crack_faces) continue;
    const Vector shown =
        solidem::crack_face_barycentre(sum[i], count[i], crack_threshold * atom->radius[i]);
    mine[SHOWN] = shown.x;
    mine[SHOWN + 1] = shown.y;
    mine[SHOWN + 2] = shown.z;
    mine[CRACK_FACE] = dot(shown, shown) > 0.0;
  }
  if (for_crack_faces) comm->forward_comm_fix(this);
}

// Those that have lost neighbours and keep too few stay where they are from now on.
void FixSolidemDamage::remove_isolated_atoms() {
  for (int i = 0; i < atom->nlocal; i++) {
    double* mine = state[i];
    if (is_removed(i) || mine[NEIGHBOURS] >= minimal_neighbours ||
        mine[NEIGHBOURS] >= mine[AT_START])
      continue;
    mine[REMOVED] = 1.0;
    mine[NEIGHBOURS] = 0.0;
    std::fill_n(atom->v[i], 3, 0.0);
    if (atom->omega) std::fill_n(atom->omega[i], 3, 0.0);
  }
  comm->forward_comm_fix(this);
}

double FixSolidemDamage::compute_vector(int n) {
  double here = 0.0, all;
  for (int i = 0; i < atom->nlocal; i++) here += state[i][n == 0 ? CRACK_FACE : REMOVED];
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

int FixSolidemDamage::pack_comm(int n, int* list, double* buffer, int, int*) {
  for (int k = 0; k < n; k++) {
    buffer = std::copy_n(state[list[k]] + SHOWN, 3, buffer);
    *buffer++ = state[list[k]][REMOVED];
  }
  return comm_forward;
}

void FixSolidemDamage::unpack_comm(int n, int first, double* buffer) {
  for (int i = first; i < first + n; i++) {
    std::copy_n(buffer, 3, state[i] + SHOWN);
    state[i][REMOVED] = buffer[3];
    buffer += comm_forward;
  }
}

void FixSolidemDamage::write_restart(FILE* fp) {
  if (comm->me != 0) return;
  solidem_write_restart(fp, {static_cast<double>(begun), static_cast<double>(last_removal)});
}

void FixSolidemDamage::restart(char* buffer) {
  const std::vector<double> stored = solidem_read_restart(error, this, buffer, 2);
  begun = stored[0] != 0.0;
  last_removal = static_cast<bigint>(stored[1]);
}

void FixSolidemDamage::grow_arrays(int nmax) {
  memory->grow(state, nmax, WIDTH, "solidem/damage:state");
  array_atom = state;
}

void FixSolidemDamage::copy_arrays(int from, int to, int) {
  std::copy_n(state[from], WIDTH, state[to]);
}

void FixSolidemDamage::set_arrays(int i) {
  std::fill_n(state[i], WIDTH, 0.0);
}

int FixSolidemDamage::pack_exchange(int i, double* buffer) {
  std::copy_n(state[i], WIDTH, buffer);
  return WIDTH;
}

int FixSolidemDamage::unpack_exchange(int i, double* buffer) {
  std::copy_n(buffer, WIDTH, state[i]);
  return WIDTH;
}

int FixSolidemDamage::pack_restart(int i, double* buffer) {
  return solidem_seal(buffer, pack_exchange(i, buffer + SOLIDEM_RESTART_HEAD));
}

void FixSolidemDamage::unpack_restart(int i, int nth) {
  const SolidemStored stored = solidem_unseal(error, atom, this, i, nth);
  if (stored.count != WIDTH) solidem_damaged(error, atom, this, i);
  std::copy_n(stored.numbers, WIDTH, state[i]);
}

int FixSolidemDamage::size_restart(int) {
  return maxsize_restart();
}

int FixSolidemDamage::maxsize_restart() {
  return SOLIDEM_RESTART_HEAD + WIDTH;
}

double FixSolidemDamage::memory_usage() {
  return static_cast<double>(atom->nmax) * WIDTH * sizeof(double);
}
