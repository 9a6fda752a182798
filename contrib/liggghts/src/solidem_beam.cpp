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

#include "laws/contact.hpp"

namespace LAMMPS_NS {

using solidem::BeamHistory;
using solidem::BeamLoad;
using solidem::BeamRigidity;
using solidem::Quaternion;
using solidem::YieldingBeam;
typedef solidem::Vector3<double> Vector;
typedef SolidemBondMemory Row;

namespace {

// Lips of a broken bond that are this many times the sum of their radii apart never touch again.
const double REACH_OF_CONTACT = 1.5;

Vector vector(const double* a) {
  return {a[0], a[1], a[2]};
}
void store(double* place, const Vector& a) {
  place[0] = a.x;
  place[1] = a.y;
  place[2] = a.z;
}

}  // namespace

int SolidemBeam::width() const {
  if (plasticity == SCALED_OFFSET) return Row::WITH_REST_DIRECTION;
  return may_change() ? Row::CHANGING : Row::ELASTIC;
}

double SolidemBeam::beam_radius(const SolidemBondEnds& ends) const {
  return radius > 0.0 ? radius : ratio * 0.5 * (ends.radius_i + ends.radius_j);
}

YieldingBeam<double> SolidemBeam::beam(const SolidemBondEnds& ends, double rest_length) const {
  const double thickness = beam_radius(ends);
  const solidem::BeamSection<double> section = {young_modulus, shear_modulus, thickness};
  switch (law) {
    case TIMOSHENKO:
      return {solidem::timoshenko_rigidity(section, rest_length, shear_coefficient), rest_length,
              thickness, shear_modulus / young_modulus, yield};
    case SPRING:  // bears no bending and no torsion: neither strains it
      return {solidem::spring_rigidity(section), rest_length, 0.0, 0.0, yield};
    default:
      return {solidem::euler_bernoulli_rigidity(section), rest_length, thickness,
              shear_modulus / young_modulus, yield};
  }
}

BeamHistory<double> SolidemBeam::history(const double* memory) const {
  const Vector normal_i = vector(memory + Row::NORMAL_I);
  if (!may_change()) return solidem::unyielded(normal_i);
  return {normal_i, vector(memory + Row::NORMAL_J), memory[Row::EXTENSION], memory[Row::TWIST],
          memory[Row::PLASTIC_STRAIN]};
}

SolidemBeam::Pose SolidemBeam::pose(const double* memory, const SolidemBondEnds& ends) const {
  const double* normal_j = memory + (may_change() ? Row::NORMAL_J : Row::NORMAL_I);
  return solidem::beam_pose(ends.chord, vector(memory + Row::NORMAL_I), vector(normal_j),
                            ends.orientation_i, ends.orientation_j);
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
  memory[Row::TWIST] = 2.0 * dot((ends.orientation_j * back_i).v, direction);
  if (plasticity == SCALED_OFFSET)
    store(memory + Row::REST_DIRECTION, solidem::rotate(back_i, direction));
}

SolidemBondAction SolidemBeam::act(double* memory, const SolidemBondEnds& ends, double step,
                                   bool energies) const {
  if (memory[Row::REST_LENGTH] == 0.0) make(memory, ends);
  if (!acts_as_beam(memory, step)) {
    if (!Row::is_whole(memory) || made_anew(memory, step)) return act_apart(memory, ends, step);
    memory[Row::RUPTURE] = memory[Row::FLOW] = 0.0;
  }

  const YieldingBeam<double> bond = beam(ends, memory[Row::REST_LENGTH]);
  Pose place = pose(memory, ends);
  Deformation deformation = solidem::elastic_deformation(bond.rest_length, place, history(memory));
  if (!may_change())
    return {solidem::beam_load(bond.rigidity, place, deformation),
            energies ? solidem::beam_energy(bond.rigidity, place, deformation) : 0.0};
  if (memory[Row::RUPTURE] != 0.0) {  // broke in this very pose
    SolidemBondAction action;
    action.load = solidem::beam_load(bond.rigidity, place, deformation);
    if (!Row::is_cut(memory)) action.contact_energy = contact(bond.rest_length, ends).energy;
    return action;
  }

  // Most bonds are far from any limit, which a bound without a root tells.
  const double plastic_strain = memory[Row::PLASTIC_STRAIN];
  const double yield_strain = yield.yield_strain + yield.hardening_ratio * plastic_strain;
  double limit = std::min(rupture.elastic_strain, std::max(rupture.strain - plastic_strain, 0.0));
  if (plasticity == RADIAL_RETURN) limit = std::min(limit, yield_strain);
  limit *= bond.rest_length;
  bool near = solidem::bound_of_squared_extension(bond.radius, bond.shear_ratio, place,
                                                  deformation) > limit * limit;
  if ((plasticity == SCALED_OFFSET || near) &&
      flow(memory, ends, bond, {place, deformation}, step)) {
    near = true;
    place = pose(memory, ends);
    deformation = solidem::elastic_deformation(bond.rest_length, place, history(memory));
  }
  SolidemBondAction action;
  action.load = solidem::beam_load(bond.rigidity, place, deformation);
  action.breaks = near && solidem::breaks(rupture,
                                          solidem::equivalent_strain(bond.radius, bond.shear_ratio,
                                                                     place, deformation),
                                          memory[Row::PLASTIC_STRAIN]);
  if (energies || action.breaks)
    action.elastic_energy = solidem::beam_energy(bond.rigidity, place, deformation);
  if (action.breaks) {
    memory[Row::RUPTURE] = step + 1.0;
    action.contact_energy = contact(memory[Row::REST_LENGTH], ends).energy;
    action.fracture_energy = action.elastic_energy - action.contact_energy;
    action.elastic_energy = 0.0;
  }
  return action;
}

/* ----------------------------------------------------------------------
   plastic flow, if any, once a step; the load that acts is that of the shape
   remembered afterwards, so that a second look at the pose finds the same
------------------------------------------------------------------------- */

bool SolidemBeam::flow(double* memory, const SolidemBondEnds& ends,
                       const YieldingBeam<double>& bond, const State& elastic, double step) const {
  if (plasticity == NONE || memory[Row::FLOW] == step + 1.0) return false;
  const double plastic_strain = memory[Row::PLASTIC_STRAIN];
  State from = elastic;
  if (plasticity == SCALED_OFFSET) {  // what counts is the deformation since the bond was made
    from.pose = solidem::beam_pose(ends.chord, vector(memory + Row::REST_DIRECTION),
                                   ends.orientation_i, ends.orientation_j);
    from.deformation = solidem::beam_deformation(bond.rest_length, from.pose);
  }
  const double strain =
      solidem::equivalent_strain(bond.radius, bond.shear_ratio, from.pose, from.deformation);
  const solidem::PlasticFlow<double> flow =
      plasticity == RADIAL_RETURN ? solidem::radial_return(yield, strain, plastic_strain)
                                  : solidem::scaled_offset(yield, strain, plastic_strain);
  if (!(flow.strain > plastic_strain)) return false;

  const double energy = solidem::beam_energy(bond.rigidity, elastic.pose, elastic.deformation);
  const solidem::BeamResponse<double> response =
      solidem::detail::flowed(bond, from.pose, from.deformation, flow, plastic_strain, energy,
                              ends.orientation_i, ends.orientation_j);
  store(memory + Row::NORMAL_I, response.history.normal_i);
  store(memory + Row::NORMAL_J, response.history.normal_j);
  memory[Row::EXTENSION] = response.history.extension;
  memory[Row::TWIST] = response.history.twist;
  memory[Row::PLASTIC_STRAIN] = response.history.strain;
  memory[Row::PLASTIC_WORK] += response.plastic_work;
  memory[Row::FLOW] = step + 1.0;
  return true;
}

// The push of two atoms whose bond broke, and the energy in it.
SolidemBeam::Contact SolidemBeam::contact(double rest_length, const SolidemBondEnds& ends) const {
  if (contact_ratio == 0.0) return {Vector{}, 0.0};
  const double stiffness = contact_ratio * beam(ends, rest_length).rigidity.axial / rest_length;
  const double distance = solidem::contact_distance(rest_length, ends.radius_i + ends.radius_j);
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
    action.load.force = contact(memory[Row::FLOW], ends).force;
    return action;
  }
  const double far = REACH_OF_CONTACT * (ends.radius_i + ends.radius_j);
  if (contact_ratio == 0.0 || Row::is_cut(memory) || solidem::norm(ends.chord) > far) {
    memory[Row::RUPTURE] = Row::GONE;
    return action;
  }
  const Contact push = contact(memory[Row::REST_LENGTH], ends);
  action.load.force = push.force;
  const double thickness = beam_radius(ends);
  action.forms = solidem::norm(push.force) > rebonding_pressure * M_PI * thickness * thickness;
  if (action.forms) {
    memory[Row::FLOW] = memory[Row::REST_LENGTH];
    make(memory, ends);
    memory[Row::RUPTURE] = -(step + 2.0);
    action.fracture_energy = push.energy;
  } else {
    action.contact_energy = push.energy;
  }
  return action;
}

SolidemBondFigures SolidemBeam::figures(const double* memory, const SolidemBondEnds& ends,
                                        double step) const {
  const double length = solidem::norm(ends.chord);
  if (made_anew(memory, step))
    return {length, -solidem::norm(contact(memory[Row::FLOW], ends).force), 0.0, 0.0, 0.0};
  if (!acts_as_beam(memory, step)) {
    if (Row::is_gone(memory)) return {length, 0.0, 0.0, 0.0, 0.0};
    const Contact push = contact(memory[Row::REST_LENGTH], ends);
    return {length, -solidem::norm(push.force), 0.0, 0.0, push.energy};
  }
  const YieldingBeam<double> bond = beam(ends, memory[Row::REST_LENGTH]);
  const Pose place = pose(memory, ends);
  const Deformation deformation =
      solidem::elastic_deformation(bond.rest_length, place, history(memory));
  const double stress =
      young_modulus * solidem::equivalent_strain(bond.radius, bond.shear_ratio, place, deformation);
  const double force =
      bond.rigidity.axial * deformation.inverse_rest_length * deformation.extension;
  if (may_break() && Row::is_cut(memory)) return {length, force, stress, 0.0, 0.0};
  if (may_break() && memory[Row::RUPTURE] != 0.0)
    return {length, force, stress, 0.0, contact(memory[Row::REST_LENGTH], ends).energy};
  return {length, force, stress, solidem::beam_energy(bond.rigidity, place, deformation), 0.0};
}

double SolidemBeam::cut(double* memory, const SolidemBondEnds& ends, double step) const {
  const SolidemBondFigures now = figures(memory, ends, step);
  memory[Row::RUPTURE] = acts_as_beam(memory, step) ? step + 1.5 : Row::GONE;
  return now.elastic_energy + now.contact_energy;
}

}  // namespace LAMMPS_NS
