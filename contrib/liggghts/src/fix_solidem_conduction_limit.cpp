// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// How long a step conduction bears.
#include <stdio.h>
#include <string.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "atom.h"
#include "error.h"
#include "fix_property_atom.h"
#include "fix_solidem_conduction.h"
#include "fix_solidem_exchange.h"
#include "force.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   an explicit step is stable up to 2 over the fastest decay of any field of
   temperatures, which is once to twice the fastest of one warm atom alone
------------------------------------------------------------------------- */

void FixSolidemConduction::require_stable_step() {
  const std::vector<double> conductance = conductances_of_atoms();
  const std::vector<bool> free = free_atoms();
  double here = 0.0, fastest;
  for (int i = 0; i < atom->nlocal; i++)
    if (free[i]) here = std::max(here, conductance[i] / heat_capacity(i));
  MPI_Allreduce(&here, &fastest, 1, MPI_DOUBLE, MPI_MAX, world);
  checked_step = update->dt;
  const double step = every_ * update->dt;
  if (step * fastest <= 1.0) return;

  here = fastest_decay(conductance, free);
  MPI_Allreduce(&here, &fastest, 1, MPI_DOUBLE, MPI_MAX, world);
  if (step * fastest <= 2.0) return;
  char message[160];
  const std::string waits = every_ > 1 ? ", " + std::to_string(every_) + " at a time," : "";
  snprintf(message, sizeof message,
           "the time step %g%s is unstable: conduction bears steps below %.3g at most", update->dt,
           waits.c_str(), 2.0 / (every_ * fastest));
  error->fix_error(FLERR, this, message);
}

// The sum of what leads to each local atom, walls included, W/K.
std::vector<double> FixSolidemConduction::conductances_of_atoms() {
  double* sum = heat_flux->vector_atom;  // the ranks' common place; afterwards it is as it was
  const std::vector<double> flux(sum, sum + atom->nlocal + atom->nghost);
  std::fill_n(sum, flux.size(), 0.0);
  for (const Conductor& bond : conductors) {
    sum[bond.i] += bond.conductance;
    if (force->newton_bond || bond.j < atom->nlocal) sum[bond.j] += bond.conductance;
  }
  if (force->newton_bond) heat_flux->do_reverse_comm();
  std::vector<double> conductance(sum, sum + atom->nlocal);
  std::copy(flux.begin(), flux.end(), sum);
  for (int k = 0; k < modify->nfix; k++)
    if (const FixSolidemExchange* wall = dynamic_cast<FixSolidemExchange*>(modify->fix[k]))
      wall->add_conductances(conductance.data());
  return conductance;
}

// Those whose temperature nothing imposes.
std::vector<bool> FixSolidemConduction::free_atoms() const {
  int imposed = 0;
  for (int k = 0; k < modify->nfix; k++)
    if (strcmp(modify->fix[k]->style, "solidem/temperature") == 0)
      imposed |= modify->fix[k]->groupbit;
  std::vector<bool> free(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) free[i] = !(atom->mask[i] & imposed);
  return free;
}

/* ----------------------------------------------------------------------
   by power iteration on the atoms of this rank, their neighbours elsewhere
   held still: never above the body's own, 1/s
------------------------------------------------------------------------- */

double FixSolidemConduction::fastest_decay(const std::vector<double>& conductance,
                                           const std::vector<bool>& free) const {
  const int nlocal = atom->nlocal, iterations = 200;
  std::vector<double> field(nlocal), change(nlocal), root(nlocal);
  for (int i = 0; i < nlocal; i++) {
    root[i] = 1.0 / sqrt(heat_capacity(i));
    field[i] = free[i] ? sin(1.0 + 2.0 * atom->tag[i]) : 0.0;
  }
  double rate = 0.0;
  for (int k = 0; k < iterations; k++) {
    for (int i = 0; i < nlocal; i++) change[i] = conductance[i] * root[i] * root[i] * field[i];
    for (const Conductor& bond : conductors) {
      if (bond.j >= nlocal) continue;
      const double coupling = bond.conductance * root[bond.i] * root[bond.j];
      change[bond.i] -= coupling * field[bond.j];
      change[bond.j] -= coupling * field[bond.i];
    }
    double square = 0.0, product = 0.0;
    for (int i = 0; i < nlocal; i++) {
      if (!free[i]) change[i] = 0.0;
      product += field[i] * change[i];
      square += change[i] * change[i];
    }
    if (square == 0.0) break;
    if (k > 0) rate = product;  // the field has length 1 from then on, and the quotient only grows
    for (int i = 0; i < nlocal; i++) field[i] = change[i] / sqrt(square);
  }
  return rate;
}
