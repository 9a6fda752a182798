// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "compute_solidem_broken_atom.h"

#include <algorithm>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_solidem_bonds.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "solidem_beam.h"
#include "update.h"

using namespace LAMMPS_NS;

ComputeSolidemBrokenAtom::ComputeSolidemBrokenAtom(LAMMPS* liggghts, int& iarg, int narg,
                                                   char** arg)
    : Compute(liggghts, iarg, narg, arg), bonds(NULL) {
  if (narg != iarg) error->all(FLERR, "Compute solidem/broken/atom takes no arguments");
  peratom_flag = 1;
  size_peratom_cols = 0;
  comm_reverse = 1;
}

void ComputeSolidemBrokenAtom::init() {
  for (int k = 0; k < modify->nfix; k++)
    if (FixSolidemBonds* found = dynamic_cast<FixSolidemBonds*>(modify->fix[k])) bonds = found;
  if (!bonds) error->all(FLERR, "Compute solidem/broken/atom needs a 'fix ID all solidem/bonds'");
}

// Bonds that broke and still stand in the lists, and those that have left them.
void ComputeSolidemBrokenAtom::compute_peratom() {
  invoked_peratom = update->ntimestep;
  broken.assign(std::max(atom->nmax, atom->nlocal + atom->nghost), 0.0);
  vector_atom = broken.data();
  const double* gone = bonds->lost_bonds();
  if (!gone) return;  // bonds cannot break
  for (int n = 0; n < neighbor->nbondlist; n++)
    if (!SolidemBondMemory::is_whole(neighbor->bondhistlist[n]))
      for (int side = 0; side < 2; side++) broken[neighbor->bondlist[n][side]] += 1.0;
  if (force->newton_bond) comm->reverse_comm_compute(this);
  for (int i = 0; i < atom->nlocal; i++)
    broken[i] = atom->mask[i] & groupbit ? broken[i] + gone[i] : 0.0;
}

int ComputeSolidemBrokenAtom::pack_reverse_comm(int n, int first, double* buffer) {
  std::copy_n(&broken[first], n, buffer);
  return comm_reverse;
}

void ComputeSolidemBrokenAtom::unpack_reverse_comm(int n, int* list, double* buffer) {
  for (int k = 0; k < n; k++) broken[list[k]] += buffer[k];
}

double ComputeSolidemBrokenAtom::memory_usage() {
  return static_cast<double>(broken.capacity() * sizeof(double));
}
