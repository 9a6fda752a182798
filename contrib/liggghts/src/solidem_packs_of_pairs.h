// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// Many pairs under a central law at a time. Included once for each instruction set.
#ifndef LMP_SOLIDEM_PACKS_OF_PAIRS_H
#define LMP_SOLIDEM_PACKS_OF_PAIRS_H

#include "laws/central_interaction.hpp"
#include "laws/central_laws.hpp"
#include "laws/crack_face.hpp"
#include "solidem_rows.h"

namespace LAMMPS_NS {
namespace SOLIDEM_INSTRUCTION_SET {

/// A pack of pairs in this pose.
struct Pairs {
  PackVector chord;
  Pack distance, inverse_distance, equilibrium;
  Mask inside;
};

inline Pairs see(const SolidemCentralPacks& m, int first, const Row& i, const Row& j) {
  Pairs pairs;
  pairs.chord = first_of(j) - first_of(i);
  const Pack square = dot(pairs.chord, pairs.chord);
  pairs.distance = sqrt(square);
  pairs.inverse_distance = Pack(1.0) / pairs.distance;
  pairs.equilibrium = number_of(m.equilibrium, first);
  // Between two atoms at one place no force has a direction.
  pairs.inside = both(greater(Pack(m.range) * (i.component[3] + j.component[3]), pairs.distance),
                      greater(square, Pack(solidem::tiny_square)));
  return pairs;
}

/// Forces where some atoms are nearer than the law is followed.
inline void follow_on(const SolidemCentralPacks& m, const Pairs& pairs, Mask deep, Pack& push) {
  for (int k = 0; k < width; k++)
    if (deep[k])
      push.v[k] =
          m.continued_force(m.law, m.interpenetration, pairs.distance.v[k], pairs.equilibrium.v[k]);
}

/// Across a crack nothing is attracted.
inline void part(const SolidemCentralPacks& m, int first, const Pairs& pairs, Pack& push) {
  const Row i = gather(m.faces, m.i + first), j = gather(m.faces, m.j + first);
  const Mask apart = solidem::on_opposite_faces(first_of(i), first_of(j), pairs.chord);
  const Pack none(0.0);
  push = select(both(apart, greater(none, push)), none, push);
}

inline void hand_on(const SolidemCentralPacks& m, int first, int count, const PackVector& on_j) {
  const Pack none(0.0);
  SolidemRow of_i[width], of_j[width];
  Row{{-on_j.x, -on_j.y, -on_j.z, none, none, none, none, none}}.store(of_i->number);
  Row{{on_j.x, on_j.y, on_j.z, none, none, none, none, none}}.store(of_j->number);
  if (__builtin_expect(count == width, 1)) {
    for (int k = 0; k < width; k++) {
      add(of_i[k], m.loads[m.i[first + k]]);
      add(of_j[k], m.loads[m.j[first + k]]);
    }
    return;
  }
  for (int k = 0; k < count; k++) {
    add(of_i[k], m.loads[m.i[first + k]]);
    add(of_j[k], m.loads[m.j[first + k]]);
  }
}

inline void tell(const SolidemCentralPacks& m, int first, int count, const Pairs& pairs,
                 const Pack& over_distance) {
  for (int k = 0; k < count; k++)
    m.told[first + k] = {{over_distance.v[k], pairs.distance.v[k], pairs.inside[k] ? 1.0 : 0.0}};
}

template <class Law>
[[gnu::flatten]] void pull_by(SolidemCentralPacks& m) {
  const Law& law = *static_cast<const Law*>(m.law);
  const Pack none(0.0), deepest(1.0 / (1.0 - m.interpenetration));
  Pack interactions, compression_ratio, power;
  for (int first = 0; first < m.pairs; first += width) {
    const int left = m.pairs - first, count = left < width ? left : width;
    const Row i = gather(m.atoms, m.i + first), j = gather(m.atoms, m.j + first);
    const Pairs pairs = see(m, first, i, j);
    const solidem::Separation<Pack> at = {pairs.distance, pairs.inverse_distance,
                                          pairs.equilibrium};
    Pack push = law.force(at);
    const Pack ratio = at.compression_ratio();
    const Mask deep = both(greater(ratio, deepest), pairs.inside);
    if (__builtin_expect(any(deep), 0)) follow_on(m, pairs, deep, push);
    if (m.faces) part(m, first, pairs, push);
    const Pack owned = number_of(m.owned, first);  // of the lanes behind the last pair none
    if (m.dissipation > 0.0) {
      const Pack drag = solidem::dissipative_force(Pack(m.dissipation), pairs.chord,
                                                   pairs.inverse_distance, last_of(i) - last_of(j));
      push += drag;
      power += select(pairs.inside, owned * drag * drag, none);
    }
    interactions += select(pairs.inside, owned, none);
    compression_ratio = raise(compression_ratio, pairs.inside, ratio);
    const Pack over_distance = select(pairs.inside, push * pairs.inverse_distance, none);
    hand_on(m, first, count, over_distance * pairs.chord);
    if (m.told) tell(m, first, count, pairs, over_distance);
  }
  m.interactions = m.compression_ratio = m.power = 0.0;
  for (int k = 0; k < width; k++) {
    m.interactions += interactions.v[k];
    m.power += power.v[k];
    if (compression_ratio.v[k] > m.compression_ratio) m.compression_ratio = compression_ratio.v[k];
  }
}

template <class Table>
struct PullByLaw;
template <class... Laws>
struct PullByLaw<solidem::LawTable<Laws...>> {
  static constexpr void (*entries[])(SolidemCentralPacks&) = {pull_by<Laws>...};
};

}  // namespace SOLIDEM_INSTRUCTION_SET
}  // namespace LAMMPS_NS

#endif
