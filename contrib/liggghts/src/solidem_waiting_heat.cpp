// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_waiting_heat.h"

#include <algorithm>

#include "fix_property_atom.h"
#include "modify.h"

using namespace LAMMPS_NS;

// Without a default, which LIGGGHTS would give to all atoms once more at the end of the first
// setup.
FixPropertyAtom* LAMMPS_NS::solidem_waiting_heat(Modify* modify, int nlocal, const char* caller) {
  const char* name = "waitingHeat";
  if (Fix* found = modify->find_fix_property(name, "property/atom", "scalar", 0, 0, caller, false))
    return static_cast<FixPropertyAtom*>(found);
  const char* command[] = {name,  "all", "property/atom", name,  "scalar",
                           "yes", "no",  "yes",           "none"};
  FixPropertyAtom* made = modify->add_fix_property_atom(9, const_cast<char**>(command), caller);
  if (!made->restart_reset) std::fill_n(made->vector_atom, nlocal, 0.0);
  return made;
}
