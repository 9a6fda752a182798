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
ComputeStyle(solidem/broken/atom,ComputeSolidemBrokenAtom)
// clang-format on

#else

#ifndef LMP_COMPUTE_SOLIDEM_BROKEN_ATOM_H
#define LMP_COMPUTE_SOLIDEM_BROKEN_ATOM_H

#include <vector>

#include "compute.h"

namespace LAMMPS_NS {

/// How many of its bonds every atom has lost: per-atom vector.
class ComputeSolidemBrokenAtom : public Compute {
 public:
  ComputeSolidemBrokenAtom(class LAMMPS*, int&, int, char**);
  void init();
  void compute_peratom();
  int pack_reverse_comm(int, int, double*);
  void unpack_reverse_comm(int, int*, double*);
  double memory_usage();

 private:
  std::vector<double> broken;  // ghosts included
  class FixSolidemBonds* bonds;
};

}  // namespace LAMMPS_NS

#endif
#endif
