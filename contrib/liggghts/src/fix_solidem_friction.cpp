// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_friction.h"

#include <string.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_property_atom.h"
#include "fix_property_global.h"
#include "fix_solidem_conduction.h"
#include "force.h"
#include "laws/linear_contact.hpp"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "pair_gran.h"
#include "solidem_restart.h"
#include "solidem_waiting_heat.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

typedef solidem::Vector3<double> Vector;

Vector vector_of(const double* a) {
  return {a[0], a[1], a[2]};
}

}  // namespace

FixSolidemFriction::FixSolidemFriction(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      fraction(1.0),
      usual_reach(0.0),
      work(0.0),
      contacts(NULL),
      stiffness(NULL),
      conduction(NULL),
      waiting_heat(NULL) {
  if (igroup != 0) error->fix_error(FLERR, this, "must be used with group 'all'");
  read_arguments(narg, arg);
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 1;
  vector_flag = tools.empty() ? 0 : 1;
  size_vector = static_cast<int>(tools.size());
  extvector = 1;
  restart_global = 1;
}

FixSolidemFriction::~FixSolidemFriction() {
  leave_walls(modify);
}

void FixSolidemFriction::read_arguments(int narg, char** arg) {
  for (int iarg = 3; iarg < narg;) {
    const std::string key = arg[iarg];
    const int values = key == "fraction" ? 1 : key == "tool" ? 2 : 0;
    if (values == 0)
      error->fix_error(FLERR, this,
                       ("unknown keyword '" + key + "': known are fraction, tool").c_str());
    if (iarg + values >= narg)
      error->fix_error(FLERR, this, ("keyword without value: " + key).c_str());
    const std::string last = arg[iarg + values];
    const double value = force->numeric(FLERR, arg[iarg + values]);
    if (values == 1) {
      fraction = value;
      if (!(fraction >= 0.0 && fraction <= 1.0))
        error->fix_error(FLERR, this, ("fraction must be from 0 to 1, but is " + last).c_str());
    } else {
      tools.push_back({arg[iarg + 1], value, 0.0, NULL});
      if (!(value >= 0.0))
        error->fix_error(
            FLERR, this,
            ("the effusivity of tool " + tools.back().id + " must not be negative, but is " + last)
                .c_str());
    }
    iarg += 1 + values;
  }
}

void FixSolidemFriction::post_create() {
  waiting_heat = solidem_waiting_heat(modify, atom->nlocal, style);
}

int FixSolidemFriction::setmask() {
  return PRE_FORCE | POST_FORCE;
}

void FixSolidemFriction::init() {
  conduction =
      dynamic_cast<FixSolidemConduction*>(modify->find_fix_style_strict("solidem/conduction", 0));
  if (!conduction) error->fix_error(FLERR, this, "needs a 'fix ID all solidem/conduction'");
  waiting_heat = solidem_waiting_heat(modify, atom->nlocal, style);
  find_pair_style();
  const int walls = watch_walls(modify, error, this, conduction);
  if (!contacts && walls == 0)
    error->fix_error(FLERR, this,
                     "needs 'pair_style gran model hooke/stiffness tangential history', or a fix "
                     "wall/gran of that model, without further models that remember contacts");
  for (Tool& tool : tools) tool.fix = find_tool(modify, error, this, tool.id);
  stiffness = static_cast<FixPropertyGlobal*>(modify->find_fix_property(
      "kt", "property/global", "peratomtypepair", atom->ntypes, atom->ntypes, style));
  require_order();
  // As far as this those that part are looked at, and forget their springs.
  neighbor->register_contact_dist_factor(1.01);
}

void FixSolidemFriction::find_pair_style() {
  Pair* any = force->pair_match("gran", 0);
  contacts = dynamic_cast<PairGran*>(any);
  if (any && (!contacts || !contacts->contact_match("normal", "hooke/stiffness") ||
              !contacts->contact_match("tangential", "history") || contacts->dnum() != 3))
    error->fix_error(FLERR, this,
                     "needs 'pair_style gran model hooke/stiffness tangential history' without "
                     "further models that remember contacts");
}

// Fix solidem/bonds hides the bonded pairs of a new list.
void FixSolidemFriction::require_order() const {
  for (int k = modify->find_fix(id) + 1; k < modify->nfix; k++)
    if (strcmp(modify->fix[k]->style, "solidem/bonds") == 0)
      error->all(FLERR, "Fix solidem/friction must be defined after fix solidem/bonds");
}

// Walls look at what has parted as far as pairs do, which is not at all without a pair style: then
// they would keep the springs.
void FixSolidemFriction::pre_force(int) {
  usual_reach = neighbor->cutneighmax;
  neighbor->cutneighmax = std::max(usual_reach, neighbor->skin);
  if (!contacts) return;
  springs.clear();
  const NeighList *list = contacts->list, *history = contacts->listgranhistory;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const double* own = history->firstdouble[i];
    springs.insert(springs.end(), own, own + 3 * list->numneigh[i]);
  }
}

void FixSolidemFriction::post_force(int) {
  neighbor->cutneighmax = usual_reach;
  if (conduction->leads()) enter();
}

// Two ranks list a pair that they share, for such pair styles need newton_pair off.
void FixSolidemFriction::enter() {
  if (!contacts) return;
  const NeighList *list = contacts->list, *history = contacts->listgranhistory;
  double* waiting = waiting_heat->vector_atom;
  const double* before = springs.data();
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const double* after = history->firstdouble[i];
    for (int jj = 0; jj < list->numneigh[i]; jj++, before += 3, after += 3) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      const double taken = slip_work(i, j, before, after);
      if (taken == 0.0) continue;
      const bool owned = j < atom->nlocal;
      work += owned ? taken : 0.5 * taken;
      waiting[i] += 0.5 * fraction * taken;
      if (owned) waiting[j] += 0.5 * fraction * taken;
    }
  }
}

/* ----------------------------------------------------------------------
   of two whose spring was `before` and is `after` now, J. LIGGGHTS' spring is
   the way of i along j, the law's that of j along i. The law turns it with
   the normal and keeps its length, LIGGGHTS leaves out what points along the
   normal: what energy that takes from the spring counts as slip
------------------------------------------------------------------------- */

double FixSolidemFriction::slip_work(int i, int j, const double* before,
                                     const double* after) const {
  const Vector to = vector_of(atom->x[j]) - vector_of(atom->x[i]);
  const double reach = atom->radius[i] + atom->radius[j];
  const bool touches = dot(to, to) < reach * reach;
  const bool touched = before[0] != 0.0 || before[1] != 0.0 || before[2] != 0.0;
  if (!touches && !touched) return 0.0;
  const double length = sqrt(dot(to, to)), overlap = reach - length;
  const Vector normal = (1.0 / length) * to;
  const Vector approach = vector_of(atom->v[j]) - vector_of(atom->v[i]);
  const Vector to_before = to - update->dt * approach;
  const Vector normal_before = (1.0 / sqrt(dot(to_before, to_before))) * to_before;
  const double arm_i = atom->radius[i] - 0.5 * overlap, arm_j = atom->radius[j] - 0.5 * overlap;
  const Vector velocity =
      approach -
      cross(arm_i * vector_of(atom->omega[i]) + arm_j * vector_of(atom->omega[j]), normal);
  const Vector turned = onto_tangent_plane(-vector_of(before), normal_before, normal);
  const Vector trial = turned + update->dt * (velocity - dot(velocity, normal) * normal);
  const Vector spring = touches ? -vector_of(after) : Vector{0.0, 0.0, 0.0};
  const double square = dot(trial, trial);
  if (square == 0.0) return 0.0;
  const double kept = std::min(1.0, sqrt(dot(spring, spring) / square));
  const double of_pair = stiffness->get_array()[atom->type[i] - 1][atom->type[j] - 1];
  return solidem::slip_work(of_pair, kept, turned, trial);
}

/* ----------------------------------------------------------------------
   LIGGGHTS leaves out of the spring what points along a normal that turned,
   the law keeps the length: the energy of that counts as slip here, too
------------------------------------------------------------------------- */

void FixSolidemFriction::see(const SolidemTouch& touch) {
  if (!touch.slips) return;
  const Vector along = touch.before - dot(touch.before, touch.normal) * touch.normal;
  const double square_along = dot(along, along);
  const Vector turned = square_along > 0.0
                            ? sqrt(dot(touch.before, touch.before) / square_along) * along
                            : Vector{0.0, 0.0, 0.0};
  const Vector trial = turned + update->dt * touch.velocity;
  const double square = dot(trial, trial);
  if (square == 0.0) return;
  const double kept = std::min(1.0, sqrt(dot(touch.after, touch.after) / square));
  const double of_wall = stiffness->get_array()[atom->type[touch.i] - 1][touch.type - 1];
  const double taken = solidem::slip_work(of_wall, kept, turned, trial);
  work += taken;
  double share = 1.0;
  for (Tool& one : tools)
    if (one.fix == touch.tool) {
      const double own = conduction->effusivity();
      share = own / (own + one.effusivity);
      one.heat += (1.0 - share) * fraction * taken;
    }
  waiting_heat->vector_atom[touch.i] += share * fraction * taken;
}

/* ----------------------------------------------------------------------
   of all ranks
------------------------------------------------------------------------- */

double FixSolidemFriction::total(double here) const {
  double all;
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   work of slip so far, J
------------------------------------------------------------------------- */

double FixSolidemFriction::compute_scalar() {
  return total(work);
}

/* ----------------------------------------------------------------------
   heat that the n-th tool took so far, J
------------------------------------------------------------------------- */

double FixSolidemFriction::compute_vector(int n) {
  return total(tools[n].heat);
}

void FixSolidemFriction::write_restart(FILE* fp) {
  std::vector<double> totals;
  for (const Tool& tool : tools) totals.push_back(total(tool.heat));
  totals.push_back(total(work));
  if (comm->me == 0) solidem_write_restart(fp, totals);
}

void FixSolidemFriction::restart(char* buffer) {
  const int count = static_cast<int>(tools.size());
  const std::vector<double> totals = solidem_read_restart(error, this, buffer, count + 1);
  if (comm->me != 0) return;
  for (int k = 0; k < count; k++) tools[k].heat = totals[k];
  work = totals[count];
}

double FixSolidemFriction::memory_usage() {
  return springs.capacity() * sizeof(double);
}
