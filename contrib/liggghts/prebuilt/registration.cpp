// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
//
// Adds the styles of ../src to a LIGGGHTS that is already built, as a shared library. The program,
// or the preload, that holds this file comes before the library in the dynamic linker's order, so
// its Force::new_bond, Force::new_pair, Modify::add_fix and Modify::add_compute are the ones
// called; they know the added styles and hand everything else to the library's own.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bond_solidem_beam.h"
#include "compute_solidem_bond.h"
#include "compute_solidem_broken_atom.h"
#include "fix_nve_solidem.h"
#include "fix_solidem_bond_create.h"
#include "fix_solidem_bonds.h"
#include "fix_solidem_central.h"
#include "fix_solidem_conduction.h"
#include "fix_solidem_damage.h"
#include "fix_solidem_exchange.h"
#include "fix_solidem_friction.h"
#include "fix_solidem_temperature.h"
#include "fix_solidem_touch.h"
#include "force.h"
#include "modify.h"
#include "pair_solidem_central.h"

namespace LAMMPS_NS {

namespace {

// The library's function of the same mangled name as ours.
void* library_function(const char* symbol) {
  void* found = dlsym(RTLD_NEXT, symbol);
  if (found) return found;
  std::fprintf(stderr, "solidem: this LIGGGHTS has no %s; is it version 3.8.0?\n", symbol);
  std::abort();
}

// Modify's maps are private; an explicit instantiation may name a private member all the same.
template <auto FixMap, auto ComputeMap>
struct PrivateMembers {
  friend auto& fix_map_of(Modify& modify) { return *(modify.*FixMap); }
  friend auto& compute_map_of(Modify& modify) { return *(modify.*ComputeMap); }
};
auto& fix_map_of(Modify& modify);
auto& compute_map_of(Modify& modify);
template struct PrivateMembers<&Modify::fix_map, &Modify::compute_map>;

template <class Style>
Fix* create_fix(LAMMPS* lmp, int narg, char** arg) {
  return new Style(lmp, narg, arg);
}

template <class Style>
Compute* create_compute(LAMMPS* lmp, int iarg, int narg, char** arg) {
  return new Style(lmp, iarg, narg, arg);
}

}  // namespace

Bond* Force::new_bond(const char* style, const char* suffix, int& suffix_used) {
  if (std::strcmp(style, "solidem/beam") == 0) {
    suffix_used = 0;
    return new BondSolidemBeam(lmp);
  }
  typedef Bond* (*NewBond)(Force*, const char*, const char*, int&);
  static const NewBond library_new_bond =
      reinterpret_cast<NewBond>(library_function("_ZN9LAMMPS_NS5Force8new_bondEPKcS2_Ri"));
  return library_new_bond(this, style, suffix, suffix_used);
}

Pair* Force::new_pair(const char* style, const char* suffix, int& suffix_used) {
  if (std::strcmp(style, "solidem/central") == 0) {
    suffix_used = 0;
    return new PairSolidemCentral(lmp);
  }
  typedef Pair* (*NewPair)(Force*, const char*, const char*, int&);
  static const NewPair library_new_pair =
      reinterpret_cast<NewPair>(library_function("_ZN9LAMMPS_NS5Force8new_pairEPKcS2_Ri"));
  return library_new_pair(this, style, suffix, suffix_used);
}

Pair* Force::new_pair_from_restart(FILE* file, const char* style, const char* suffix,
                                   int& suffix_used) {
  if (std::strcmp(style, "solidem/central") == 0) return new_pair(style, suffix, suffix_used);
  typedef Pair* (*NewPair)(Force*, FILE*, const char*, const char*, int&);
  static const NewPair library_new_pair = reinterpret_cast<NewPair>(
      library_function("_ZN9LAMMPS_NS5Force21new_pair_from_restartEP8_IO_FILEPKcS4_Ri"));
  return library_new_pair(this, file, style, suffix, suffix_used);
}

void Modify::add_fix(int narg, char** arg, char* suffix) {
  auto& fixes = fix_map_of(*this);
  fixes["nve/solidem"] = &create_fix<FixNVESolidem>;
  fixes["solidem/bond/create"] = &create_fix<FixSolidemBondCreate>;
  fixes["solidem/bonds"] = &create_fix<FixSolidemBonds>;
  fixes["solidem/central"] = &create_fix<FixSolidemCentral>;
  fixes["solidem/conduction"] = &create_fix<FixSolidemConduction>;
  fixes["solidem/damage"] = &create_fix<FixSolidemDamage>;
  fixes["solidem/exchange"] = &create_fix<FixSolidemExchange>;
  fixes["solidem/friction"] = &create_fix<FixSolidemFriction>;
  fixes["solidem/temperature"] = &create_fix<FixSolidemTemperature>;
  fixes["solidem/touch"] = &create_fix<FixSolidemTouch>;
  typedef void (*AddFix)(Modify*, int, char**, char*);
  static const AddFix library_add_fix =
      reinterpret_cast<AddFix>(library_function("_ZN9LAMMPS_NS6Modify7add_fixEiPPcS1_"));
  library_add_fix(this, narg, arg, suffix);
}

void Modify::add_compute(int narg, char** arg, char* suffix) {
  auto& computes = compute_map_of(*this);
  computes["solidem/bond"] = &create_compute<ComputeSolidemBond>;
  computes["solidem/broken/atom"] = &create_compute<ComputeSolidemBrokenAtom>;
  typedef void (*AddCompute)(Modify*, int, char**, char*);
  static const AddCompute library_add_compute =
      reinterpret_cast<AddCompute>(library_function("_ZN9LAMMPS_NS6Modify11add_computeEiPPcS1_"));
  library_add_compute(this, narg, arg, suffix);
}

}  // namespace LAMMPS_NS
