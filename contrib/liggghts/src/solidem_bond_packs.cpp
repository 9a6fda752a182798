// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_bond_packs.h"

#include "solidem_beam.h"

namespace LAMMPS_NS {

SolidemBondPacks::SolidemBondPacks(const SolidemBeam& beam)
    : beam_(beam), bonds_(0), one_beam_(beam.all_have_one_section()) {}

void SolidemBondPacks::add(int i, int j, double* memory, double owned) {
  if (bonds_ % 8 == 0) owned_.push_back(SolidemRow());
  owned_.back().number[bonds_ % 8] = owned;
  i_.push_back(i);
  j_.push_back(j);
  memory_.push_back(memory);
  bonds_++;
}

void SolidemBondPacks::end_of_adding() {
  const size_t blocks = owned_.size();
  apart_.resize(8 * blocks);
  told_.resize(8 * blocks);
  constants_.resize(one_beam_ ? 5 : 5 * blocks);
  if (beam_.expands()) stretch_.resize(blocks);
  if (beam_.may_change()) limit_.resize(blocks);
  if (bonds_ == 0) return;
  i_.resize(8 * blocks, i_.back());
  j_.resize(8 * blocks, j_.back());
  memory_.resize(8 * blocks, memory_.back());
}

void SolidemBondPacks::prepare(int bond, const SolidemBondEnds& ends) {
  const bool is_last = bond == bonds_ - 1;
  const solidem::YieldingBeam<double> is = beam_.beam(memory_[bond], ends);
  const double constants[] = {is.rigidity.axial, is.rigidity.bending, is.rigidity.shear,
                              is.rigidity.torsion, is.radius};
  const int block = bond / 8;
  // The lanes behind the last bond are this bond again.
  const int end = is_last ? 8 : bond % 8 + 1;
  for (int lane = bond % 8; lane < end; lane++) {
    if (!one_beam_)
      for (int k = 0; k < 5; k++) constants_[5 * block + k].number[lane] = constants[k];
    if (!stretch_.empty())
      stretch_[block].number[lane] = beam_.warmth.stretch(ends.temperature_i, ends.temperature_j);
    if (!limit_.empty()) limit_[block].number[lane] = beam_.limit(memory_[bond], ends);
  }
  if (one_beam_ && bond == 0)
    for (int k = 0; k < 5; k++)
      for (double& number : constants_[k].number) number = constants[k];
}

bool SolidemBondPacks::changes_by_itself() const {
  return beam_.follows_temperature();
}

bool SolidemBondPacks::none_in_packs() const {
  return !beam_.has_bound_of_limit();
}

SolidemBeamPacks SolidemBondPacks::packs() {
  SolidemBeamPacks packs = {};
  packs.bonds = bonds_;
  packs.i = i_.data();
  packs.j = j_.data();
  packs.memory = memory_.data();
  packs.beam = constants_.data();
  packs.one_beam = one_beam_;
  packs.shear_ratio =
      beam_.law == SolidemBeam::SPRING ? 0.0 : beam_.shear_modulus / beam_.young_modulus;
  packs.stretch = stretch_.empty() ? nullptr : stretch_.data();
  packs.limit = limit_.empty() ? nullptr : limit_.data();
  packs.flows = beam_.flows;
  packs.damping_ratio = beam_.damping_ratio;
  packs.owned = owned_.data();
  packs.apart = apart_.data();
  return packs;
}

}  // namespace LAMMPS_NS
