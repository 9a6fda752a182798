// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// Many atoms at a time. Included once for each instruction set.
#ifndef LMP_SOLIDEM_PACKS_OF_ATOMS_H
#define LMP_SOLIDEM_PACKS_OF_ATOMS_H

#include "laws/rigid_sphere.hpp"
#include "solidem_rows.h"

namespace LAMMPS_NS {
namespace SOLIDEM_INSTRUCTION_SET {

/// Vectors of atoms that follow one another, as long as there are any.
inline PackVector load_vectors(const double* first, int count) {
  PackVector vector;
  for (int k = 0; k < count; k++) {
    vector.x.v[k] = first[3 * k];
    vector.y.v[k] = first[3 * k + 1];
    vector.z.v[k] = first[3 * k + 2];
  }
  return vector;
}
inline void store_vectors(const PackVector& vector, double* first, int count, const char* which) {
  for (int k = 0; k < count; k++) {
    if (!which[k]) continue;
    first[3 * k] = vector.x.v[k];
    first[3 * k + 1] = vector.y.v[k];
    first[3 * k + 2] = vector.z.v[k];
  }
}

inline void turn(const SolidemMovingAtoms& m, int first, int count, const PackVector& omega) {
  double* rows = m.orientation + 4 * first;
  PackQuaternion now;
  for (int k = 0; k < count; k++) {
    now.w.v[k] = rows[4 * k];
    now.v.x.v[k] = rows[4 * k + 1];
    now.v.y.v[k] = rows[4 * k + 2];
    now.v.z.v[k] = rows[4 * k + 3];
  }
  now = solidem::turn(now, omega, Pack(m.drift));
  for (int k = 0; k < count; k++) {
    if (!m.moves[first + k]) continue;
    rows[4 * k] = now.w.v[k];
    rows[4 * k + 1] = now.v.x.v[k];
    rows[4 * k + 2] = now.v.y.v[k];
    rows[4 * k + 3] = now.v.z.v[k];
  }
}

inline void move_pack(const SolidemMovingAtoms& m, int first, int count) {
  const char* moves = m.moves + first;
  const int at = 3 * first;
  Pack mass(1.0), radius(1.0);
  for (int k = 0; k < count; k++) {
    mass.v[k] = m.mass[first + k];
    radius.v[k] = m.radius[first + k];
  }
  if (m.translates) {
    const PackVector v =
        load_vectors(m.v + at, count) + (Pack(m.kick) / mass) * load_vectors(m.f + at, count);
    store_vectors(v, m.v + at, count, moves);
    if (m.drift != 0.0)
      store_vectors(load_vectors(m.x + at, count) + Pack(m.drift) * v, m.x + at, count, moves);
  }
  const PackVector omega =
      load_vectors(m.omega + at, count) +
      (Pack(m.kick) / solidem::sphere_inertia(mass, radius)) * load_vectors(m.torque + at, count);
  store_vectors(omega, m.omega + at, count, moves);
  if (m.drift != 0.0) turn(m, first, count, omega);
}

[[gnu::flatten]] inline void move(const SolidemMovingAtoms& m) {
  int first = 0;
  for (; first + width <= m.atoms; first += width) move_pack(m, first, width);
  if (first < m.atoms) move_pack(m, first, m.atoms - first);
}

}  // namespace SOLIDEM_INSTRUCTION_SET
}  // namespace LAMMPS_NS

#endif
