// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_CENTRAL_H
#define LMP_SOLIDEM_CENTRAL_H

#include <cmath>
#include <string>
#include <vector>

#include "lammps.h"
#include "laws/central_laws.hpp"

namespace LAMMPS_NS {

/// What a pair_style solidem/central command says: a central law, and between which atoms it acts.
struct SolidemCentral {
  solidem::CentralLaw law;
  double range = 0.0;      // alpha: atoms nearer than alpha (R_i + R_j) interact
  double tolerance = 0.0;  // initial pairs: nearer than (1 + tolerance) (R_i + R_j) at the start
  double interpenetration = 0.1;  // below (1 - a) times the equilibrium the force goes on linearly
  double dissipation = 0.0;       // N s/m
  bool initial_distance = true;   // is it the equilibrium of initial pairs? else R_i + R_j is
  bool fixed_neighbours = false;  // do initial pairs alone interact?

  /// Are initial pairs told from others?
  bool remembers() const { return initial_distance || fixed_neighbours; }
  /// Whether two atoms at a distance make an initial pair; lattices touch to round-off.
  bool is_initial(double distance, double radii) const {
    return distance <= (1.0 + tolerance) * radii * (1.0 + 1e-12);
  }
  /// How far atoms must be seen, over the sum of their radii.
  double reach() const { return std::max(range, (1.0 + tolerance) * (1.0 + 1e-12)); }
};

/// From the words LAW NAME VALUE ... range A [tolerance T] ... Ends the program with a message that
/// names the word and its value when it cannot be.
SolidemCentral solidem_read_central(LAMMPS* liggghts, const std::vector<std::string>& words);

/// The words that describe it, numbers with all their digits.
std::string solidem_write_central(const SolidemCentral& central);

}  // namespace LAMMPS_NS

#endif
