// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_BEAM_WORDS_H
#define LMP_SOLIDEM_BEAM_WORDS_H

#include <string>

#include "lammps.h"
#include "solidem_beam.h"

namespace LAMMPS_NS {

/// The beam that a bond_coeff command describes: TYPES E G radius R | pair RATIO, then keywords.
/// Ends the program with a message that names the keyword when it cannot be.
SolidemBeam solidem_read_beam(LAMMPS* liggghts, int narg, char** arg);

/// The words of a bond_coeff command, after the types, that describe this beam.
std::string solidem_write_beam(const SolidemBeam& beam);

}  // namespace LAMMPS_NS

#endif
