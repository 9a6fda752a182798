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
#include "laws/rigid_sphere.hpp"
#include "modify.h"
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

bool FixNVESolidem::moves(int i) const {
  return (atom->mask[i] & groupbit) && !(removed && removed->vector_atom[i] != 0.0);
}

void FixNVESolidem::reset_dt() {
  step = update->dt;
  half_step_over_force_unit = 0.5 * update->dt * force->ftm2v;
}

// Half a step of velocity and angular velocity.
void FixNVESolidem::kick(int i) {
  const double per_mass = half_step_over_force_unit / atom->rmass[i];
  const double per_inertia =
      half_step_over_force_unit / solidem::sphere_inertia(atom->rmass[i], atom->radius[i]);
  for (int k = 0; k < 3; k++) {
    if (translates) atom->v[i][k] += per_mass * atom->f[i][k];
    atom->omega[i][k] += per_inertia * atom->torque[i][k];
  }
}

void FixNVESolidem::initial_integrate(int) {
  for (int i = 0; i < atom->nlocal; i++) {
    if (!moves(i)) continue;
    kick(i);
    if (translates)
      for (int k = 0; k < 3; k++) atom->x[i][k] += step * atom->v[i][k];
    double* q = orientation->array_atom[i];
    const double* omega = atom->omega[i];
    const solidem::Quaternion<double> turned =
        solidem::turn(solidem::Quaternion<double>{q[0], {q[1], q[2], q[3]}},
                      solidem::Vector3<double>{omega[0], omega[1], omega[2]}, step);
    q[0] = turned.w;
    q[1] = turned.v.x;
    q[2] = turned.v.y;
    q[3] = turned.v.z;
  }
}

void FixNVESolidem::final_integrate() {
  for (int i = 0; i < atom->nlocal; i++)
    if (moves(i)) kick(i);
}
