// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_bond_create.h"

#include <string.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "atom.h"
#include "bond_solidem_beam.h"
#include "domain.h"
#include "error.h"
#include "fix_property_atom.h"
#include "fix_solidem_bonds.h"
#include "force.h"
#include "modify.h"
#include "solidem_reach.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixSolidemBondCreate::FixSolidemBondCreate(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      bond_type(0),
      tolerance(0.0),
      made(0.0),
      bonds(NULL),
      orientation(NULL) {
  if (narg != 9 || strcmp(arg[3], "step") != 0 || strcmp(arg[5], "type") != 0 ||
      strcmp(arg[7], "tolerance") != 0)
    error->fix_error(FLERR, this, "wants 'step N type BOND_TYPE tolerance T'");
  next_reneighbor = force->inumeric(FLERR, arg[4]);
  bond_type = force->inumeric(FLERR, arg[6]);
  tolerance = force->numeric(FLERR, arg[8]);
  if (next_reneighbor < update->ntimestep)
    error->fix_error(FLERR, this, ("step " + std::string(arg[4]) + " is over").c_str());
  if (bond_type < 1 || bond_type > atom->nbondtypes)
    error->fix_error(FLERR, this,
                     ("there is no bond type " + std::string(arg[6]) + ": 1 to " +
                      std::to_string(atom->nbondtypes) + " are known")
                         .c_str());
  if (!(tolerance >= 0.0 && tolerance < 1.0))
    error->fix_error(
        FLERR, this,
        ("tolerance must be 0 or more and less than 1, not " + std::string(arg[8])).c_str());
  force_reneighbor = 1;
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 1;
}

int FixSolidemBondCreate::setmask() {
  return PRE_NEIGHBOR;
}

void FixSolidemBondCreate::init() {
  if (modify->n_fixes_style_strict("solidem/bonds") != 1)
    error->fix_error(FLERR, this, "needs one 'fix ID all solidem/bonds' before it");
  bonds = static_cast<FixSolidemBonds*>(modify->find_fix_style_strict("solidem/bonds", 0));
  orientation = static_cast<FixPropertyAtom*>(
      modify->find_fix_property("orientation", "property/atom", "vector", 4, 0, style));
  const BondSolidemBeam* beams = dynamic_cast<BondSolidemBeam*>(force->bond);
  if (beams && beams->may_expand())
    error->fix_error(FLERR, this,
                     "bonds that expand are as long at the reference temperature as when first "
                     "seen; those made in the run would be at another: leave out expansion");
  // Two ranks may see a pair across a periodic face with another last digit.
  if (!force->newton_bond && (domain->xperiodic || domain->yperiodic || domain->zperiodic))
    error->fix_error(FLERR, this,
                     "bonds that are made in a periodic box need newton_bond on ('newton off on')");
}

double FixSolidemBondCreate::extend_cut_ghost() {
  return solidem_reach(atom, world);
}

void FixSolidemBondCreate::setup_pre_neighbor() {
  pre_neighbor();
}

// Ghosts are known, and the lists that will see the bonds are not built yet.
void FixSolidemBondCreate::pre_neighbor() {
  if (update->ntimestep == next_reneighbor) create();
}

void FixSolidemBondCreate::create() {
  if (atom->nbonds == 0) let_orientations_count_from_now();
  orientation->do_forward_comm();
  const std::vector<std::vector<int> > found = partners();
  double here = 0.0, all;
  for (int i = 0; i < atom->nlocal; i++)
    for (const int j : found[i]) {
      bond(i, j);
      here += force->newton_bond ? 1.0 : 0.5;  // else both atoms list it
    }
  bonds->pre_neighbor();
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  made += all;
  atom->nbonds += static_cast<bigint>(all + 0.5);
}

// Grains may have turned before: without any bond that means nothing.
void FixSolidemBondCreate::let_orientations_count_from_now() {
  for (int i = 0; i < atom->nlocal; i++) {
    double* q = orientation->array_atom[i];
    q[0] = 1.0;
    q[1] = q[2] = q[3] = 0.0;
  }
}

/* ----------------------------------------------------------------------
   the new partners of each atom of this rank, in the order of their tags; with
   newton_bond on the lower of two atoms lists the bond
------------------------------------------------------------------------- */

std::vector<std::vector<int> > FixSolidemBondCreate::partners() const {
  const int all = atom->nlocal + atom->nghost;
  double largest = 0.0;
  for (int i = 0; i < all; i++) largest = std::max(largest, atom->radius[i]);
  const double edge = 2.0 * (1.0 + tolerance) * largest;
  const auto cell_of = [&](int i) {
    std::array<int, 3> cell;
    for (int k = 0; k < 3; k++)
      cell[k] = static_cast<int>(std::floor((atom->x[i][k] - domain->boxlo[k]) / edge));
    return cell;
  };
  std::map<std::array<int, 3>, std::vector<int> > cells;
  for (int i = 0; i < all; i++)
    if (atom->mask[i] & groupbit) cells[cell_of(i)].push_back(i);

  std::vector<std::vector<int> > found(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    std::map<int, int> near;  // by tag: of several images one
    const std::array<int, 3> home = cell_of(i);
    for (int n = 0; n < 27; n++) {
      const auto cell =
          cells.find({home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1});
      if (cell == cells.end()) continue;
      for (const int j : cell->second)
        if (is_near(i, j)) near[atom->tag[j]] = j;
    }
    for (const auto& partner : near) found[i].push_back(partner.second);
  }
  return found;
}

bool FixSolidemBondCreate::is_near(int i, int j) const {
  if (atom->tag[i] == atom->tag[j]) return false;
  if (force->newton_bond && atom->tag[i] > atom->tag[j]) return false;
  double square = 0.0;
  for (int k = 0; k < 3; k++) {
    const double d = atom->x[i][k] - atom->x[j][k];
    square += d * d;
  }
  const double reach = (1.0 + tolerance) * (atom->radius[i] + atom->radius[j]);
  return square <= reach * reach && !is_bonded(i, j);
}

bool FixSolidemBondCreate::is_bonded(int i, int j) const {
  const auto lists = [this](int a, int b) {
    const int* begin = atom->bond_atom[a];
    return std::find(begin, begin + atom->num_bond[a], atom->tag[b]) != begin + atom->num_bond[a];
  };
  const int other = atom->map(atom->tag[j]);
  return lists(i, j) || (other >= 0 && other < atom->nlocal && lists(other, i));
}

void FixSolidemBondCreate::bond(int i, int j) {
  const int n = atom->num_bond[i];
  if (n == atom->bond_per_atom)
    error->one(FLERR, ("Fix solidem/bond/create: atom " + std::to_string(atom->tag[i]) +
                       " has no room for more than " + std::to_string(n) +
                       " bonds: reserve some by the header line 'N extra bond per atom' of the "
                       "data file")
                          .c_str());
  require_unturned(i, j);
  atom->bond_type[i][n] = bond_type;
  atom->bond_atom[i][n] = atom->tag[j];
  atom->num_bond[i]++;
}

// An elastic bond remembers one rest direction for both atoms.
void FixSolidemBondCreate::require_unturned(int i, int j) {
  const BondSolidemBeam* style_of_bonds = dynamic_cast<BondSolidemBeam*>(force->bond);
  if (!style_of_bonds || !style_of_bonds->bears_moments() ||
      style_of_bonds->beam(bond_type).may_change())
    return;
  const double *p = orientation->array_atom[i], *q = orientation->array_atom[j];
  const double cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
  if (std::fabs(std::fabs(cosine) - 1.0) > 1e-12)
    error->one(FLERR, ("Fix solidem/bond/create: atoms " + std::to_string(atom->tag[i]) + " and " +
                       std::to_string(atom->tag[j]) +
                       " have turned against each other since the first bonds were made: a bond "
                       "between them must be of a type that may flow or break")
                          .c_str());
}
