// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_touch.h"

#include <string.h>

#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_property_atom.h"
#include "fix_solidem_conduction.h"
#include "force.h"
#include "laws/contact_exchange.hpp"
#include "modify.h"
#include "neighbor.h"
#include "solidem_restart.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixSolidemTouch::FixSolidemTouch(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      conductance(0.0),
      coefficient(0.0),
      conduction(NULL),
      temperature(NULL) {
  if (igroup != 0) error->fix_error(FLERR, this, "must be used with group 'all'");
  read_arguments(narg, arg);
  scalar_flag = 1;
  vector_flag = 1;
  size_vector = static_cast<int>(tools.size());
  global_freq = 1;
  extscalar = 1;
  extvector = 1;
  restart_global = 1;
}

FixSolidemTouch::~FixSolidemTouch() {
  leave_walls(modify);
}

void FixSolidemTouch::read_arguments(int narg, char** arg) {
  for (int iarg = 3; iarg < narg;) {
    const std::string key = arg[iarg];
    const int values = key == "conductance" || key == "coefficient" ? 1 : key == "tool" ? 2 : 0;
    if (values == 0)
      error->fix_error(
          FLERR, this,
          ("unknown keyword '" + key + "': known are conductance, coefficient, tool").c_str());
    if (iarg + values >= narg)
      error->fix_error(FLERR, this, ("keyword without value: " + key).c_str());
    const double value = force->numeric(FLERR, arg[iarg + values]);
    if (values == 1) {
      if (!(value > 0.0)) error->fix_error(FLERR, this, (key + " must be positive").c_str());
      (key == "conductance" ? conductance : coefficient) = value;
    } else {
      tools.push_back({arg[iarg + 1], value, 0.0, NULL});
      if (!(value >= 0.0))
        error->fix_error(FLERR, this,
                         ("the temperature of tool " + tools.back().id +
                          " is counted from absolute zero and must not be below it, but is " +
                          arg[iarg + values])
                             .c_str());
    }
    iarg += 1 + values;
  }
  if ((conductance > 0.0) == (coefficient > 0.0) || tools.empty())
    error->fix_error(FLERR, this, "needs either conductance or coefficient, and a tool at least");
}

int FixSolidemTouch::setmask() {
  return PRE_FORCE;
}

void FixSolidemTouch::init() {
  conduction =
      dynamic_cast<FixSolidemConduction*>(modify->find_fix_style_strict("solidem/conduction", 0));
  if (!conduction) error->fix_error(FLERR, this, "needs a 'fix ID all solidem/conduction'");
  temperature = static_cast<FixPropertyAtom*>(
      modify->find_fix_property("Temp", "property/atom", "scalar", 0, 0, style));
  watch_walls(modify, error, this, conduction);
  for (Tool& tool : tools) tool.fix = find_tool(modify, error, this, tool.id);
}

void FixSolidemTouch::setup_pre_force(int step) {
  pre_force(step);
}

// Walls tell those of the new pose.
void FixSolidemTouch::pre_force(int) {
  ways.clear();
}

void FixSolidemTouch::see(const SolidemTouch& touch) {
  if (!touch.touches) return;
  for (std::size_t k = 0; k < tools.size(); k++) {
    if (tools[k].fix != touch.tool) continue;
    const double area = solidem::overlap_area(1.0 / atom->radius[touch.i], 0.0, touch.overlap);
    ways.push_back(
        {touch.i, static_cast<int>(k), conductance > 0.0 ? conductance : coefficient * area});
  }
}

// In one order and in the opposite, as solidem does: where an atom touches two tools.
void FixSolidemTouch::exchange(double time) {
  for (const Way& way : ways) exchange(way, 0.5 * time);
  for (auto way = ways.rbegin(); way != ways.rend(); ++way) exchange(*way, 0.5 * time);
}

void FixSolidemTouch::exchange(const Way& way, double time) {
  double& temp = temperature->vector_atom[way.atom];
  Tool& tool = tools[way.tool];
  const double before = temp, capacity = conduction->heat_capacity(way.atom);
  temp +=
      solidem::exchanged_heat(way.conductance, 1.0 / capacity, tool.temperature - before, time) /
      capacity;
  tool.heat += capacity * (temp - before);
}

double FixSolidemTouch::total(double here) const {
  double all;
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   heat that all tools gave so far, J
------------------------------------------------------------------------- */

double FixSolidemTouch::compute_scalar() {
  double here = 0.0;
  for (const Tool& tool : tools) here += tool.heat;
  return total(here);
}

/* ----------------------------------------------------------------------
   heat that the n-th tool gave so far, J
------------------------------------------------------------------------- */

double FixSolidemTouch::compute_vector(int n) {
  return total(tools[n].heat);
}

void FixSolidemTouch::write_restart(FILE* fp) {
  std::vector<double> totals;
  for (const Tool& tool : tools) totals.push_back(total(tool.heat));
  if (comm->me == 0) solidem_write_restart(fp, totals);
}

void FixSolidemTouch::restart(char* buffer) {
  const std::vector<double> totals =
      solidem_read_restart(error, this, buffer, static_cast<int>(tools.size()));
  for (std::size_t k = 0; k < tools.size(); k++) tools[k].heat = comm->me == 0 ? totals[k] : 0.0;
}

double FixSolidemTouch::memory_usage() {
  return ways.capacity() * sizeof(Way);
}
