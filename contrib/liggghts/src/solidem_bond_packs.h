// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_BOND_PACKS_H
#define LMP_SOLIDEM_BOND_PACKS_H

#include <vector>

#include "solidem_kernels.h"

namespace LAMMPS_NS {

struct SolidemBeam;
struct SolidemBondEnds;

/// The bonds of one type in the order in which SolidemBeamPacks takes them, with what the laws make
/// of their coefficients.
class SolidemBondPacks {
 public:
  explicit SolidemBondPacks(const SolidemBeam& beam);

  /// Adds a bond between two atoms, the one of the lower tag first.
  void add(int i, int j, double* memory, double owned);
  /// When all are there.
  void end_of_adding();

  const SolidemBeam& beam() const { return beam_; }
  int size() const { return bonds_; }
  int i(int bond) const { return i_[bond]; }
  int j(int bond) const { return j_[bond]; }
  double* memory(int bond) const { return memory_[bond]; }
  double owned(int bond) const { return owned_[bond / 8].number[bond % 8]; }

  /// Works out anew what a bond's memory and the warmth of its atoms say of it.
  void prepare(int bond, const SolidemBondEnds& ends);
  /// Must that be done in every step?
  bool changes_by_itself() const;

  /// All that does not depend on the step; nobody asks for energies or damping.
  SolidemBeamPacks packs();
  /// Bonds that act() left alone, to be acted on one by one.
  int apart(int k) const { return apart_[k]; }
  /// Are all of them such?
  bool none_in_packs() const;
  const SolidemRow& told(int bond) const { return told_[bond]; }
  SolidemRow* told() { return told_.data(); }

 private:
  const SolidemBeam& beam_;
  int bonds_;
  bool one_beam_;
  std::vector<int> i_, j_, apart_;
  std::vector<double*> memory_;
  std::vector<SolidemRow> owned_, constants_, stretch_, limit_, told_;
};

}  // namespace LAMMPS_NS

#endif
