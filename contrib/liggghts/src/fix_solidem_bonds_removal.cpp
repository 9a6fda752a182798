// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// Atoms that are left with too few bonds.
#include <algorithm>
#include <vector>

#include "atom.h"
#include "bond_solidem_beam.h"
#include "comm.h"
#include "fix_property_atom.h"
#include "fix_solidem_bonds.h"
#include "force.h"
#include "laws/rigid_sphere.hpp"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

typedef SolidemBondMemory Row;

}  // namespace

/* ----------------------------------------------------------------------
   atoms that lost bonds and keep too few are taken out, which may leave
   their neighbours with too few
------------------------------------------------------------------------- */

void FixSolidemBonds::remove_atoms() {
  if (minimal_bonds == 0) return;
  int broke = beams->broke(), any;
  MPI_Allreduce(&broke, &any, 1, MPI_INT, MPI_MAX, world);
  while (any) {
    count_bonds();
    int loose = mark_loose_atoms();
    MPI_Allreduce(&loose, &any, 1, MPI_INT, MPI_MAX, world);
    if (any) cut_bonds_of_removed_atoms();
  }
}

void FixSolidemBonds::count_bonds() {
  const int all = atom->nlocal + atom->nghost;
  whole_bonds.assign(all, 0.0);
  broken_bonds.assign(all, 0.0);
  std::copy_n(lost->vector_atom, atom->nlocal, broken_bonds.begin());
  for (int n = 0; n < neighbor->nbondlist; n++) {
    const bool whole = Row::is_whole(neighbor->bondhistlist[n]);
    for (int side = 0; side < 2; side++)
      (whole ? whole_bonds : broken_bonds)[neighbor->bondlist[n][side]] += 1.0;
  }
  if (force->newton_bond) comm->reverse_comm_fix(this);
}

int FixSolidemBonds::pack_reverse_comm(int n, int first, double* buffer) {
  for (int i = first; i < first + n; i++) {
    *buffer++ = whole_bonds[i];
    *buffer++ = broken_bonds[i];
  }
  return comm_reverse;
}

void FixSolidemBonds::unpack_reverse_comm(int n, int* list, double* buffer) {
  for (int k = 0; k < n; k++) {
    whole_bonds[list[k]] += *buffer++;
    broken_bonds[list[k]] += *buffer++;
  }
}

// Their motion ends, with its energy, and they stay where they are; whether there are any.
bool FixSolidemBonds::mark_loose_atoms() {
  bool any = false;
  for (int i = 0; i < atom->nlocal; i++) {
    if (removed->vector_atom[i] != 0.0 || broken_bonds[i] == 0.0 || whole_bonds[i] >= minimal_bonds)
      continue;
    any = true;
    removed->vector_atom[i] = 1.0;
    double* v = atom->v[i];
    double* omega = atom->omega[i];
    const double inertia = solidem::sphere_inertia(atom->rmass[i], atom->radius[i]);
    for (int k = 0; k < 3; k++) {
      beams->ledger.fracture_energy +=
          0.5 * force->mvv2e * (atom->rmass[i] * v[k] * v[k] + inertia * omega[k] * omega[k]);
      v[k] = omega[k] = 0.0;
    }
  }
  removed->do_forward_comm();
  return any;
}

void FixSolidemBonds::cut_bonds_of_removed_atoms() {
  const double step = static_cast<double>(update->ntimestep);
  for (int n = 0; n < neighbor->nbondlist; n++) {
    int i = neighbor->bondlist[n][0], j = neighbor->bondlist[n][1];
    double* memory_of_bond = neighbor->bondhistlist[n];
    if (removed->vector_atom[i] == 0.0 && removed->vector_atom[j] == 0.0) continue;
    if (Row::is_gone(memory_of_bond) || Row::is_cut(memory_of_bond)) continue;
    const double fraction = beams->owned_fraction(i, j);
    if (Row::is_whole(memory_of_bond)) beams->ledger.broken += fraction;
    const SolidemBeam& beam = beams->beam(neighbor->bondlist[n][2]);
    beams->ledger.fracture_energy += fraction * beam.cut(memory_of_bond, beams->ends(i, j), step);
  }
}
