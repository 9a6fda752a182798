// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_beam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "laws/contact.hpp"

namespace LAMMPS_NS {

using solidem::BeamHistory;
using solidem::Quaternion;
using solidem::YieldingBeam;
typedef solidem::Vector3<double> Vector;
typedef SolidemBondMemory Row;

namespace {

// Lips of a broken bond that are this many times the sum of their radii apart never touch again.
const double REACH_OF_CONTACT = 1.5;

void store(double* place, const Vector& a) {
  place[0] = a.x;
  place[1] = a.y;
  place[2] = a.z;
}

}  // namespace

int SolidemBeam::width() const {
  if (feels_rate()) return Row::WITH_RATE;
  if (is_offset()) return Row::WITH_REST_DIRECTION;
  if (flows) return Row::FLOWING;
  return may_change() ? Row::BREAKING : Row::ELASTIC;
}

// A bond that breaks or is cut in this step acts as a beam once more.
bool SolidemBeam::acts_as_beam(const double* memory, double step) const {
  if (!may_break()) return true;
  const double broke = memory[Row::RUPTURE];
  return broke == 0.0 || broke == step + 1.0 || broke == step + 1.5;
}

// One that is made anew in this step pushes once more.
bool SolidemBeam::made_anew(const double* memory, double step) const {
  return may_break() && memory[Row::RUPTURE] == -(step + 2.0);
}

// A new bond, free of load in this pose.
void SolidemBeam::make(double* memory, const SolidemBondEnds& ends) const {
  const double length = solidem::norm(ends.chord);
  const Vector direction = (1.0 / length) * ends.chord;
  const Quaternion<double> back_i = solidem::conjugate(ends.orientation_i);
  store(memory + Row::NORMAL_I, solidem::rotate(back_i, direction));
  memory[Row::REST_LENGTH] = length;
  if (!may_change()) return;
  store(memory + Row::NORMAL_J, solidem::rotate(solidem::conjugate(ends.orientation_j), direction));
  memory[Row::EXTENSION] = memory[Row::PLASTIC_STRAIN] = memory[Row::RUPTURE] = 0.0;
  memory[Row::ENERGY] = 0.0;
  std::fill_n(memory + Row::LAST, 9, 0.0);
  if (feels_rate()) memory[Row::FLOW_RATE] = 0.0;
  if (flows) keep_turn(memory, ends);
  memory[Row::TWIST] = 2.0 * dot((ends.orientation_j * back_i).v, direction);
  if (is_offset()) store(memory + Row::REST_DIRECTION, solidem::rotate(back_i, direction));
}

/* ----------------------------------------------------------------------
   a bond that broke, was cut or was made anew: one that breaks or is cut in
   this very pose acts as a beam once more
------------------------------------------------------------------------- */

SolidemBondAction SolidemBeam::act_broken(double* memory, const SolidemBondEnds& ends, double step,
                                          bool energies) const {
  if (!acts_as_beam(memory, step)) {
    if (!Row::is_whole(memory) || made_anew(memory, step)) return act_apart(memory, ends, step);
    // The push that the bond took the place of worked once more on the way from there.
    const double work =
        0.5 * memory[Row::FLOW] * (solidem::norm(ends.chord) - memory[Row::REST_LENGTH]);
    memory[Row::RUPTURE] = memory[Row::FLOW] = 0.0;
    SolidemBondAction action = act(memory, ends, step, energies);
    action.fracture_energy -= work;
    return action;
  }
  const YieldingBeam<double> bond = beam(memory, ends);
  const State now = state(memory, ends, bond.rest_length);
  SolidemBondAction action;
  action.load = solidem::beam_load(bond.rigidity, now.pose, now.deformation);
  if (!Row::is_cut(memory)) action.contact_energy = contact(memory, ends).energy;
  return action;
}

// A bond that may have reached a limit: it flows or breaks once a step at most.
SolidemBondAction SolidemBeam::act_near_limit(double* memory, const SolidemBondEnds& ends,
                                              const YieldingBeam<double>& bond, State now,
                                              double step, bool energies) const {
  SolidemBondAction action;
  if (!flows || memory[Row::FLOW] != step + 1.0) {
    const solidem::BondStrain<double> strain = flow(memory, ends, bond, now, step, action);
    action.breaks = breaks && solidem::breaks(rupture, strain);
  }
  action.load = solidem::beam_load(bond.rigidity, now.pose, now.deformation);
  if (energies || action.breaks)
    action.elastic_energy = solidem::beam_energy(bond.rigidity, now.pose, now.deformation);
  if (action.breaks) {
    memory[Row::RUPTURE] = step + 1.0;
    memory[Row::FLOW] = touching_distance(memory, ends, bond, action.load.force);
    action.contact_energy = contact(memory, ends).energy;
    action.fracture_energy = action.elastic_energy - action.contact_energy;
    memory[Row::ENERGY] = action.fracture_energy;
    keep_last(memory, ends, solidem::beam_modes(now.pose, now.deformation, ends.orientation_i),
              bond.rest_length, solidem::norm(contact(memory, ends).force));
    action.elastic_energy = 0.0;
  }
  return action;
}

// The rate of flow was averaged over the time that is past, the less the longer ago: what is left
// of it, and what a flow in this step adds.
double SolidemBeam::rate_left(const double* memory, const SolidemBondEnds& ends,
                              double step) const {
  const double steps = step - (memory[Row::FLOW] - 1.0);
  return memory[Row::FLOW_RATE] * std::exp(-steps * ends.time_step / rate_time);
}

double SolidemBeam::rate_per_flow(const SolidemBondEnds& ends) const {
  return -std::expm1(-ends.time_step / rate_time) / ends.time_step;
}

// The yield strain of the bond as it grows with the plastic strain in this step.
template <class Yield>
solidem::YieldCurve<Yield, double> SolidemBeam::yield_curve(const Yield& known,
                                                            const double* memory,
                                                            const SolidemBondEnds& ends,
                                                            double step) const {
  solidem::YieldCurve<Yield, double> curve{known};
  if constexpr (solidem::depends_on_state<Yield>) {
    curve.state.temperature = ends.temperature();
    if (!feels_rate()) return curve;
    curve.state.rate = rate_left(memory, ends, step);
    curve.flow_start = memory[Row::PLASTIC_STRAIN];
    curve.rate_per_flow = rate_per_flow(ends);
  }
  return curve;
}

// What the laws answer; nothing is remembered.
solidem::BeamResponse<double> SolidemBeam::response(const double* memory,
                                                    const SolidemBondEnds& ends,
                                                    const YieldingBeam<double>& bond,
                                                    const State& now, double step) const {
  BeamHistory<double> before = history(memory);
  if (!flows) return solidem::elastic_response<double>(bond, before, {now.pose, now.deformation});
  before.last = {last_modes(memory, bond.rest_length), last_turn(memory)};
  return std::visit(
      [&](const auto& known) {
        const auto yield = yield_curve(known, memory, ends, step);
        const Vector rest_direction =
            is_offset() ? solidem_vector(memory + Row::REST_DIRECTION) : before.normal_i;
        return solidem::flow_response(flow_rule, yield, bond, before, rest_direction,
                                      {ends.chord, ends.orientation_i, ends.orientation_j});
      },
      hardening);
}

/* ----------------------------------------------------------------------
   plastic flow, if any; the strain that is left. The load that acts is that of
   the shape remembered afterwards, so that a second look at the pose finds the
   same
------------------------------------------------------------------------- */

solidem::BondStrain<double> SolidemBeam::flow(double* memory, const SolidemBondEnds& ends,
                                              const YieldingBeam<double>& bond, State& now,
                                              double step, SolidemBondAction& action) const {
  const solidem::BeamResponse<double> response = this->response(memory, ends, bond, now, step);
  if (!(response.history.strain > memory[Row::PLASTIC_STRAIN])) {
    keep_last(memory, ends, response.history.last.modes, bond.rest_length, 0.0);
    return response.strains;
  }
  action.heat_of_each = 0.5 * plastic_heat * response.plastic_work;
  keep_last(memory, ends, response.history.last.modes, bond.rest_length, 0.0);

  if (feels_rate())
    memory[Row::FLOW_RATE] =
        rate_left(memory, ends, step) +
        rate_per_flow(ends) * (response.history.strain - memory[Row::PLASTIC_STRAIN]);
  store(memory + Row::NORMAL_I, response.history.normal_i);
  store(memory + Row::NORMAL_J, response.history.normal_j);
  memory[Row::EXTENSION] = response.history.extension;
  memory[Row::TWIST] = response.history.twist;
  memory[Row::PLASTIC_STRAIN] = response.history.strain;
  memory[Row::PLASTIC_WORK] += response.plastic_work;
  memory[Row::FLOW] = step + 1.0;
  now = state(memory, ends, bond.rest_length);
  return response.strains;
}

// Where the atoms of a bond touch that breaks in this pose with this force on i.
double SolidemBeam::touching_distance(const double* memory, const SolidemBondEnds& ends,
                                      const YieldingBeam<double>& bond, const Vector& force) const {
  const double free_distance = solidem::contact_distance(bond.rest_length, memory[Row::EXTENSION],
                                                         ends.radius_i + ends.radius_j);
  if (contact_ratio == 0.0) return free_distance;
  const double length = solidem::norm(ends.chord);
  return solidem::contact_distance(free_distance, length,
                                   std::max(0.0, -dot(force, ends.chord) / length),
                                   contact_ratio * bond.rigidity.axial / bond.rest_length);
}

/* ----------------------------------------------------------------------
   what a bond lost besides, by its last act in the step that led to this pose:
   half of what its load did along the way, as that of the contact which took
   its place. What is left of its energy is that of both poses together
------------------------------------------------------------------------- */

double SolidemBeam::lost_by_last_act(double* memory, const SolidemBondEnds& ends,
                                     double step) const {
  if (std::floor(memory[Row::RUPTURE]) != step) return 0.0;
  const YieldingBeam<double> bond = beam(memory, ends);
  const State now = state(memory, ends, bond.rest_length);
  const solidem::BeamModes<double> then = last_modes(memory, bond.rest_length);
  const double push = memory[Row::LAST + 8];  // of the contact, then
  const double energy =
      solidem::mutual_energy(bond.rigidity, 1 / bond.rest_length, then,
                             solidem::beam_modes(now.pose, now.deformation, ends.orientation_i)) -
      0.5 * push * (memory[Row::FLOW] - solidem::norm(ends.chord));
  const double lost = energy - memory[Row::ENERGY];
  memory[Row::ENERGY] = energy;  // not a second time
  return lost;
}

// The push of two atoms whose bond broke, and the energy in it.
SolidemBeam::Contact SolidemBeam::contact(const double* memory, const SolidemBondEnds& ends) const {
  if (contact_ratio == 0.0) return {Vector{}, 0.0};
  const YieldingBeam<double> bond = beam(memory, ends);
  const double stiffness = contact_ratio * bond.rigidity.axial / bond.rest_length;
  const double distance = memory[Row::FLOW];
  return {solidem::contact_force(stiffness, distance, ends.chord),
          solidem::contact_energy(stiffness, distance, ends.chord)};
}

/* ----------------------------------------------------------------------
   a broken bond: its atoms push each other, are made one again by pressure,
   or part for good
------------------------------------------------------------------------- */

SolidemBondAction SolidemBeam::act_apart(double* memory, const SolidemBondEnds& ends,
                                         double step) const {
  SolidemBondAction action;
  if (Row::is_gone(memory)) return action;
  if (made_anew(memory, step)) {
    action.load.force = (-memory[Row::FLOW] / solidem::norm(ends.chord)) * ends.chord;
    return action;
  }
  action.fracture_energy = lost_by_last_act(memory, ends, step);
  const double far = REACH_OF_CONTACT * (ends.radius_i + ends.radius_j);
  if (contact_ratio == 0.0 || Row::is_cut(memory) || solidem::norm(ends.chord) > far) {
    memory[Row::RUPTURE] = Row::GONE;
    return action;
  }
  const Contact push = contact(memory, ends);
  action.load.force = push.force;
  const double thickness = beam_radius(ends);
  const double strength = solidem::norm(push.force);
  action.forms =
      strength > rebonding_pressure * M_PI * thickness * thickness &&
      solidem::may_be_bonded_anew(solidem::norm(ends.chord), ends.radius_i + ends.radius_j);
  if (action.forms) {
    memory[Row::FLOW] = strength;
    make(memory, ends);
    memory[Row::RUPTURE] = -(step + 2.0);
    action.fracture_energy += push.energy;
  } else {
    action.contact_energy = push.energy;
  }
  return action;
}

SolidemBondFigures SolidemBeam::figures(const double* memory, const SolidemBondEnds& ends,
                                        double step) const {
  const double length = solidem::norm(ends.chord);
  if (made_anew(memory, step)) return {length, -memory[Row::FLOW], 0.0, 0.0, 0.0};
  if (!acts_as_beam(memory, step)) {
    if (Row::is_gone(memory)) return {length, 0.0, 0.0, 0.0, 0.0};
    const Contact push = contact(memory, ends);
    return {length, -solidem::norm(push.force), 0.0, 0.0, push.energy};
  }
  const YieldingBeam<double> bond = beam(memory, ends);
  const State now = state(memory, ends, bond.rest_length);
  const Deformation& deformation = now.deformation;
  const double stiffness = warmth.stiffness(ends.temperature_i, ends.temperature_j);
  const double stress = stiffness * young_modulus *
                        solidem::equivalent_strain(bond.yield_section, bond, now.pose, deformation);
  const double force =
      bond.rigidity.axial * deformation.inverse_rest_length * deformation.extension;
  if (may_break() && Row::is_cut(memory)) return {length, force, stress, 0.0, 0.0};
  if (may_break() && memory[Row::RUPTURE] != 0.0)
    return {length, force, stress, 0.0, contact(memory, ends).energy};
  return {length, force, stress, solidem::beam_energy(bond.rigidity, now.pose, deformation), 0.0};
}

// A bond that breaks in this pose is not damped any more, one that is made in it not yet.
bool SolidemBeam::damps(const double* memory) const {
  return damping_ratio > 0.0 && (!may_break() || memory[Row::RUPTURE] == 0.0);
}

solidem::DashpotAction<double> SolidemBeam::damp(
    const double* memory, const SolidemBondEnds& ends, const solidem::BondMotion<double>& motion,
    const solidem::BondInertia<double>& inertia) const {
  const YieldingBeam<double> bond = beam(memory, ends);
  return solidem::bond_damping(
      solidem::bond_dashpots(damping_ratio, bond.rigidity, bond.rest_length, inertia), ends.chord,
      motion);
}

bool SolidemBeam::holds(double* memory, const SolidemBondEnds& ends, double step) const {
  if (!may_break() || Row::is_whole(memory) || acts_as_beam(memory, step)) return true;
  if (contact_ratio == 0.0 || Row::is_gone(memory) || Row::is_cut(memory)) return false;
  const bool acted_apart = step > memory[Row::RUPTURE];  // and told what it lost by its last act
  if (!acted_apart || solidem::norm(ends.chord) <= ends.radius_i + ends.radius_j) return true;
  memory[Row::RUPTURE] = Row::GONE;
  return false;
}

double SolidemBeam::cut(double* memory, const SolidemBondEnds& ends, double step) const {
  const SolidemBondFigures now = figures(memory, ends, step);
  const double energy = now.elastic_energy + now.contact_energy;
  const bool acts = acts_as_beam(memory, step);
  if (acts) {
    const bool broke = memory[Row::RUPTURE] != 0.0;
    const double rest_length = beam(memory, ends).rest_length;
    const State pose = state(memory, ends, rest_length);
    keep_last(memory, ends, solidem::beam_modes(pose.pose, pose.deformation, ends.orientation_i),
              rest_length, 0.0);
    // Of a bond that broke in this step, what its contact would have taken over.
    memory[Row::ENERGY] = (broke ? memory[Row::ENERGY] : 0.0) + energy;
  }
  memory[Row::RUPTURE] = acts ? step + 1.5 : Row::GONE;
  return energy;
}

}  // namespace LAMMPS_NS
