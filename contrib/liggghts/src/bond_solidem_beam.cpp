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

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_property_atom.h"
#include "force.h"
#include "laws/rigid_sphere.hpp"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "solidem_beam_words.h"
#include "solidem_restart.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

typedef solidem::Vector3<double> Vector;

void add(double* a, const Vector& b) {
  a[0] += b.x;
  a[1] += b.y;
  a[2] += b.z;
}

}  // namespace

BondSolidemBeam::BondSolidemBeam(LAMMPS* liggghts)
    : Bond(liggghts),
      orientation(NULL),
      motion_at_pose(NULL),
      motion_before(NULL),
      temperature(NULL),
      waiting_heat(NULL),
      after_setup_(true),
      damping_power_(0.0),
      damping_power_now_(0.0),
      contact_energy_(0.0),
      broke_(0) {
  n_granhistory(SolidemBondMemory::ELASTIC);
}

BondSolidemBeam::~BondSolidemBeam() {
  if (allocated) memory->destroy(setflag);
}

bool BondSolidemBeam::may_break() const {
  return std::any_of(beams.begin() + 1, beams.end(),
                     [](const SolidemBeam& beam) { return beam.may_break(); });
}

bool BondSolidemBeam::may_damp() const {
  return std::any_of(beams.begin() + 1, beams.end(),
                     [](const SolidemBeam& beam) { return beam.damping_ratio > 0.0; });
}

bool BondSolidemBeam::bears_moments() const {
  return std::any_of(beams.begin() + 1, beams.end(),
                     [](const SolidemBeam& beam) { return beam.law != SolidemBeam::SPRING; });
}

bool BondSolidemBeam::follows_temperature() const {
  return std::any_of(beams.begin() + 1, beams.end(),
                     [](const SolidemBeam& beam) { return beam.follows_temperature(); });
}

bool BondSolidemBeam::gives_heat() const {
  return std::any_of(beams.begin() + 1, beams.end(),
                     [](const SolidemBeam& beam) { return beam.plastic_heat > 0.0; });
}

bool BondSolidemBeam::may_expand() const {
  return std::any_of(beams.begin() + 1, beams.end(),
                     [](const SolidemBeam& beam) { return beam.expands(); });
}

void BondSolidemBeam::init_style() {
  if (!atom->sphere_flag)
    error->all(FLERR, "Bond style solidem/beam needs 'atom_style hybrid granular molecular'");
  if (modify->n_fixes_style_strict("solidem/bonds") != 1)
    error->all(FLERR, "Bond style solidem/beam needs one 'fix ID all solidem/bonds'");
  // Both ranks of a bond across a periodic face see it with another last digit; with newton_bond on
  // one of them decides.
  if (may_break() && !force->newton_bond &&
      (domain->xperiodic || domain->yperiodic || domain->zperiodic))
    error->all(FLERR,
               "Bond style solidem/beam: bonds that break in a periodic box need newton_bond on "
               "('newton off on')");
  orientation = static_cast<FixPropertyAtom*>(modify->find_fix_property(
      "orientation", "property/atom", "vector", 4, 0, "bond solidem/beam"));
  find_heat();
  motion_at_pose = motion_before = NULL;
  if (!may_damp()) return;
  if (!comm->ghost_velocity)
    error->all(FLERR, "Bond style solidem/beam: damping needs 'communicate single vel yes'");
  motion_at_pose = static_cast<FixPropertyAtom*>(modify->find_fix_property(
      "motionAtPose", "property/atom", "vector", 6, 0, "bond solidem/beam"));
  motion_before = static_cast<FixPropertyAtom*>(modify->find_fix_property(
      "motionBefore", "property/atom", "vector", 6, 0, "bond solidem/beam"));
}

/* ----------------------------------------------------------------------
   temperatures are those of whoever keeps the property Temp; heat of flow is
   given to atoms by fix solidem/conduction alone
------------------------------------------------------------------------- */

void BondSolidemBeam::find_heat() {
  temperature = waiting_heat = NULL;
  if (follows_temperature()) {
    temperature = static_cast<FixPropertyAtom*>(modify->find_fix_property(
        "Temp", "property/atom", "scalar", 0, 0, "bond solidem/beam", false));
    if (!temperature)
      error->all(FLERR,
                 "Bond style solidem/beam: expansion, softening and yield laws that look at "
                 "temperature need a 'fix ID all solidem/conduction'");
  }
  if (!gives_heat()) return;
  if (modify->n_fixes_style_strict("solidem/conduction") != 1)
    error->all(FLERR,
               "Bond style solidem/beam: plastic_heat needs a 'fix ID all solidem/conduction'");
  waiting_heat = static_cast<FixPropertyAtom*>(modify->find_fix_property(
      "waitingHeat", "property/atom", "scalar", 0, 0, "bond solidem/beam"));
}

SolidemBondEnds BondSolidemBeam::ends(int& i, int& j) const {
  if (atom->tag[i] > atom->tag[j]) std::swap(i, j);
  const double* a = atom->x[i];
  const double* b = atom->x[j];
  const double* p = orientation->array_atom[i];
  const double* q = orientation->array_atom[j];
  SolidemBondEnds place = {Vector{b[0], b[1], b[2]} - Vector{a[0], a[1], a[2]},
                           {p[0], {p[1], p[2], p[3]}},
                           {q[0], {q[1], q[2], q[3]}},
                           atom->radius[i],
                           atom->radius[j]};
  place.time_step = update->dt;
  if (!temperature) return place;
  place.temperature_i = temperature->vector_atom[i];
  place.temperature_j = temperature->vector_atom[j];
  return place;
}

double BondSolidemBeam::owned_fraction(int i, int j) const {
  if (force->newton_bond) return 1.0;
  return 0.5 * (i < atom->nlocal) + 0.5 * (j < atom->nlocal);
}

void BondSolidemBeam::compute(int eflag, int vflag) {
  if (eflag || vflag)
    ev_setup(eflag, vflag);
  else
    evflag = 0;

  orientation->do_forward_comm();
  prepare_heat();
  if (motion_at_pose) lead_motion();

  double** f = atom->f;
  double** torque = atom->torque;
  const int nlocal = atom->nlocal;
  const int newton_bond = force->newton_bond;
  const double step = static_cast<double>(update->ntimestep);
  contact_energy_ = 0.0;
  broke_ = 0;

  for (int n = 0; n < neighbor->nbondlist; n++) {
    int i = neighbor->bondlist[n][0];
    int j = neighbor->bondlist[n][1];
    const SolidemBondEnds place = ends(i, j);
    const SolidemBeam& beam = beams[neighbor->bondlist[n][2]];
    double* history = neighbor->bondhistlist[n];
    SolidemBondAction action = beam.act(history, place, step, eflag);
    if (motion_at_pose && beam.damps(history)) damp(beam, history, place, i, j, action.load);

    if (newton_bond || i < nlocal) {
      add(f[i], action.load.force);
      add(torque[i], action.load.moment_i);
    }
    if (newton_bond || j < nlocal) {
      add(f[j], -action.load.force);
      add(torque[j], action.load.moment_j);
    }
    if (action.heat_i != 0.0 || action.heat_j != 0.0) give_heat(i, j, action);
    if (action.contact_energy != 0.0)
      contact_energy_ += owned_fraction(i, j) * action.contact_energy;
    if (action.breaks || action.forms || action.fracture_energy != 0.0)
      enter(action, owned_fraction(i, j));
    if (evflag) {
      const double d[3] = {-place.chord.x, -place.chord.y, -place.chord.z};
      const Vector& force_i = action.load.force;
      const double on_i[3] = {force_i.x, force_i.y, force_i.z};
      tally(i, j, action.elastic_energy + action.contact_energy, d, on_i);
    }
  }
  if (motion_at_pose) enter_damping();
  if (waiting_heat && newton_bond) waiting_heat->do_reverse_comm();
}

void BondSolidemBeam::prepare_heat() {
  if (temperature) temperature->do_forward_comm();
  if (waiting_heat) std::fill_n(waiting_heat->vector_atom + atom->nlocal, atom->nghost, 0.0);
}

// It waits there until heat steps; with newton_bond off the other rank sees the bond too.
void BondSolidemBeam::give_heat(int i, int j, const SolidemBondAction& action) {
  double* waiting = waiting_heat->vector_atom;
  if (force->newton_bond || i < atom->nlocal) waiting[i] += action.heat_i;
  if (force->newton_bond || j < atom->nlocal) waiting[j] += action.heat_j;
}

/* ----------------------------------------------------------------------
   dashpots see velocities at the time of the pose: who integrates leaves them
   half a step behind, so they are led on along their last change; in setup
   they are there already
------------------------------------------------------------------------- */

void BondSolidemBeam::lead_motion() {
  const double dt = update->dt;
  const double kick = after_setup_ ? 0.5 * dt : dt;
  const double weight = update->setupflag ? 0.0 : solidem::lead_to_pose(dt, kick);
  after_setup_ = update->setupflag;
  for (int i = 0; i < atom->nlocal; i++) {
    const double now[6] = {atom->v[i][0],     atom->v[i][1],     atom->v[i][2],
                           atom->omega[i][0], atom->omega[i][1], atom->omega[i][2]};
    double* before = motion_before->array_atom[i];
    double* at_pose = motion_at_pose->array_atom[i];
    for (int k = 0; k < 6; k++) {
      at_pose[k] = now[k] + weight * (now[k] - before[k]);
      before[k] = now[k];
    }
  }
  motion_at_pose->do_forward_comm();
}

// Adds the loads of a bond's dashpots to those of its beam; i has the lower tag.
void BondSolidemBeam::damp(const SolidemBeam& beam, const double* history,
                           const SolidemBondEnds& place, int i, int j,
                           solidem::BeamLoad<double>& load) {
  const double* a = motion_at_pose->array_atom[i];
  const double* b = motion_at_pose->array_atom[j];
  const double mass_i = atom->rmass[i], mass_j = atom->rmass[j];
  const solidem::DashpotAction<double> action = beam.damp(
      history, place,
      {solidem_vector(b) - solidem_vector(a), solidem_vector(a + 3), solidem_vector(b + 3)},
      {1.0 / mass_i + 1.0 / mass_j, 1.0 / solidem::sphere_inertia(mass_i, atom->radius[i]) +
                                        1.0 / solidem::sphere_inertia(mass_j, atom->radius[j])});
  load.force += action.load.force;
  load.moment_i += action.load.moment_i;
  load.moment_j += action.load.moment_j;
  damping_power_now_ += owned_fraction(i, j) * action.power;
}

void BondSolidemBeam::enter_damping() {
  if (!update->setupflag)
    ledger.damping += 0.5 * update->dt * (damping_power_ + damping_power_now_);
  damping_power_ = damping_power_now_;
  damping_power_now_ = 0.0;
}

void BondSolidemBeam::enter(const SolidemBondAction& action, double fraction) {
  ledger.fracture_energy += fraction * action.fracture_energy;
  ledger.broken += fraction * action.breaks;
  ledger.formed += fraction * action.forms;
  broke_ += action.breaks;
  if (action.breaks && ledger.first_rupture == 0.0)
    ledger.first_rupture = static_cast<double>(update->ntimestep) + 1.0;
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
  beams.assign(n + 1, SolidemBeam());
}

// All bonds have rows of one width, that of the type which needs most.
void BondSolidemBeam::widen_history() {
  int width = SolidemBondMemory::ELASTIC;
  for (size_t type = 1; type < beams.size(); type++) width = std::max(width, beams[type].width());
  n_granhistory(width);
}

void BondSolidemBeam::coeff(int narg, char** arg) {
  if (!allocated) allocate();
  const SolidemBeam beam = solidem_read_beam(lmp, narg, arg);
  int low, high;
  force->bounds(arg[0], atom->nbondtypes, low, high);
  for (int type = low; type <= high; type++) {
    beams[type] = beam;
    setflag[type] = 1;
  }
  if (low > high) error->all(FLERR, "Bond style solidem/beam: no such bond type in bond_coeff");
  widen_history();
}

// Every bond has its own rest length, a type has none.
double BondSolidemBeam::equilibrium_distance(int) {
  return 0.0;
}

void BondSolidemBeam::write_restart(FILE* fp) {
  const size_t bytes = atom->nbondtypes * sizeof(SolidemBeam);
  const double checksum = solidem_checksum(&beams[1], bytes);
  fwrite(&checksum, sizeof(double), 1, fp);
  fwrite(&beams[1], 1, bytes, fp);
}

void BondSolidemBeam::read_restart(FILE* fp) {
  allocate();
  const int n = atom->nbondtypes;
  double checksum = 0.0;
  if (comm->me == 0 && (fread(&checksum, sizeof(double), 1, fp) != 1 ||
                        fread(&beams[1], sizeof(SolidemBeam), n, fp) != static_cast<size_t>(n) ||
                        checksum != solidem_checksum(&beams[1], n * sizeof(SolidemBeam))))
    error->one(FLERR,
               "The restart file is damaged, or of another version: the coefficients of bond style "
               "solidem/beam do not match their checksum");
  MPI_Bcast(&beams[1], n * sizeof(SolidemBeam), MPI_BYTE, 0, world);
  for (int i = 1; i <= n; i++) setflag[i] = 1;
  widen_history();
}

void BondSolidemBeam::write_data(FILE* fp) {
  for (int i = 1; i <= atom->nbondtypes; i++)
    fprintf(fp, "%d %s\n", i, solidem_write_beam(beams[i]).c_str());
}

// `compute bond/local` asks by type and atoms only: neither the history nor the moments can be
// told.
double BondSolidemBeam::single(int, double, int, int, double& fforce) {
  error->all(FLERR,
             "Bond style solidem/beam cannot tell a single bond's energy or force by its type: use "
             "compute solidem/bond");
  fforce = 0.0;
  return 0.0;
}
