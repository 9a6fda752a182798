// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_exchange.h"

#include <stdio.h>
#include <string.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_property_atom.h"
#include "fix_solidem_conduction.h"
#include "modify.h"
#include "neighbor.h"
#include "solidem_number.h"
#include "solidem_restart.h"
#include "solidem_table.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixSolidemExchange::FixSolidemExchange(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      outer(NULL),
      outer_now(0.0),
      heat_supplied(0.0),
      conduction(NULL),
      temperature(NULL),
      heat_flux(NULL) {
  if (igroup != 0) error->fix_error(FLERR, this, "must be used with group 'all'");
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (iarg + 1 == narg) error->fix_error(FLERR, this, ("keyword without value: " + key).c_str());
    if (key == "file")
      file = arg[iarg + 1];
    else if (key == "name")
      name = arg[iarg + 1];
    else if (key == "temperature" && !outer)
      outer = new SolidemNumber(liggghts, this, arg[iarg + 1]);
    else
      error->fix_error(
          FLERR, this,
          ("unknown or repeated keyword '" + key + "': known are file, name, temperature").c_str());
  }
  if (file.empty() || name.empty() || !outer)
    error->fix_error(FLERR, this, "needs all of: file, name, temperature");
  read_file();

  nevery = 1;
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 1;
  restart_global = 1;
}

FixSolidemExchange::~FixSolidemExchange() {
  delete outer;
}

void FixSolidemExchange::read_file() {
  const std::vector<double> rows = solidem_table(lmp, file, name, 2);
  for (std::size_t k = 0; k < rows.size(); k += 2) {
    const Contact contact = {static_cast<int>(rows[k]), rows[k + 1]};
    char message[120];
    message[0] = 0;
    if (contact.atom != rows[k] || contact.atom < 1)
      snprintf(message, sizeof message, ": %g is no number of an atom", rows[k]);
    else if (!(contact.conductance > 0.0))
      snprintf(message, sizeof message, ": conductance %g of atom %d; must be above 0",
               contact.conductance, contact.atom);
    if (message[0])
      error->fix_error(FLERR, this, (file + ", section '" + name + "'" + message).c_str());
    contacts.push_back(contact);
  }
}

int FixSolidemExchange::setmask() {
  return PRE_FORCE | POST_FORCE | END_OF_STEP;
}

void FixSolidemExchange::init() {
  conduction =
      dynamic_cast<FixSolidemConduction*>(modify->find_fix_style_strict("solidem/conduction", 0));
  if (!conduction) error->fix_error(FLERR, this, "needs a 'fix ID all solidem/conduction'");
  temperature = static_cast<FixPropertyAtom*>(
      modify->find_fix_property("Temp", "property/atom", "scalar", 0, 0, style));
  heat_flux = static_cast<FixPropertyAtom*>(
      modify->find_fix_property("heatFlux", "property/atom", "scalar", 0, 0, style));
  outer->init();
}

void FixSolidemExchange::setup_pre_force(int) {
  find_local();
  const int here = static_cast<int>(local.size());
  int everywhere;
  MPI_Allreduce(&here, &everywhere, 1, MPI_INT, MPI_SUM, world);
  if (everywhere == static_cast<int>(contacts.size())) return;
  char message[120];
  snprintf(message, sizeof message, " has %d atoms that do not exist here",
           static_cast<int>(contacts.size()) - everywhere);
  error->fix_error(FLERR, this, (file + ", section '" + name + "'" + message).c_str());
}

void FixSolidemExchange::pre_force(int) {
  if (neighbor->ago == 0) find_local();
}

void FixSolidemExchange::find_local() {
  local.clear();
  for (const Contact& contact : contacts) {
    if (atom->map_style == 1 && contact.atom > atom->map_tag_max) continue;  // beyond the array
    const int i = atom->map(contact.atom);
    if (i >= 0 && i < atom->nlocal) local.push_back({i, contact.conductance});
  }
}

void FixSolidemExchange::add_conductances(double* of_atoms) const {
  for (const Contact& contact : local) of_atoms[contact.atom] += contact.conductance;
}

// A step of heat takes the outer temperature at its start, as it takes all others.
void FixSolidemExchange::setup(int) {
  end_of_step();
}

void FixSolidemExchange::end_of_step() {
  if (!conduction->waits()) outer_now = outer->temperature();
}

void FixSolidemExchange::post_force(int) {
  if (!conduction->leads()) exchange(update->dt);
}

void FixSolidemExchange::exchange(double time) {
  const double* temp = temperature->vector_atom;
  double* flux = heat_flux->vector_atom;
  for (const Contact& contact : local) {
    const double power = contact.conductance * (outer_now - temp[contact.atom]);
    flux[contact.atom] += power;
    heat_supplied += power * time;
  }
}

/* ----------------------------------------------------------------------
   heat supplied to the atoms so far, J
------------------------------------------------------------------------- */

double FixSolidemExchange::compute_scalar() {
  double total;
  MPI_Allreduce(&heat_supplied, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  return total;
}

void FixSolidemExchange::write_restart(FILE* fp) {
  const double total = compute_scalar();
  if (comm->me != 0) return;
  solidem_write_restart(fp, {total, outer_now});
}

void FixSolidemExchange::restart(char* buffer) {
  const std::vector<double> kept = solidem_read_restart(error, this, buffer, 2);
  if (comm->me == 0) heat_supplied = kept[0];
  outer_now = kept[1];
}

double FixSolidemExchange::memory_usage() {
  return (contacts.capacity() + local.capacity()) * sizeof(Contact);
}
