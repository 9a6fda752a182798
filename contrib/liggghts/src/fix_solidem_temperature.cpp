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
  setup(step);
}

void FixSolidemTemperature::setup(int) {
  if (!conduction->waits()) target = imposed->temperature();
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) temperature->vector_atom[i] = target;
}

void FixSolidemTemperature::end_of_step() {
  if (!conduction->leads()) move_on();
}

void FixSolidemTemperature::move_on() {
  target = imposed->temperature();
  hold();
}

void FixSolidemTemperature::hold() {
  heat_supplied += impose();
}

double FixSolidemTemperature::impose() {
  double heat = 0.0, total;
  double* temp = temperature->vector_atom;
  const int *mask = atom->mask, nlocal = atom->nlocal;
  for (int i = 0; i < nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    heat += conduction->heat_capacity(i) * (target - temp[i]);
    temp[i] = target;
  }
  MPI_Allreduce(&heat, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  return total;
}

/* ----------------------------------------------------------------------
   heat supplied to the group so far, J
------------------------------------------------------------------------- */

double FixSolidemTemperature::compute_scalar() {
  return heat_supplied;
}

void FixSolidemTemperature::write_restart(FILE* fp) {
  if (comm->me != 0) return;
  solidem_write_restart(fp, {heat_supplied, target});
}

void FixSolidemTemperature::restart(char* buffer) {
  const std::vector<double> kept = solidem_read_restart(error, this, buffer, 2);
  heat_supplied = kept[0];
  target = kept[1];
}
