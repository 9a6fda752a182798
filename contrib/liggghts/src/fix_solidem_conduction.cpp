// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_conduction.h"

#include <stdio.h>
#include <string.h>

#include <algorithm>
#include <string>

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"
#include "error.h"
#include "fix_property_atom.h"
#include "force.h"
#include "laws/platonic_conduction.hpp"
#include "modify.h"
#include "neighbor.h"
#include "solidem_reach.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixSolidemConduction::FixSolidemConduction(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      conductivity(0.0),
      specific_heat(0.0),
      density(0.0),
      initial_temperature(0.0),
      rest_distance(NULL),
      rest_distances(NULL),
      step_of_capacities(-1.0),
      temperature(NULL),
      heat_flux(NULL),
      coordination(NULL) {
  if (igroup != 0) error->fix_error(FLERR, this, "must be used with group 'all'");
  if (!atom->avec->bonds_allow || !atom->radius_flag)
    error->fix_error(FLERR, this, "needs 'atom_style hybrid granular molecular'");

  bool law = false, has_temperature = false;
  for (int iarg = 3; iarg < narg; iarg += 2) {
    if (iarg + 1 == narg)
      error->fix_error(FLERR, this, ("keyword without value: " + std::string(arg[iarg])).c_str());
    const std::string key = arg[iarg];
    if (key == "law") {
      if (strcmp(arg[iarg + 1], "platonic") != 0)
        error->fix_error(FLERR, this, "the only law is 'platonic'");
      law = true;
      continue;
    }
    const double value = force->numeric(FLERR, arg[iarg + 1]);
    if (key == "initial_temperature") {
      initial_temperature = value;
      has_temperature = true;
      continue;
    }
    if (value <= 0.0) error->fix_error(FLERR, this, (key + " must be positive").c_str());
    if (key == "conductivity")
      conductivity = value;
    else if (key == "specific_heat")
      specific_heat = value;
    else if (key == "density")
      density = value;
    else
      error->fix_error(FLERR, this,
                       ("unknown keyword '" + key +
                        "': known are law, conductivity, specific_heat, density, "
                        "initial_temperature")
                           .c_str());
  }
  if (!law || conductivity == 0.0 || specific_heat == 0.0 || density == 0.0 || !has_temperature)
    error->fix_error(FLERR, this,
                     "needs all of: law platonic, conductivity, specific_heat, density, "
                     "initial_temperature");

  scalar_flag = 1;
  global_freq = 1;
  extscalar = 1;
  restart_peratom = 1;
  rest_distances = new SolidemBondValues(liggghts, rest_distance, 1);
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixSolidemConduction::~FixSolidemConduction() {
  if (!rest_distances) return;
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  delete rest_distances;
}

// The property of that name, made if there is none. LIGGGHTS gives a new property its initial value
// again at the end of the first set-up, unless that value is "none".
FixPropertyAtom* FixSolidemConduction::property(const char* name, const char* initial,
                                                const char* forward, const char* reverse) {
  Fix* found = modify->find_fix_property(name, "property/atom", "scalar", 0, 0, style, false);
  if (found) return static_cast<FixPropertyAtom*>(found);
  const char* command[] = {name,  "all",   "property/atom", name,   "scalar",
                           "yes", forward, reverse,         initial};
  return modify->add_fix_property_atom(9, const_cast<char**>(command), style);
}

void FixSolidemConduction::post_create() {
  find_properties();
}

int FixSolidemConduction::setmask() {
  return PRE_FORCE | POST_FORCE;
}

void FixSolidemConduction::init() {
  find_properties();
}

void FixSolidemConduction::find_properties() {
  char initial[32];
  snprintf(initial, sizeof initial, "%.17g", initial_temperature);
  temperature = property("Temp", initial, "yes", "no");
  heat_flux = property("heatFlux", "0", "no", "yes");
  coordination = property("coordination", "none", "yes", "yes");
}

double FixSolidemConduction::extend_cut_ghost() {
  return solidem_reach(atom, world);
}

void FixSolidemConduction::setup_pre_force(int) {
  build_conductors();
}

// Indices of atoms hold until the neighbour lists are built anew.
void FixSolidemConduction::pre_force(int) {
  if (neighbor->ago == 0) build_conductors();
}

/* ----------------------------------------------------------------------
   rest distances of bonds seen for the first time; true if any rank saw one
------------------------------------------------------------------------- */

bool FixSolidemConduction::see_new_bonds() {
  int seen = 0;
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < atom->num_bond[i]; m++) {
      const int partner = atom->map(atom->bond_atom[i][m]);
      if (partner < 0) {
        char message[160];
        snprintf(message, sizeof message,
                 "Fix solidem/conduction: the bond of atoms %d and %d is longer than two diameters",
                 atom->tag[i], atom->bond_atom[i][m]);
        error->one(FLERR, message);
      }
      double& distance = rest_distance[i][m][0];
      if (distance != 0.0) continue;
      seen = 1;
      const double* a = atom->x[i];
      const double* b = atom->x[domain->closest_image(i, partner)];
      distance = sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                      (b[2] - a[2]) * (b[2] - a[2]));
    }
  int seen_anywhere;
  MPI_Allreduce(&seen, &seen_anywhere, 1, MPI_INT, MPI_MAX, world);
  return seen_anywhere != 0;
}

// The number of bonds of every local atom; with newton_bond on only one of the two atoms lists a
// bond.
void FixSolidemConduction::count_bonds() {
  double* count = coordination->vector_atom;
  std::fill_n(count, atom->nlocal + atom->nghost, 0.0);
  for (int i = 0; i < atom->nlocal; i++) {
    count[i] += atom->num_bond[i];
    if (!force->newton_bond) continue;
    for (int m = 0; m < atom->num_bond[i]; m++)
      count[domain->closest_image(i, atom->map(atom->bond_atom[i][m]))] += 1.0;
  }
  if (force->newton_bond) coordination->do_reverse_comm();
}

void FixSolidemConduction::build_conductors() {
  if (see_new_bonds()) count_bonds();
  coordination->do_forward_comm();

  const double* count = coordination->vector_atom;
  const double* radius = atom->radius;
  conductors.clear();
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < atom->num_bond[i]; m++) {
      const int j = domain->closest_image(i, atom->map(atom->bond_atom[i][m]));
      if (!force->newton_bond && i > j) continue;  // the bond is listed by both
      const solidem::PlatonicElement side_i = {radius[i], count[i]};
      const solidem::PlatonicElement side_j = {radius[j], count[j]};
      conductors.push_back(
          {i, j,
           solidem::platonic_conductance(side_i, side_j, conductivity, rest_distance[i][m][0])});
    }
  step_over_capacity.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) step_over_capacity[i] = update->dt / heat_capacity(i);
  step_of_capacities = update->dt;
}

double FixSolidemConduction::heat_capacity(int i) const {
  return solidem::platonic_heat_capacity({atom->radius[i], coordination->vector_atom[i]}, density,
                                         specific_heat);
}

void FixSolidemConduction::post_force(int) {
  const int nlocal = atom->nlocal;
  const bool newton_bond = force->newton_bond;
  double* temp = temperature->vector_atom;
  double* flux = heat_flux->vector_atom;

  temperature->do_forward_comm();
  std::fill_n(flux, newton_bond ? nlocal + atom->nghost : nlocal, 0.0);
  for (const Conductor& bond : conductors) {
    const double power = bond.conductance * (temp[bond.j] - temp[bond.i]);
    flux[bond.i] += power;
    if (newton_bond || bond.j < nlocal) flux[bond.j] -= power;
  }
  if (newton_bond) heat_flux->do_reverse_comm();

  if (step_of_capacities != update->dt) {  // the time step was changed in mid-run
    for (int i = 0; i < nlocal; i++) step_over_capacity[i] = update->dt / heat_capacity(i);
    step_of_capacities = update->dt;
  }
  for (int i = 0; i < nlocal; i++) temp[i] += step_over_capacity[i] * flux[i];
}

/* ----------------------------------------------------------------------
   thermal energy of all atoms, J
------------------------------------------------------------------------- */

double FixSolidemConduction::compute_scalar() {
  double energy = 0.0, total;
  for (int i = 0; i < atom->nlocal; i++) energy += heat_capacity(i) * temperature->vector_atom[i];
  MPI_Allreduce(&energy, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  return total;
}

void FixSolidemConduction::grow_arrays(int nmax) {
  rest_distances->grow(nmax);
}
void FixSolidemConduction::copy_arrays(int i, int j, int) {
  rest_distances->copy(i, j);
}
void FixSolidemConduction::set_arrays(int i) {
  rest_distances->clear(i);
}
int FixSolidemConduction::pack_exchange(int i, double* buffer) {
  return rest_distances->pack_exchange(i, buffer);
}
int FixSolidemConduction::unpack_exchange(int i, double* buffer) {
  return rest_distances->unpack_exchange(i, buffer);
}
int FixSolidemConduction::pack_restart(int i, double* buffer) {
  return rest_distances->pack_restart(i, buffer);
}
void FixSolidemConduction::unpack_restart(int i, int nth) {
  rest_distances->unpack_restart(i, nth);
}
int FixSolidemConduction::size_restart(int i) {
  return rest_distances->size_restart(i);
}
int FixSolidemConduction::maxsize_restart() {
  return rest_distances->maxsize_restart();
}
double FixSolidemConduction::memory_usage() {
  return rest_distances->memory_usage() + conductors.capacity() * sizeof(Conductor) +
         step_over_capacity.capacity() * sizeof(double);
}
