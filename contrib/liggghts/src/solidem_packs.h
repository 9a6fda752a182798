// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// Loops over many bonds, pairs or atoms at a time, included once for each instruction set.
// Everything that is compiled here belongs to a namespace of it, or to a pack of it.
#ifndef LMP_SOLIDEM_PACKS_H
#define LMP_SOLIDEM_PACKS_H

#include "solidem_packs_of_atoms.h"
#include "solidem_packs_of_bonds.h"
#include "solidem_packs_of_conductors.h"
#include "solidem_packs_of_pairs.h"

namespace LAMMPS_NS {
namespace SOLIDEM_INSTRUCTION_SET {

extern const SolidemKernels kernels;
const SolidemKernels kernels = {act, move, conduct, PullByLaw<solidem::CentralLaws>::entries};

}  // namespace SOLIDEM_INSTRUCTION_SET
}  // namespace LAMMPS_NS

#endif
