// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// The loop over the pairs.
#include <algorithm>
#include <limits>
#include <variant>

#include "atom.h"
#include "fix_solidem_central.h"
#include "fix_solidem_damage.h"
#include "laws/central_interaction.hpp"
#include "pair_solidem_central.h"

using namespace LAMMPS_NS;

void PairSolidemCentral::compute(int eflag, int vflag) {
  if (eflag || vflag)
    ev_setup(eflag, vflag);
  else
    evflag = vflag_fdotr = 0;
  listed();
  gather_atoms();
  const bool cracks = damage_ && damage_->finds_crack_faces();
  if (cracks) gather_faces();
  loads_.assign(atoms_.size(), SolidemRow());
  if (evflag) told_.resize(listed_.size());

  SolidemCentralPacks packs = {};
  packs.pairs = static_cast<int>(listed_.size());
  packs.i = i_.data();
  packs.j = j_.data();
  packs.equilibrium = equilibrium_.data();
  packs.owned = owned_.data();
  packs.atoms = atoms_.data();
  packs.faces = cracks ? faces_.data() : nullptr;
  packs.loads = loads_.data();
  packs.told = evflag ? told_.data() : nullptr;
  packs.range = settings_.range;
  packs.interpenetration = settings_.interpenetration;
  packs.dissipation = settings_.dissipation;
  std::visit(
      [&](const auto& law) {
        typedef std::decay_t<decltype(law)> Law;
        packs.law = &law;
        packs.continued_force = [](const void* known, double interpenetration, double distance,
                                   double equilibrium) {
          return solidem::central_force(*static_cast<const Law*>(known), interpenetration, distance,
                                        equilibrium)
              .force;
        };
      },
      settings_.law);
  solidem_kernels().pull[settings_.law.index()](packs);

  hand_loads_on();
  if (evflag) tally_pairs();
  memory_->totals.interactions = packs.interactions;
  memory_->dissipate(settings_.dissipation > 0.0 ? packs.power / settings_.dissipation : 0.0);
  if (packs.compression_ratio > 0.0)
    memory_->totals.interpenetration =
        std::max(memory_->totals.interpenetration, 1.0 - 1.0 / packs.compression_ratio);
}

void PairSolidemCentral::make_columns() {
  const size_t blocks = (listed_.size() + 7) / 8;
  i_.resize(8 * blocks);
  j_.resize(8 * blocks);
  equilibrium_.resize(blocks);
  owned_.resize(blocks);
  for (size_t k = 0; k < 8 * blocks; k++) {
    const bool is_pair = k < listed_.size();
    const Listed& pair = is_pair ? listed_[k] : listed_.back();
    i_[k] = pair.i;
    j_[k] = pair.j;
    equilibrium_[k / 8].number[k % 8] = pair.equilibrium;
    owned_[k / 8].number[k % 8] = !is_pair ? 0.0 : pair.j < atom->nlocal ? 1.0 : 0.5;
  }
}

// Copied side by side, what a pair asks of an atom is one line of the cache.
void PairSolidemCentral::gather_atoms() {
  const int all = atom->nlocal + atom->nghost;
  const bool moves = settings_.dissipation > 0.0;
  const double none[3] = {0.0, 0.0, 0.0};
  atoms_.resize(all);
  for (int i = 0; i < all; i++) {
    const double* x = atom->x[i];
    const double* v = moves ? atom->v[i] : none;
    const bool is_removed = damage_ && damage_->is_removed(i);
    const double radius = is_removed ? -std::numeric_limits<double>::infinity() : atom->radius[i];
    atoms_[i] = {{x[0], x[1], x[2], radius, v[0], v[1], v[2], 0.0}};
  }
}

void PairSolidemCentral::gather_faces() {
  faces_.resize(atoms_.size());
  for (size_t i = 0; i < faces_.size(); i++) {
    const solidem::Vector3<double> shown = damage_->barycentre(static_cast<int>(i));
    faces_[i] = {{shown.x, shown.y, shown.z}};
  }
}

// A ghost gets its own on its own rank, which lists the pair too.
void PairSolidemCentral::hand_loads_on() {
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++) atom->f[i][k] += loads_[i].number[k];
}

void PairSolidemCentral::tally_pairs() {
  for (size_t k = 0; k < listed_.size(); k++) {
    const double *told = told_[k].number, over_distance = told[0], distance = told[1];
    if (told[2] == 0.0) continue;  // out of range
    const Listed& pair = listed_[k];
    const double range = settings_.range * (atom->radius[pair.i] + atom->radius[pair.j]);
    double energy = 0.0;
    if (eflag_either)
      energy = std::visit(
          [&](const auto& law) {
            return solidem::central_potential(law, settings_.interpenetration, range, distance,
                                              pair.equilibrium);
          },
          settings_.law);
    const double* a = atom->x[pair.i];
    const double* b = atom->x[pair.j];
    ev_tally(pair.i, pair.j, atom->nlocal, 0, energy, 0.0, over_distance, a[0] - b[0], a[1] - b[1],
             a[2] - b[2]);
  }
}
