// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_WAITING_HEAT_H
#define LMP_SOLIDEM_WAITING_HEAT_H

namespace LAMMPS_NS {

/// The property waitingHeat: heat that motion has made of each atom and that its temperature does
/// not show yet, J. Made if there is none, zero at first.
class FixPropertyAtom* solidem_waiting_heat(class Modify* modify, int nlocal, const char* caller);

}  // namespace LAMMPS_NS

#endif
