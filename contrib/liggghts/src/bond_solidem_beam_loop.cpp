// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// The loop over the bonds.
#include <algorithm>

#include "atom.h"
#include "bond_solidem_beam.h"
#include "fix_property_atom.h"
#include "force.h"
#include "laws/rigid_sphere.hpp"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

typedef solidem::Vector3<double> Vector;

void add(SolidemRow& sum, const Vector& force, const Vector& moment) {
  const double load[] = {force.x, force.y, force.z, 0.0, moment.x, moment.y, moment.z, 0.0};
  for (int k = 0; k < 8; k++) sum.number[k] += load[k];
}

}  // namespace

/* ----------------------------------------------------------------------
   the bonds of the list by types, those that were not yet seen made
------------------------------------------------------------------------- */

void BondSolidemBeam::arrange() {
  list_is_new_ = false;
  packs_.clear();
  for (const SolidemBeam& beam : beams) packs_.push_back(SolidemBondPacks(beam));
  for (int n = 0; n < neighbor->nbondlist; n++) {
    int i = neighbor->bondlist[n][0], j = neighbor->bondlist[n][1];
    const int type = neighbor->bondlist[n][2];
    double* memory_of_bond = neighbor->bondhistlist[n];
    const SolidemBondEnds place = ends(i, j);
    if (memory_of_bond[SolidemBondMemory::REST_LENGTH] == 0.0)
      beams[type].make(memory_of_bond, place);
    packs_[type].add(i, j, memory_of_bond, owned_fraction(i, j));
  }
  for (SolidemBondPacks& packs : packs_) {
    packs.end_of_adding();
    for (int bond = 0; bond < packs.size(); bond++) {
      int i = packs.i(bond), j = packs.j(bond);
      packs.prepare(bond, ends(i, j));
    }
  }
}

// Copied side by side, what a bond asks of an atom is one line of the cache.
void BondSolidemBeam::gather_poses() {
  const int all = atom->nlocal + atom->nghost;
  poses_.resize(all);
  for (int i = 0; i < all; i++) {
    const double* x = atom->x[i];
    const double* q = orientation->array_atom[i];
    poses_[i] = {{x[0], x[1], x[2], 0.0, q[0], q[1], q[2], q[3]}};
  }
}

void BondSolidemBeam::gather_motion() {
  motion_.resize(poses_.size());
  for (size_t i = 0; i < motion_.size(); i++) {
    const double* u = motion_at_pose->array_atom[i];
    const double mass = atom->rmass[i];
    motion_[i] = {{u[0], u[1], u[2], 1.0 / mass, u[3], u[4], u[5],
                   1.0 / solidem::sphere_inertia(mass, atom->radius[i])}};
  }
}

// `asked`: for energies or the virial.
void BondSolidemBeam::act(SolidemBondPacks& packs, bool asked) {
  if (packs.none_in_packs()) {
    for (int bond = 0; bond < packs.size(); bond++) act_alone(packs, bond, asked);
    return;
  }
  if (packs.changes_by_itself())
    for (int bond = 0; bond < packs.size(); bond++) {
      int i = packs.i(bond), j = packs.j(bond);
      packs.prepare(bond, ends(i, j));
    }
  SolidemBeamPacks now = packs.packs();
  now.poses = poses_.data();
  now.loads = loads_.data();
  if (motion_at_pose && packs.beam().damping_ratio > 0.0) now.motion = motion_.data();
  if (asked) now.told = packs.told();
  solidem_kernels().act(now);

  damping_power_now_ += now.damping_power;
  int next = 0;  // of those apart, which are in order
  if (asked)
    for (int bond = 0; bond < packs.size(); bond++) {
      if (next < now.bonds_apart && packs.apart(next) == bond) {
        next++;
        continue;
      }
      const double* told = packs.told(bond).number;
      tally(packs.i(bond), packs.j(bond), told[0], {told[1], told[2], told[3]});
    }
  for (int k = 0; k < now.bonds_apart; k++) act_alone(packs, packs.apart(k), asked);
}

// A bond that broke or is near its limit.
void BondSolidemBeam::act_alone(SolidemBondPacks& packs, int bond, bool asked) {
  int i = packs.i(bond), j = packs.j(bond);
  const SolidemBondEnds place = ends(i, j);
  const SolidemBeam& beam = packs.beam();
  double* memory_of_bond = packs.memory(bond);
  SolidemBondAction action =
      beam.act(memory_of_bond, place, static_cast<double>(update->ntimestep), asked);
  packs.prepare(bond, place);  // it may have flowed, or be another
  if (motion_at_pose && beam.damps(memory_of_bond)) damp(packs, bond, place, action.load);
  add(loads_[i], action.load.force, action.load.moment_i);
  add(loads_[j], -action.load.force, action.load.moment_j);

  if (action.heat_of_each != 0.0) give_heat(i, j, action);
  const double owned = packs.owned(bond);
  contact_energy_ += owned * action.contact_energy;
  if (action.breaks || action.forms || action.fracture_energy != 0.0) enter(action, owned);
  if (asked) tally(i, j, action.elastic_energy + action.contact_energy, action.load.force);
}

// Adds the loads of a bond's dashpots to those of its beam; i has the lower tag.
void BondSolidemBeam::damp(const SolidemBondPacks& packs, int bond, const SolidemBondEnds& place,
                           solidem::BeamLoad<double>& load) {
  const double* a = motion_[packs.i(bond)].number;
  const double* b = motion_[packs.j(bond)].number;
  const solidem::DashpotAction<double> action = packs.beam().damp(
      packs.memory(bond), place,
      {solidem_vector(b) - solidem_vector(a), solidem_vector(a + 4), solidem_vector(b + 4)},
      {a[3] + b[3], a[7] + b[7]});
  load.force += action.load.force;
  load.moment_i += action.load.moment_i;
  load.moment_j += action.load.moment_j;
  damping_power_now_ += packs.owned(bond) * action.power;
}

// With newton_bond off ghosts get theirs from the other rank, which sees the bond too.
void BondSolidemBeam::hand_loads_on() {
  const int all = force->newton_bond ? atom->nlocal + atom->nghost : atom->nlocal;
  for (int i = 0; i < all; i++)
    for (int k = 0; k < 3; k++) {
      atom->f[i][k] += loads_[i].number[k];
      atom->torque[i][k] += loads_[i].number[4 + k];
    }
}

// It waits there until heat steps; with newton_bond off the other rank sees the bond too.
void BondSolidemBeam::give_heat(int i, int j, const SolidemBondAction& action) {
  double* waiting = waiting_heat->vector_atom;
  if (force->newton_bond || i < atom->nlocal) waiting[i] += action.heat_of_each;
  if (force->newton_bond || j < atom->nlocal) waiting[j] += action.heat_of_each;
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
   energy and virial, half to either atom. Bond::ev_tally is for central
   forces; a beam also shears, so the virial is the symmetric part of d f, d
   from j to i (its skew part belongs to the moments)
------------------------------------------------------------------------- */

void BondSolidemBeam::tally(int i, int j, double energy_of_bond, const Vector& force_on_i) {
  const double* a = atom->x[i];
  const double* b = atom->x[j];
  const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  const double f[3] = {force_on_i.x, force_on_i.y, force_on_i.z};
  const double v[6] = {d[0] * f[0],
                       d[1] * f[1],
                       d[2] * f[2],
                       0.5 * (d[0] * f[1] + d[1] * f[0]),
                       0.5 * (d[0] * f[2] + d[2] * f[0]),
                       0.5 * (d[1] * f[2] + d[2] * f[1])};
  for (const int end : {i, j}) {
    if (!force->newton_bond && end >= atom->nlocal) continue;
    if (eflag_global) energy += 0.5 * energy_of_bond;
    if (eflag_atom) eatom[end] += 0.5 * energy_of_bond;
    for (int k = 0; k < 6; k++) {
      if (vflag_global) virial[k] += 0.5 * v[k];
      if (vflag_atom) vatom[end][k] += 0.5 * v[k];
    }
  }
}
