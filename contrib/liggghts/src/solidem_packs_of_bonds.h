// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// Many bonds at a time. Included once for each instruction set.
#ifndef LMP_SOLIDEM_PACKS_OF_BONDS_H
#define LMP_SOLIDEM_PACKS_OF_BONDS_H

#include "laws/beam_plasticity.hpp"
#include "laws/bond_damping.hpp"
#include "solidem_bond_memory.h"
#include "solidem_rows.h"

namespace LAMMPS_NS {
namespace SOLIDEM_INSTRUCTION_SET {

typedef SolidemBondMemory Memory;

/// The numbers of memories from one on: where they stand no pack may be loaded.
inline Quad four_numbers(double* const* memory, int place) {
  alignas(64) double rows[4 * width];
  for (int k = 0; k < width; k++) std::memcpy(rows + 4 * k, memory[k] + place, 4 * sizeof(double));
  return Quad::load(rows);
}
inline Row first_eight_numbers(double* const* memory) {
  alignas(64) double rows[8 * width];
  for (int k = 0; k < width; k++) std::memcpy(rows + 8 * k, memory[k], 8 * sizeof(double));
  return Row::load(rows);
}

/// A pack of bonds in this pose.
struct Bonds {
  PackQuaternion turned_i, turned_j;
  solidem::YieldingBeam<Pack> beam;
  Pack cold_rest_length;
  solidem::BeamPose<Pack> pose;
  solidem::BeamDeformation<Pack> deformation;
  Mask apart;
};

inline solidem::YieldingBeam<Pack> beam_of(const SolidemBeamPacks& m, int first,
                                           const Pack& cold_rest_length) {
  const SolidemRow* of_block = m.one_beam ? m.beam : m.beam + 5 * (first / 8);
  const int lane = first % 8;
  const auto number = [&](int k) { return Pack::load(of_block[k].number + lane); };
  return {{number(0), number(1), number(2), number(3)},
          m.stretch ? cold_rest_length * number_of(m.stretch, first) : cold_rest_length,
          number(4),
          Pack(m.shear_ratio)};
}

/// Of those that never change the first four numbers are all that they remember.
template <bool changes>
inline Bonds read(const SolidemBeamPacks& m, int first) {
  const Row i = gather(m.poses, m.i + first), j = gather(m.poses, m.j + first);
  const PackVector chord = first_of(j) - first_of(i);
  const PackQuaternion turned_i = orientation_of(i), turned_j = orientation_of(j);
  double* const* memory = m.memory + first;
  const Pack none(0.0);
  if constexpr (!changes) {
    const Quad kept = four_numbers(memory, Memory::NORMAL_I);
    const Pack& cold_rest_length = kept.component[Memory::REST_LENGTH];
    const solidem::YieldingBeam<Pack> beam = beam_of(m, first, cold_rest_length);
    const solidem::BeamPose<Pack> pose = solidem::beam_pose(
        chord, {kept.component[0], kept.component[1], kept.component[2]}, turned_i, turned_j);
    return {turned_i,           turned_j, beam,
            cold_rest_length,   pose,     solidem::beam_deformation(beam.rest_length, pose),
            greater(none, none)};
  } else {
    const Row kept = first_eight_numbers(memory);
    const Quad more = four_numbers(memory, Memory::TWIST);
    const Pack& cold_rest_length = kept.component[Memory::REST_LENGTH];
    const solidem::YieldingBeam<Pack> beam = beam_of(m, first, cold_rest_length);
    const solidem::BeamHistory<Pack> history = {
        first_of(kept),
        last_of(kept),
        kept.component[Memory::EXTENSION],
        more.component[0],
        more.component[Memory::PLASTIC_STRAIN - Memory::TWIST],
        {}};
    const solidem::BeamPose<Pack> pose =
        solidem::beam_pose(chord, history.normal_i, history.normal_j, turned_i, turned_j);
    const solidem::BeamDeformation<Pack> deformation =
        solidem::elastic_deformation(beam.rest_length, pose, history);
    const Pack ruptured = more.component[Memory::RUPTURE - Memory::TWIST];
    const Pack limit = beam.rest_length * number_of(m.limit, first);
    const Pack reached =
        solidem::bound_of_squared_extension(beam.radius, beam.shear_ratio, pose, deformation);
    const Mask apart = either(either(greater(ruptured, none), greater(none, ruptured)),
                              greater(reached, limit * limit));
    return {turned_i, turned_j, beam, cold_rest_length, pose, deformation, apart};
  }
}

/// As SolidemBeam::keep_last().
inline void keep_last(const SolidemBeamPacks& m, int first, int count, const Bonds& bonds) {
  const solidem::BeamModes<Pack> modes =
      solidem::beam_modes(bonds.pose, bonds.deformation, bonds.turned_i);
  const PackVector &i = modes.lean_i, &j = modes.lean_j;
  const Pack numbers[] = {i.x,
                          i.y,
                          i.z,
                          j.x,
                          j.y,
                          j.z,
                          modes.extension + (bonds.beam.rest_length - bonds.cold_rest_length),
                          modes.twist,
                          solidem::equivalent_strain(bonds.beam.radius, bonds.beam.shear_ratio,
                                                     bonds.pose, bonds.deformation)};
  for (int k = 0; k < count; k++) {
    if (bonds.apart[k]) continue;
    double* last = m.memory[first + k] + Memory::LAST;
    for (int number = 0; number < 9; number++) last[number] = numbers[number].v[k];
  }
  const PackQuaternion turn = solidem::conjugate(bonds.turned_i) * bonds.turned_j;
  const Pack turned[] = {turn.w, turn.v.x, turn.v.y, turn.v.z};
  for (int k = 0; k < count; k++) {
    if (bonds.apart[k]) continue;
    double* last = m.memory[first + k] + Memory::LAST_TURN;
    for (int number = 0; number < 4; number++) last[number] = turned[number].v[k];
  }
}

inline void damp(SolidemBeamPacks& m, int first, int count, const Bonds& bonds,
                 solidem::BeamLoad<Pack>& load) {
  const Row i = gather(m.motion, m.i + first), j = gather(m.motion, m.j + first);
  const solidem::DashpotAction<Pack> action = solidem::bond_damping(
      solidem::bond_dashpots(Pack(m.damping_ratio), bonds.beam.rigidity, bonds.beam.rest_length,
                             {i.component[3] + j.component[3], i.component[7] + j.component[7]}),
      bonds.pose.chord, {first_of(j) - first_of(i), last_of(i), last_of(j)});
  load.force += action.load.force;
  load.moment_i += action.load.moment_i;
  load.moment_j += action.load.moment_j;
  const Pack power = m.owned ? number_of(m.owned, first) * action.power : action.power;
  for (int k = 0; k < count; k++)
    if (!bonds.apart[k]) m.damping_power += power.v[k];
}

inline void hand_on(SolidemBeamPacks& m, int first, int count, const Bonds& bonds,
                    const solidem::BeamLoad<Pack>& load) {
  const PackVector &f = load.force, &a = load.moment_i, &b = load.moment_j;
  const Pack none(0.0);
  SolidemRow on_i[width], on_j[width];
  Row{{f.x, f.y, f.z, none, a.x, a.y, a.z, none}}.store(on_i->number);
  Row{{-f.x, -f.y, -f.z, none, b.x, b.y, b.z, none}}.store(on_j->number);
  if (__builtin_expect(count == width && !any(bonds.apart), 1)) {
    for (int k = 0; k < width; k++) {
      add(on_i[k], m.loads[m.i[first + k]]);
      add(on_j[k], m.loads[m.j[first + k]]);
    }
    return;
  }
  for (int k = 0; k < count; k++) {
    if (bonds.apart[k]) {
      m.apart[m.bonds_apart++] = first + k;
      continue;
    }
    add(on_i[k], m.loads[m.i[first + k]]);
    add(on_j[k], m.loads[m.j[first + k]]);
  }
}

inline void tell(const SolidemBeamPacks& m, int first, int count, const Bonds& bonds,
                 const solidem::BeamLoad<Pack>& load) {
  const Pack energy = solidem::beam_energy(bonds.beam.rigidity, bonds.pose, bonds.deformation);
  for (int k = 0; k < count; k++)
    m.told[first + k] = {{energy.v[k], load.force.x.v[k], load.force.y.v[k], load.force.z.v[k]}};
}

template <bool changes, bool flows>
[[gnu::flatten]] void act_by(SolidemBeamPacks& m) {
  for (int first = 0; first < m.bonds; first += width) {
    const int left = m.bonds - first, count = left < width ? left : width;
    const Bonds bonds = read<changes>(m, first);
    if constexpr (flows) keep_last(m, first, count, bonds);
    solidem::BeamLoad<Pack> load =
        solidem::beam_load(bonds.beam.rigidity, bonds.pose, bonds.deformation);
    if (m.motion) damp(m, first, count, bonds, load);
    if (m.told) tell(m, first, count, bonds, load);
    hand_on(m, first, count, bonds, load);
  }
}

inline void act(SolidemBeamPacks& m) {
  m.bonds_apart = 0;
  m.damping_power = 0.0;
  if (!m.limit)
    act_by<false, false>(m);
  else if (!m.flows)
    act_by<true, false>(m);
  else
    act_by<true, true>(m);
}

}  // namespace SOLIDEM_INSTRUCTION_SET
}  // namespace LAMMPS_NS

#endif
