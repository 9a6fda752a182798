// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// Conduction of many atoms at a time. Included once for each instruction set.
#ifndef LMP_SOLIDEM_PACKS_OF_CONDUCTORS_H
#define LMP_SOLIDEM_PACKS_OF_CONDUCTORS_H

#include "solidem_rows.h"

namespace LAMMPS_NS {
namespace SOLIDEM_INSTRUCTION_SET {

inline void add_to(double* sum, Pack power) {
  const Pack all = Pack::load_anywhere(sum) + power;
  memcpy(sum, &all.v, sizeof all.v);
}

[[gnu::flatten]] inline void conduct(const SolidemConductors& c) {
  const int whole = c.atoms / 8 * 8;
  for (int first = 0; first < c.atoms; first += 8)
    for (int lane = 0; lane < 8; lane += width) {
      Pack power, own;
      const bool ends = first == whole;
      if (!ends) own = Pack::load_anywhere(c.temperature + first + lane);
      for (int k = 0; ends && k < width && first + lane + k < c.atoms; k++)
        own.v[k] = c.temperature[first + lane + k];
      for (int row = c.first_row[first / 8]; row < c.first_row[first / 8 + 1]; row++)
        power +=
            Pack::load(c.conductance[row].number + lane) *
            (solidem::SOLIDEM_INSTRUCTION_SET::gather(c.temperature, c.neighbour + 8 * row + lane) -
             own);
      if (!ends) add_to(c.flux + first + lane, power);
      for (int k = 0; ends && k < width && first + lane + k < c.atoms; k++)
        c.flux[first + lane + k] += power.v[k];
    }
}

}  // namespace SOLIDEM_INSTRUCTION_SET
}  // namespace LAMMPS_NS

#endif
