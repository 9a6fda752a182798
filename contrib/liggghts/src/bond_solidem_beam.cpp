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
#include "memory.h"
#include "modify.h"
#include "solidem_beam_words.h"
#include "solidem_restart.h"
#include "update.h"

using namespace LAMMPS_NS;

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
      broke_(0),
      list_is_new_(true) {
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
  forget_list();
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
  SolidemBondEnds place = {solidem_vector(b) - solidem_vector(a),
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
  contact_energy_ = 0.0;
  broke_ = 0;

  if (list_is_new_) arrange();
  gather_poses();
  if (motion_at_pose) gather_motion();
  loads_.assign(poses_.size(), SolidemRow());
  for (SolidemBondPacks& packs : packs_) act(packs, evflag);
  hand_loads_on();

  if (motion_at_pose) enter_damping();
  if (waiting_heat && force->newton_bond) waiting_heat->do_reverse_comm();
}

void BondSolidemBeam::prepare_heat() {
  if (temperature) temperature->do_forward_comm();
  if (waiting_heat) std::fill_n(waiting_heat->vector_atom + atom->nlocal, atom->nghost, 0.0);
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

void BondSolidemBeam::enter_damping() {
  if (!update->setupflag)
    ledger.damping += 0.5 * update->dt * (damping_power_ + damping_power_now_);
  damping_power_ = damping_power_now_;
  damping_power_now_ = 0.0;
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
  forget_list();
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
