// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// Packs of rows. Included once for each instruction set.
#ifndef LMP_SOLIDEM_ROWS_H
#define LMP_SOLIDEM_ROWS_H

#include "effects/kernels/pack.hpp"
#include "solidem_kernels.h"

namespace LAMMPS_NS {
namespace SOLIDEM_INSTRUCTION_SET {

using solidem::SOLIDEM_INSTRUCTION_SET::any;
using solidem::SOLIDEM_INSTRUCTION_SET::both;
using solidem::SOLIDEM_INSTRUCTION_SET::either;
using solidem::SOLIDEM_INSTRUCTION_SET::greater;
using solidem::SOLIDEM_INSTRUCTION_SET::Mask;
using solidem::SOLIDEM_INSTRUCTION_SET::Pack;
using solidem::SOLIDEM_INSTRUCTION_SET::Quad;
using solidem::SOLIDEM_INSTRUCTION_SET::Row;
using solidem::SOLIDEM_INSTRUCTION_SET::width;
typedef solidem::Vector3<Pack> PackVector;
typedef solidem::Quaternion<Pack> PackQuaternion;

/// Four components of a row from the first or the fifth on.
inline PackVector first_of(const Row& row) {
  return {row.component[0], row.component[1], row.component[2]};
}
inline PackVector last_of(const Row& row) {
  return {row.component[4], row.component[5], row.component[6]};
}
inline PackQuaternion orientation_of(const Row& row) {
  return {row.component[4], {row.component[5], row.component[6], row.component[7]}};
}

/// A number of a pack of bonds of which the first is `bond`.
inline Pack number_of(const SolidemRow* rows, int bond) {
  return Pack::load(rows[bond / 8].number + bond % 8);
}

inline Row gather(const SolidemRow* rows, const int* atoms) {
  return Row::gather(rows->number, atoms);
}

inline void add(const SolidemRow& load, SolidemRow& sum) {
  for (int k = 0; k < 8; k += width)
    (Pack::load(sum.number + k) + Pack::load(load.number + k)).store(sum.number + k);
}

}  // namespace SOLIDEM_INSTRUCTION_SET
}  // namespace LAMMPS_NS

#endif
