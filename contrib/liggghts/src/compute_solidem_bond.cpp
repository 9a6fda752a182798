// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "compute_solidem_bond.h"

#include <string>

#include "atom.h"
#include "bond_solidem_beam.h"
#include "error.h"
#include "force.h"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

typedef SolidemBondMemory Row;

enum {
  ID1,
  ID2,
  TYPE,
  STATE,
  LENGTH,
  FORCE,
  STRESS,
  PLASTIC_STRAIN,
  PLASTIC_WORK,
  ENERGY,
  ATTRIBUTES
};
const char* const names[ATTRIBUTES] = {"id1",          "id2",   "type",   "state",
                                       "length",       "force", "stress", "plastic_strain",
                                       "plastic_work", "energy"};

}  // namespace

ComputeSolidemBond::ComputeSolidemBond(LAMMPS* liggghts, int& iarg, int narg, char** arg)
    : Compute(liggghts, iarg, narg, arg), beams(NULL) {
  std::string known;
  for (const char* name : names) known += std::string(" ") + name;
  for (; iarg < narg; iarg++) {
    int k = 0;
    while (k < ATTRIBUTES && std::string(arg[iarg]) != names[k]) k++;
    if (k == ATTRIBUTES)
      error->all(FLERR, ("Compute solidem/bond: unknown attribute '" + std::string(arg[iarg]) +
                         "'; known are" + known)
                            .c_str());
    attributes.push_back(k);
  }
  if (attributes.empty())
    error->all(FLERR, ("Compute solidem/bond wants one or more of:" + known).c_str());
  local_flag = 1;
  size_local_cols = attributes.size() == 1 ? 0 : static_cast<int>(attributes.size());
}

void ComputeSolidemBond::init() {
  beams = dynamic_cast<BondSolidemBeam*>(force->bond);
  if (!beams) error->all(FLERR, "Compute solidem/bond needs bond_style solidem/beam");
}

// With newton_bond off two ranks may know a bond: it is told by that of the lower tag. Both ends
// are in the group.
bool ComputeSolidemBond::counts_here(int i, int j) const {
  if (!(atom->mask[i] & groupbit) || !(atom->mask[j] & groupbit)) return false;
  return force->newton_bond || (atom->tag[i] < atom->tag[j] ? i : j) < atom->nlocal;
}

void ComputeSolidemBond::compute_local() {
  invoked_local = update->ntimestep;
  values.clear();
  for (int n = 0; n < neighbor->nbondlist; n++)
    if (counts_here(neighbor->bondlist[n][0], neighbor->bondlist[n][1])) add_bond(n);

  const std::size_t columns = attributes.size();
  size_local_rows = static_cast<int>(values.size() / columns);
  rows.resize(size_local_rows);
  for (int n = 0; n < size_local_rows; n++) rows[n] = &values[n * columns];
  vector_local = values.data();
  array_local = rows.data();
}

void ComputeSolidemBond::add_bond(int n) {
  int i = neighbor->bondlist[n][0], j = neighbor->bondlist[n][1];
  const int type = neighbor->bondlist[n][2];
  const double* memory_of_bond = neighbor->bondhistlist[n];
  const SolidemBeam& beam = beams->beam(type);
  const bool may_change = beam.may_change();
  if (may_change && Row::is_gone(memory_of_bond)) return;
  const SolidemBondFigures figures =
      beam.figures(memory_of_bond, beams->ends(i, j), static_cast<double>(update->ntimestep));
  for (const int attribute : attributes) switch (attribute) {
      case ID1:
        values.push_back(atom->tag[i]);
        break;
      case ID2:
        values.push_back(atom->tag[j]);
        break;
      case TYPE:
        values.push_back(type);
        break;
      case STATE:
        values.push_back(may_change && !Row::is_whole(memory_of_bond));
        break;
      case LENGTH:
        values.push_back(figures.length);
        break;
      case FORCE:
        values.push_back(figures.force);
        break;
      case STRESS:
        values.push_back(figures.stress);
        break;
      case PLASTIC_STRAIN:
        values.push_back(may_change ? memory_of_bond[Row::PLASTIC_STRAIN] : 0.0);
        break;
      case PLASTIC_WORK:
        values.push_back(may_change ? memory_of_bond[Row::PLASTIC_WORK] : 0.0);
        break;
      default:
        values.push_back(figures.elastic_energy + figures.contact_energy);
    }
}

double ComputeSolidemBond::memory_usage() {
  return static_cast<double>(values.capacity() * sizeof(double) +
                             rows.capacity() * sizeof(double*));
}
