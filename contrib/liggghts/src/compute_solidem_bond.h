// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(solidem/bond,ComputeSolidemBond)
// clang-format on

#else

#ifndef LMP_COMPUTE_SOLIDEM_BOND_H
#define LMP_COMPUTE_SOLIDEM_BOND_H

#include <vector>

#include "compute.h"

namespace LAMMPS_NS {

/// Figures of every bond of bond_style solidem/beam that is not gone, once each: local vector, or
/// array with a column for each attribute asked for.
class ComputeSolidemBond : public Compute {
 public:
  ComputeSolidemBond(class LAMMPS*, int&, int, char**);
  void init();
  void compute_local();
  double memory_usage();

 private:
  std::vector<int> attributes;
  std::vector<double> values;  // bond by bond
  std::vector<double*> rows;
  class BondSolidemBeam* beams;

  bool counts_here(int, int) const;
  void add_bond(int);
};

}  // namespace LAMMPS_NS

#endif
#endif
