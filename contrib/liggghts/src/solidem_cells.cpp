// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_cells.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "error.h"
#include "solidem_table.h"

using namespace LAMMPS_NS;

namespace {

bool before(const SolidemCells::Face& a, const SolidemCells::Face& b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

bool is_number_of_atom(double value) {
  return value >= 1.0 && value == static_cast<int>(value);
}

}  // namespace

SolidemCells::SolidemCells(LAMMPS* liggghts, const std::string& file) {
  std::ostringstream complaint;
  complaint << file << ": ";
  const std::vector<double> cells = solidem_table(liggghts, file, "volumes", 2);
  for (std::size_t k = 0; k < cells.size(); k += 2) {
    if (!is_number_of_atom(cells[k]) || !(cells[k + 1] > 0.0)) {
      complaint << "'" << cells[k] << " " << cells[k + 1] << "' is no atom and positive volume";
      liggghts->error->all(FLERR, complaint.str().c_str());
    }
    const std::size_t atom = static_cast<std::size_t>(cells[k]);
    if (volumes_.size() <= atom) volumes_.resize(atom + 1, 0.0);
    if (volumes_[atom] != 0.0) {
      complaint << "the volume of atom " << atom << " is there twice";
      liggghts->error->all(FLERR, complaint.str().c_str());
    }
    volumes_[atom] = cells[k + 1];
  }

  const std::vector<double> rows = solidem_table(liggghts, file, "faces", 4);
  for (std::size_t k = 0; k < rows.size(); k += 4) {
    if (!is_number_of_atom(rows[k]) || !is_number_of_atom(rows[k + 1]) || rows[k] == rows[k + 1] ||
        !(rows[k + 2] > 0.0) || !(rows[k + 3] > 0.0)) {
      complaint << "'" << rows[k] << " " << rows[k + 1] << " " << rows[k + 2] << " " << rows[k + 3]
                << "' is no two atoms, positive area and distance";
      liggghts->error->all(FLERR, complaint.str().c_str());
    }
    Face face = {static_cast<int>(rows[k]), static_cast<int>(rows[k + 1]), rows[k + 2],
                 rows[k + 3]};
    if (face.first > face.second) std::swap(face.first, face.second);
    faces_.push_back(face);
  }
  std::sort(faces_.begin(), faces_.end(), before);
  for (std::size_t k = 1; k < faces_.size(); ++k)
    if (!before(faces_[k - 1], faces_[k])) {
      complaint << "the face of atoms " << faces_[k].first << " and " << faces_[k].second
                << " is there twice";
      liggghts->error->all(FLERR, complaint.str().c_str());
    }
}

const SolidemCells::Face* SolidemCells::face(int atom, int other) const {
  const Face wanted = {std::min(atom, other), std::max(atom, other), 0.0, 0.0};
  const std::vector<Face>::const_iterator found =
      std::lower_bound(faces_.begin(), faces_.end(), wanted, before);
  return found != faces_.end() && !before(wanted, *found) ? &*found : NULL;
}

double SolidemCells::volume(int atom) const {
  return static_cast<std::size_t>(atom) < volumes_.size() ? volumes_[atom] : 0.0;
}
