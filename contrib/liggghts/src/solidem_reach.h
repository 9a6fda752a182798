// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_REACH_H
#define LMP_SOLIDEM_REACH_H

#include <mpi.h>

#include <algorithm>

#include "atom.h"

namespace LAMMPS_NS {

/// How far ghost atoms are needed so that every bond finds its partner: two of the largest
/// diameters, that is, a bond between touching spheres may stretch to twice its length. Collective.
inline double solidem_reach(const Atom* atom, MPI_Comm world) {
  double radius = 0.0;
  for (int i = 0; i < atom->nlocal; i++) radius = std::max(radius, atom->radius[i]);
  double largest;
  MPI_Allreduce(&radius, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  return 4.0 * largest;
}

}  // namespace LAMMPS_NS

#endif
