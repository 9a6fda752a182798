// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_nve_solidem.h"

#include <string.h>

#include "atom.h"
#include "error.h"
#include "fix_property_atom.h"
#include "force.h"
#include "modify.h"
#include "solidem_kernels.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixNVESolidem::FixNVESolidem(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      half_step_over_force_unit(0.0),
      step(0.0),
      translates(true),
      orientation(NULL),
      removed(NULL) {
  if (narg > 4 || (narg == 4 && strcmp(arg[3], "rotation_only") != 0))
    error->fix_error(FLERR, this, "takes no arguments but 'rotation_only'");
  translates = narg == 3;
  if (!atom->sphere_flag)
    error->fix_error(FLERR, this, "needs 'atom_style hybrid granular molecular'");
  time_integrate = 1;
}

int FixNVESolidem::setmask() {
  return INITIAL_INTEGRATE | FINAL_INTEGRATE;
}

void FixNVESolidem::init() {
  reset_dt();
  orientation = static_cast<FixPropertyAtom*>(
      modify->find_fix_property("orientation", "property/atom", "vector", 4, 0, style, false));
  if (!orientation)
    error->fix_error(FLERR, this, "needs the orientations of 'fix ID all solidem/bonds'");
  removed = static_cast<FixPropertyAtom*>(
      modify->find_fix_property("removedAtom", "property/atom", "scalar", 0, 0, style, false));
}

void FixNVESolidem::reset_dt() {
  step = update->dt;
  half_step_over_force_unit = 0.5 * update->dt * force->ftm2v;
}

// Half a step of velocity and angular velocity, then the way of `drift`, a time.
void FixNVESolidem::move(double drift) {
  const int all = atom->nlocal;
  if (all == 0) return;
  moving.resize(all);
  for (int i = 0; i < all; i++)
    moving[i] = (atom->mask[i] & groupbit) && !(removed && removed->vector_atom[i] != 0.0);
  solidem_kernels().move({all, atom->x[0], atom->v[0], atom->omega[0], orientation->array_atom[0],
                          atom->f[0], atom->torque[0], atom->rmass, atom->radius, moving.data(),
                          translates, half_step_over_force_unit, drift});
}

void FixNVESolidem::initial_integrate(int) {
  move(step);
}

void FixNVESolidem::final_integrate() {
  move(0.0);
}
