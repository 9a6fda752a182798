// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "bond_solidem_beam.h"

#include <string.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_property_atom.h"
#include "force.h"
#include "laws/beam.hpp"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"

using namespace LAMMPS_NS;

namespace {

typedef solidem::Vector3<double> Vector;
typedef solidem::Quaternion<double> Orientation;

Vector vector(const double* a) {
  return {a[0], a[1], a[2]};
}
Orientation orientation_of(const double* q) {
  return {q[0], {q[1], q[2], q[3]}};
}

void add(double* a, const Vector& b) {
  a[0] += b.x;
  a[1] += b.y;
  a[2] += b.z;
}

}  // namespace

BondSolidemBeam::BondSolidemBeam(LAMMPS* liggghts) : Bond(liggghts), orientation(NULL) {
  n_granhistory(4);
}

BondSolidemBeam::~BondSolidemBeam() {
  if (allocated) memory->destroy(setflag);
}

void BondSolidemBeam::init_style() {
  if (!atom->sphere_flag)
    error->all(FLERR, "Bond style solidem/beam needs 'atom_style hybrid granular molecular'");
  if (modify->n_fixes_style_strict("solidem/bonds") != 1)
    error->all(FLERR, "Bond style solidem/beam needs one 'fix ID all solidem/bonds'");
  orientation = static_cast<FixPropertyAtom*>(modify->find_fix_property(
      "orientation", "property/atom", "vector", 4, 0, "bond solidem/beam"));
}

void BondSolidemBeam::compute(int eflag, int vflag) {
  if (eflag || vflag)
    ev_setup(eflag, vflag);
  else
    evflag = 0;

  orientation->do_forward_comm();

  double** x = atom->x;
  double** f = atom->f;
  double** torque = atom->torque;
  double** turned = orientation->array_atom;
  const double* radius = atom->radius;
  const int* tag = atom->tag;
  const int nlocal = atom->nlocal;
  const int newton_bond = force->newton_bond;

  for (int n = 0; n < neighbor->nbondlist; n++) {
    int i = neighbor->bondlist[n][0];
    int j = neighbor->bondlist[n][1];
    if (tag[i] > tag[j]) std::swap(i, j);
    double* rest = neighbor->bondhistlist[n];

    const Vector chord = vector(x[j]) - vector(x[i]);
    if (rest[3] == 0.0) {
      rest[3] = norm(chord);
      add(rest, (1.0 / rest[3]) * chord);
    }

    const Section& section = sections[neighbor->bondlist[n][2]];
    const double beam_radius =
        section.radius > 0.0 ? section.radius : section.ratio * 0.5 * (radius[i] + radius[j]);
    const solidem::BeamRigidity<double> rigidity = solidem::euler_bernoulli_rigidity(
        solidem::BeamSection<double>{section.young_modulus, section.shear_modulus, beam_radius});
    const solidem::BeamPose<double> pose = solidem::beam_pose(
        chord, vector(rest), orientation_of(turned[i]), orientation_of(turned[j]));
    const double rest_length = rest[3];
    const solidem::BeamLoad<double> load = solidem::beam_load(rigidity, rest_length, pose);

    if (newton_bond || i < nlocal) {
      add(f[i], load.force);
      add(torque[i], load.moment_i);
    }
    if (newton_bond || j < nlocal) {
      add(f[j], -load.force);
      add(torque[j], load.moment_j);
    }
    if (evflag) {
      const double energy_of_bond = eflag ? solidem::beam_energy(rigidity, rest_length, pose) : 0.0;
      const double d[3] = {-chord.x, -chord.y, -chord.z};
      const double force_i[3] = {load.force.x, load.force.y, load.force.z};
      tally(i, j, energy_of_bond, d, force_i);
    }
  }
}

/* ----------------------------------------------------------------------
   energy and virial, half to either atom; `d` from j to i, `f` on i.
   Bond::ev_tally is for central forces; a beam also shears, so the virial
   is the symmetric part of d f (its skew part belongs to the moments)
------------------------------------------------------------------------- */

void BondSolidemBeam::tally(int i, int j, double energy_of_bond, const double* d, const double* f) {
  const double v[6] = {d[0] * f[0],
                       d[1] * f[1],
                       d[2] * f[2],
                       0.5 * (d[0] * f[1] + d[1] * f[0]),
                       0.5 * (d[0] * f[2] + d[2] * f[0]),
                       0.5 * (d[1] * f[2] + d[2] * f[1])};
  const int ends[2] = {i, j};
  for (int side = 0; side < 2; side++) {
    const int end = ends[side];
    if (!force->newton_bond && end >= atom->nlocal) continue;
    if (eflag_global) energy += 0.5 * energy_of_bond;
    if (eflag_atom) eatom[end] += 0.5 * energy_of_bond;
    for (int k = 0; k < 6; k++) {
      if (vflag_global) virial[k] += 0.5 * v[k];
      if (vflag_atom) vatom[end][k] += 0.5 * v[k];
    }
  }
}

void BondSolidemBeam::allocate() {
  allocated = 1;
  const int n = atom->nbondtypes;
  memory->create(setflag, n + 1, "bond:setflag");
  for (int i = 1; i <= n; i++) setflag[i] = 0;
  sections.resize(n + 1);
}

/* ----------------------------------------------------------------------
   bond_coeff TYPES young_modulus shear_modulus radius R | pair RATIO
------------------------------------------------------------------------- */

void BondSolidemBeam::coeff(int narg, char** arg) {
  if (narg != 5)
    error->all(FLERR,
               "Bond style solidem/beam wants: bond_coeff TYPES YOUNG_MODULUS SHEAR_MODULUS and "
               "either 'radius R' or 'pair RATIO'");
  if (!allocated) allocate();
  Section section = {force->numeric(FLERR, arg[1]), force->numeric(FLERR, arg[2]), 0.0, 0.0};
  if (section.young_modulus <= 0.0 || section.shear_modulus < 0.0)
    error->all(FLERR,
               "Bond style solidem/beam: Young's modulus must be positive, the shear modulus not "
               "negative");
  const double thickness = force->numeric(FLERR, arg[4]);
  if (thickness <= 0.0)
    error->all(FLERR, "Bond style solidem/beam: radius or ratio must be positive");
  if (strcmp(arg[3], "radius") == 0)
    section.radius = thickness;
  else if (strcmp(arg[3], "pair") == 0)
    section.ratio = thickness;
  else
    error->all(FLERR, "Bond style solidem/beam: 'radius' or 'pair' must follow the moduli");

  int low, high;
  force->bounds(arg[0], atom->nbondtypes, low, high);
  for (int type = low; type <= high; type++) {
    sections[type] = section;
    setflag[type] = 1;
  }
  if (low > high) error->all(FLERR, "Bond style solidem/beam: no such bond type in bond_coeff");
}

// Every bond has its own rest length, a type has none.
double BondSolidemBeam::equilibrium_distance(int) {
  return 0.0;
}

void BondSolidemBeam::write_restart(FILE* fp) {
  fwrite(&sections[1], sizeof(Section), atom->nbondtypes, fp);
}

void BondSolidemBeam::read_restart(FILE* fp) {
  allocate();
  const int n = atom->nbondtypes;
  if (comm->me == 0 && fread(&sections[1], sizeof(Section), n, fp) != static_cast<size_t>(n))
    error->one(FLERR, "The restart file ends inside the coefficients of bond style solidem/beam");
  MPI_Bcast(&sections[1], n * sizeof(Section), MPI_BYTE, 0, world);
  for (int i = 1; i <= n; i++) setflag[i] = 1;
}

void BondSolidemBeam::write_data(FILE* fp) {
  for (int i = 1; i <= atom->nbondtypes; i++) {
    const bool fixed = sections[i].radius > 0.0;
    fprintf(fp, "%d %.17g %.17g %s %.17g\n", i, sections[i].young_modulus,
            sections[i].shear_modulus, fixed ? "radius" : "pair",
            fixed ? sections[i].radius : sections[i].ratio);
  }
}

// `compute bond/local` asks by type and atoms only: neither the history nor the moments can be
// told.
double BondSolidemBeam::single(int, double, int, int, double& fforce) {
  error->all(
      FLERR,
      "Bond style solidem/beam cannot tell a single bond's energy or force: use the per-atom "
      "energy (compute pe/atom bond) and forces");
  fforce = 0.0;
  return 0.0;
}
