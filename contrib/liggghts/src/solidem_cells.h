// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_CELLS_H
#define LMP_SOLIDEM_CELLS_H

#include <string>
#include <vector>

#include "lammps.h"

namespace LAMMPS_NS {

/// The cells of a tessellated body: their volumes and the faces between them, by numbers of atoms.
class SolidemCells {
 public:
  struct Face {
    int first, second;  // numbers of atoms, first < second
    double area;        // m²
    double distance;    // of the centres, m
  };

  /// Reads the sections `volumes` (atom, volume) and `faces` (atom, atom, area, distance) of a text
  /// file. Ends the program with a message when an entry is no cell or face, or is there twice.
  SolidemCells(LAMMPS* lmp, const std::string& file);

  /// How many faces there are.
  std::size_t faces() const { return faces_.size(); }
  /// The face between two atoms, NULL when there is none.
  const Face* face(int atom, int other) const;
  /// Volume of an atom's cell, m³; 0 when it has none.
  double volume(int atom) const;

 private:
  std::vector<Face> faces_;  // sorted by numbers of atoms
  std::vector<double> volumes_;
};

}  // namespace LAMMPS_NS

#endif
