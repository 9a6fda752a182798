// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifdef BOND_CLASS

// clang-format off
BondStyle(solidem/beam,BondSolidemBeam)
// clang-format on

#else

#ifndef LMP_BOND_SOLIDEM_BEAM_H
#define LMP_BOND_SOLIDEM_BEAM_H

#include <vector>

#include "bond.h"

namespace LAMMPS_NS {

/// Elastic Euler-Bernoulli beam between the centres of two spheres; the law is
/// laws/beam.hpp. History of a bond, from the lower tag to the higher: rest
/// direction (3, body axes of both atoms) and rest length; a rest length of zero marks a bond not
/// yet seen.
class BondSolidemBeam : public Bond {
 public:
  BondSolidemBeam(class LAMMPS*);
  ~BondSolidemBeam();
  void init_style();
  void compute(int, int);
  void coeff(int, char**);
  double equilibrium_distance(int);
  void write_restart(FILE*);
  void read_restart(FILE*);
  void write_data(FILE*);
  double single(int, double, int, int, double&);

 private:
  /// One bond type. `radius` > 0: the beam's radius; else `ratio` times the mean of the two
  /// spheres'.
  struct Section {
    double young_modulus, shear_modulus, radius, ratio;
  };
  std::vector<Section> sections;
  class FixPropertyAtom* orientation;

  void allocate();
  void tally(int, int, double, const double*, const double*);
};

}  // namespace LAMMPS_NS

#endif
#endif
