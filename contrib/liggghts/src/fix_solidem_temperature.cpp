// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_temperature.h"

#include <string.h>

#include <vector>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_property_atom.h"
#include "fix_solidem_conduction.h"
#include "modify.h"
#include "neighbor.h"
#include "solidem_number.h"
#include "solidem_restart.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixSolidemTemperature::FixSolidemTemperature(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      imposed(NULL),
      target(0.0),
      heat_supplied(0.0),
      conduction(NULL),
      temperature(NULL) {
  if (narg != 4) error->fix_error(FLERR, this, "takes one value: a temperature or v_NAME");
  imposed = new SolidemNumber(liggghts, this, arg[3]);
  nevery = 1;
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 1;
  restart_global = 1;
}

FixSolidemTemperature::~FixSolidemTemperature() {
  delete imposed;
}

int FixSolidemTemperature::setmask() {
  return PRE_FORCE | END_OF_STEP;
}

void FixSolidemTemperature::init() {
  conduction =
      dynamic_cast<FixSolidemConduction*>(modify->find_fix_style_strict("solidem/conduction", 0));
  if (!conduction) error->fix_error(FLERR, this, "needs a 'fix ID all solidem/conduction'");
  temperature = static_cast<FixPropertyAtom*>(
      modify->find_fix_property("Temp", "property/atom", "scalar", 0, 0, style));
  imposed->init();
}

// Before bonds act that look at temperatures, and once more after LIGGGHTS has given the property
// its initial value. Heat counts from the first step on: what the start takes is the initial
// condition's. While heat waits, the temperature is that of its last step.
void FixSolidemTemperature::setup_pre_force(int step) {
  find_held();
  setup(step);
}

void FixSolidemTemperature::pre_force(int) {
  if (neighbor->ago == 0) find_held();
}

void FixSolidemTemperature::find_held() {
  held.clear();
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) held.push_back(i);
}

void FixSolidemTemperature::setup(int) {
  if (!conduction->waits()) target = imposed->temperature();
  for (const int i : held) temperature->vector_atom[i] = target;
}

void FixSolidemTemperature::end_of_step() {
  if (!conduction->leads()) move_on();
}

void FixSolidemTemperature::move_on() {
  target = imposed->temperature();
  hold();
}

void FixSolidemTemperature::hold() {
  double heat = 0.0;
  double* temp = temperature->vector_atom;
  for (const int i : held) {
    heat += conduction->heat_capacity(i) * (target - temp[i]);
    temp[i] = target;
  }
  heat_supplied += heat;
}

/* ----------------------------------------------------------------------
   heat supplied to the group so far, J
------------------------------------------------------------------------- */

double FixSolidemTemperature::compute_scalar() {
  double total;
  MPI_Allreduce(&heat_supplied, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  return total;
}

void FixSolidemTemperature::write_restart(FILE* fp) {
  const double total = compute_scalar();
  if (comm->me != 0) return;
  solidem_write_restart(fp, {total, target});
}

void FixSolidemTemperature::restart(char* buffer) {
  const std::vector<double> kept = solidem_read_restart(error, this, buffer, 2);
  if (comm->me == 0) heat_supplied = kept[0];
  target = kept[1];
}
