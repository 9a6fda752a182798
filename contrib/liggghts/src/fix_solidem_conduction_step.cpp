// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers

// Heat through a time step.
//
// By itself heat steps as forces do: fluxes of all fixes in post_force, after the heat of contacts
// of that step, and temperatures after them. Where bonds give heat or look at temperatures it steps
// before the bonds act in the new pose: what flow made until the last pose comes to the atoms, then
// heat is conducted over the step, and bonds see the temperatures that hold in their pose. So does
// solidem's own step.
//
// With `every` above 1 heat steps once in so many steps of the motion, over all of the time that
// they took, and with the last one before the run's end, which `run ... stop` may put beyond it.
// That is always before the forces: what flow makes and what bonds see of it wait in between.
#include <string.h>

#include <algorithm>

#include "atom.h"
#include "bond_solidem_beam.h"
#include "fix_property_atom.h"
#include "fix_solidem_conduction.h"
#include "fix_solidem_exchange.h"
#include "fix_solidem_friction.h"
#include "fix_solidem_temperature.h"
#include "fix_solidem_touch.h"
#include "force.h"
#include "integrate.h"
#include "modify.h"
#include "solidem_waiting_heat.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

// Names the member that says whether somebody else sets forces to zero, which is for heirs alone.
struct Heir : public Integrate {
  static int& cleared_elsewhere(Integrate* integrate) {
    return integrate->*(&Heir::external_force_clear);
  }
};

template <class Style>
std::vector<Style*> fixes(Modify* modify) {
  std::vector<Style*> found;
  for (int k = 0; k < modify->nfix; k++)
    if (auto* one = dynamic_cast<Style*>(modify->fix[k])) found.push_back(one);
  return found;
}

}  // namespace

void FixSolidemConduction::find_what_bonds_ask() {
  const BondSolidemBeam* beams = dynamic_cast<BondSolidemBeam*>(force->bond);
  const bool flow_heats = beams && beams->gives_heat();
  leads_ = every_ > 1 || flow_heats || (beams && beams->follows_temperature());
  const bool friction_heats = modify->n_fixes_style_strict("solidem/friction") > 0;
  contacts_heat_ = friction_heats || modify->n_fixes_style_strict("solidem/touch") > 0;
  waiting_heat =
      flow_heats || friction_heats ? solidem_waiting_heat(modify, atom->nlocal, style) : NULL;
}

// Tells that a step of the motion has passed: how long a step heat takes now, 0 if it waits, s.
double FixSolidemConduction::pass() {
  waited_++;
  waited_time_ += update->dt;
  if (waited_ < every_ && update->ntimestep != update->endstep) return 0.0;
  const double time = waited_time_;
  waited_ = 0;
  waited_time_ = 0.0;
  return time;
}

void FixSolidemConduction::post_integrate() {
  if (!leads_) return;
  const double time = pass();
  if (time == 0.0) return;
  const auto imposed = fixes<FixSolidemTemperature>(modify);
  take_waiting_heat();
  for (FixSolidemTouch* touch : fixes<FixSolidemTouch>(modify)) touch->exchange(time);
  for (FixSolidemTemperature* one : imposed) one->hold();
  double* flux = heat_flux->vector_atom;
  std::fill_n(flux + atom->nlocal, atom->nghost, 0.0);
  conduct();
  for (FixSolidemExchange* wall : fixes<FixSolidemExchange>(modify)) wall->exchange(time);
  step(time);
  for (FixSolidemTemperature* one : imposed) one->move_on();
}

// What a temperature cannot show of it, for it has no such digits, waits on: nothing is lost.
void FixSolidemConduction::take_waiting_heat() {
  if (!waiting_heat) return;
  double* waiting = waiting_heat->vector_atom;
  double* temp = temperature->vector_atom;
  for (int i = 0; i < atom->nlocal; i++) {
    if (waiting[i] == 0.0) continue;
    const double before = temp[i], capacity = heat_capacity(i);
    temp[i] += waiting[i] / capacity;
    waiting[i] -= (temp[i] - before) * capacity;
  }
}

// Other fixes add to the fluxes too; temperatures change after all have done so.
void FixSolidemConduction::post_force(int) {
  if (leads_) return;
  if (contacts_heat_) take_heat_of_contacts();
  conduct();
}

// Of this very pose: the forces have acted in it.
void FixSolidemConduction::take_heat_of_contacts() {
  for (FixSolidemFriction* friction : fixes<FixSolidemFriction>(modify)) friction->enter();
  take_waiting_heat();
  for (FixSolidemTouch* touch : fixes<FixSolidemTouch>(modify)) touch->exchange(update->dt);
  for (FixSolidemTemperature* imposed : fixes<FixSolidemTemperature>(modify)) imposed->hold();
}

void FixSolidemConduction::conduct() {
  const double* temp = temperature->vector_atom;
  double* flux = heat_flux->vector_atom;
  temperature->do_forward_comm();
  solidem_kernels().conduct(
      {atom->nlocal, first_row.data(), neighbour.data(), row_conductance.data(), temp, flux});
  for (const Conductor& bond : outward)
    flux[bond.j] -= bond.conductance * (temp[bond.j] - temp[bond.i]);
  if (force->newton_bond) heat_flux->do_reverse_comm();
}

// Whether there may be forces, or motion. Where heat is conducted and nothing else happens,
// LIGGGHTS would take a quarter of the time to set forces to zero that are zero already.
bool FixSolidemConduction::somebody_acts() const {
  if (force->pair || force->bond || force->angle || force->dihedral || force->improper ||
      force->kspace)
    return true;
  for (int k = 0; k < modify->nfix; k++) {
    const Fix* fix = modify->fix[k];
    const bool is_of_heat = strcmp(fix->style, "solidem/conduction") == 0 ||
                            strcmp(fix->style, "solidem/temperature") == 0 ||
                            strcmp(fix->style, "solidem/exchange") == 0;
    const int acts = PRE_FORCE | POST_FORCE | INITIAL_INTEGRATE | FINAL_INTEGRATE;
    if (fix->time_integrate || (!is_of_heat && (modify->fmask[k] & acts))) return true;
  }
  return false;
}

// Of atoms that have come.
void FixSolidemConduction::clear_forces() {
  const int all = 3 * (atom->nlocal + atom->nghost);
  if (all == 0) return;
  std::fill_n(atom->f[0], all, 0.0);
  if (atom->torque_flag) std::fill_n(atom->torque[0], all, 0.0);
}

// Unless another fix leaves them already.
void FixSolidemConduction::leave_forces(bool leave) {
  int& external = Heir::cleared_elsewhere(update->integrate);
  if (leave == leaves_forces_ || (leave && external)) return;
  external = leaves_forces_ = leave;
}

void FixSolidemConduction::post_run() {
  leave_forces(false);
}

void FixSolidemConduction::final_integrate() {
  if (!leads_) step(update->dt);
}

void FixSolidemConduction::step(double time) {
  if (checked_step != update->dt) require_stable_step();  // it was changed in mid-run
  if (step_of_capacities != time) find_steps(time);
  double* temp = temperature->vector_atom;
  const double* flux = heat_flux->vector_atom;
  const double* source = heat_source->vector_atom;
  for (int i = 0; i < atom->nlocal; i++) temp[i] += step_over_capacity[i] * (flux[i] + source[i]);
}
