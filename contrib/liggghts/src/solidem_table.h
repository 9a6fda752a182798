// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_TABLE_H
#define LMP_SOLIDEM_TABLE_H

#include <string>
#include <vector>

#include "lammps.h"

namespace LAMMPS_NS {

/// The rows of one section of a text file, one after the other, on every rank. A section is a line
/// `NAME COUNT` and then COUNT lines of `columns` numbers; lines that are empty or begin with #
/// count nowhere. Ends the program with a message that names file and line when the file cannot be
/// read, has no such section, or holds something else than numbers.
std::vector<double> solidem_table(LAMMPS* liggghts, const std::string& file,
                                  const std::string& section, int columns);

}  // namespace LAMMPS_NS

#endif
