// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/statics/bonded_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "effects/effect.hpp"
#include "model/error.hpp"
#include "solve/statics/held_body.hpp"
#include "solve/statics/stiffness_solver.hpp"

namespace solidem {

namespace {

using Index = Eigen::Index;

Vector vector_at(const Eigen::VectorXd& field, Index at) {
  return {field[at], field[at + 1], field[at + 2]};
}

void add_at(Eigen::VectorXd& field, Index at, const Vector& v) {
  field[at] += v.x;
  field[at + 1] += v.y;
  field[at + 2] += v.z;
}

std::string degree_name(int degree) {
  return std::string(degree < 3 ? "displacement along " : "turn about ") + "xyz"[degree % 3];
}

/// σ_e / E from the loads of a bond, with the radius and the moduli that its rigidity tells.
double strain_of_load(const BondState& bond, const BeamLoad<double>& load) {
  const Vector x = (1 / norm(bond.chord)) * bond.chord;
  const double stretch = std::abs(dot(load.force, x)) / bond.rigidity.axial;
  if (!(bond.rigidity.bending > 0)) return stretch;
  const double radius = std::sqrt(2 * bond.rigidity.bending / bond.rigidity.axial);
  const Vector difference = load.moment_i - load.moment_j;  // bends and twists
  const double twisting = dot(difference, x);
  // ½ |M_i − M_j| r / (E I) and M_x r / (E I_0), where 2 E I = E I_0 is the bending rigidity.
  const double bend = radius * norm(difference - twisting * x) / bond.rigidity.bending;
  const double slip = 0.5 * radius * twisting / bond.rigidity.bending;
  return std::sqrt((stretch + bend) * (stretch + bend) + 3 * slip * slip);
}

}  // namespace

BondedBody::BondedBody(const BeamNetwork& network) : network_(&network) {
  rest_.reserve(network.bonds.size());
  for (std::size_t b = 0; b < network.bonds.size(); ++b) {
    const Vector chord = rest_chord(*network.specimen, network.bonds[b]);
    const double rest_length = norm(chord);
    rest_.push_back({network.rigidity[b], rest_length, (1 / rest_length) * chord, chord, {}, {}});
    length_ += rest_length;
  }
  length_ = rest_.empty() ? 1.0 : length_ / static_cast<double>(rest_.size());
}

Vector BondedBody::image_shift(std::size_t bond, const Matrix3& gradient) const {
  const Specimen& specimen = *network_->specimen;
  if (!specimen.domain.is_periodic()) return {};
  const Pair& pair = network_->bonds[bond];
  const Vector shift = rest_[bond].chord - (specimen.position[static_cast<std::size_t>(pair.j)] -
                                            specimen.position[static_cast<std::size_t>(pair.i)]);
  return {dot(gradient[0], shift), dot(gradient[1], shift), dot(gradient[2], shift)};
}

Eigen::VectorXd BondedBody::sum(const std::vector<BeamLoad<double>>& loads) const {
  Eigen::VectorXd total = Eigen::VectorXd::Zero(static_cast<Index>(6 * elements()));
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const Index i = 6 * network_->bonds[b].i, j = 6 * network_->bonds[b].j;
    add_at(total, i, loads[b].force);
    add_at(total, i + 3, (1 / length_) * loads[b].moment_i);
    add_at(total, j, -loads[b].force);
    add_at(total, j + 3, (1 / length_) * loads[b].moment_j);
  }
  return total;
}

BodyPose BondedBody::rest_pose() const {
  BodyPose pose;
  pose.displacement.resize(elements());
  pose.orientation.resize(elements());
  return pose;
}

BodyPose BondedBody::pose_of(const Equilibrium& equilibrium) const {
  BodyPose pose = rest_pose();
  move(pose, field_of(equilibrium, length_));
  pose.gradient = equilibrium.periodic_gradient;
  return pose;
}

void BondedBody::move(BodyPose& pose, const Eigen::VectorXd& change) const {
  for (std::size_t e = 0; e < elements(); ++e) {
    pose.displacement[e] += vector_at(change, static_cast<Index>(6 * e));
    const Vector turn = (1 / length_) * vector_at(change, static_cast<Index>(6 * e + 3));
    const double angle = norm(turn);
    if (angle == 0) continue;
    Quaternion<double>& q = pose.orientation[e];
    q = Quaternion<double>{std::cos(0.5 * angle), (std::sin(0.5 * angle) / angle) * turn} * q;
    const double scale = 1 / std::sqrt(q.w * q.w + dot(q.v, q.v));
    q = {scale * q.w, scale * q.v};
  }
}

std::vector<BondState> BondedBody::bonds_at(const BodyPose& pose) const {
  std::vector<BondState> bonds = rest_;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const auto i = static_cast<std::size_t>(network_->bonds[b].i);
    const auto j = static_cast<std::size_t>(network_->bonds[b].j);
    bonds[b].chord += pose.displacement[j] - pose.displacement[i] + image_shift(b, pose.gradient);
    bonds[b].orientation_i = pose.orientation[i];
    bonds[b].orientation_j = pose.orientation[j];
  }
  return bonds;
}

BondMotion BondedBody::motion(std::size_t bond, const Eigen::VectorXd& change,
                              const Matrix3& gradient) const {
  const Index i = 6 * network_->bonds[bond].i, j = 6 * network_->bonds[bond].j;
  return {vector_at(change, j) - vector_at(change, i) + image_shift(bond, gradient),
          (1 / length_) * vector_at(change, i + 3), (1 / length_) * vector_at(change, j + 3)};
}

std::vector<BeamLoad<double>> BondedBody::loads(const std::vector<BondState>& bonds) const {
  std::vector<BeamLoad<double>> loads;
  loads.reserve(bonds.size());
  for (const BondState& bond : bonds) loads.push_back(bond.load());
  return loads;
}

std::vector<BeamLoad<double>> BondedBody::load_rates(const std::vector<BondState>& bonds,
                                                     const Eigen::VectorXd& change,
                                                     const Matrix3& gradient) const {
  std::vector<BeamLoad<double>> rates(bonds.size());
  for_blocks(bonds.size(), 1000, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b)
      rates[b] = load_rate(bonds[b], motion(b, change, gradient));
  });
  return rates;
}

double BondedBody::small_motion_energy(const Eigen::VectorXd& change, const Matrix3& gradient,
                                       const std::vector<BeamLoad<double>>& loads) const {
  double energy = 0;
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const BondMotion m = motion(b, change, gradient);
    energy += 0.5 * (dot(loads[b].force, m.chord) - dot(loads[b].moment_i, m.spin_i) -
                     dot(loads[b].moment_j, m.spin_j));
  }
  return energy;
}

BoundaryConditions boundary_conditions(const BondedBody& body,
                                       const std::vector<Constraint>& constraints,
                                       const std::vector<ElementLoad>& loads) {
  const auto size = static_cast<Index>(6 * body.elements());
  BoundaryConditions conditions;
  conditions.held.assign(6 * body.elements(), 0);
  conditions.value = conditions.load = Eigen::VectorXd::Zero(size);
  const auto insist_on_element = [&](std::int32_t element, const std::string& what) {
    if (element < 0 || static_cast<std::size_t>(element) >= body.elements())
      throw InputError(what + " of element " + std::to_string(element) +
                       ": there is none; expected 0 to " + std::to_string(body.elements() - 1));
  };
  for (const Constraint& constraint : constraints) {
    insist_on_element(constraint.element, "constraint");
    if (constraint.degree < 0 || constraint.degree > 5)
      throw InputError("constraint of degree " + std::to_string(constraint.degree) +
                       ": expected 0 to 2 (displacement) or 3 to 5 (turn)");
    const Index at = Index{6} * constraint.element + constraint.degree;
    const double value =
        constraint.degree < 3 ? constraint.value : constraint.value * body.length();
    char& held = conditions.held[static_cast<std::size_t>(at)];
    if (held != 0 && conditions.value[at] != value)
      throw InputError("element " + std::to_string(constraint.element) + ": its " +
                       degree_name(constraint.degree) + " is held at two values");
    held = 1;
    conditions.value[at] = value;
  }
  for (const ElementLoad& load : loads) {
    insist_on_element(load.element, "load");
    add_at(conditions.load, Index{6} * load.element, load.force);
    add_at(conditions.load, Index{6} * load.element + 3, (1 / body.length()) * load.moment);
  }
  const std::string free = free_rigid_motions(body.network(), conditions.held);
  if (!free.empty())
    throw InputError("the body is not held: " + free + "; hold it so that no rigid motion is left");
  return conditions;
}

void insist_on_resistance(const StiffnessSolver& solver, const BondedBody& body,
                          const Eigen::VectorXd& load) {
  const auto [unresisted, element] = solver.unresisted(load);
  if (!(unresisted > 1e-9 * load.cwiseAbs().maxCoeff())) return;
  const Vector& p = body.network().specimen->position[static_cast<std::size_t>(element)];
  char place[96];
  std::snprintf(place, sizeof place, "(%.6g, %.6g, %.6g) m", p.x, p.y, p.z);
  throw InputError("element " + std::to_string(element) + " at " + place +
                   " is loaded along a direction in which none of its bonds resists; "
                   "expected beams instead of springs, or no load there");
}

Balance balance(const BondedBody& body, const std::vector<BeamLoad<double>>& loads,
                const Eigen::VectorXd& out_of_balance, double extent) {
  double squares = 0, stiffness = 0;
  const double per_length = 1 / body.length();
  for (const BeamLoad<double>& load : loads) {
    const Vector m_i = per_length * load.moment_i, m_j = per_length * load.moment_j;
    squares += 2 * dot(load.force, load.force) + dot(m_i, m_i) + dot(m_j, m_j);
  }
  for (const BondState& bond : body.rest()) {
    const double per_rest_length = 1 / bond.rest_length;
    const double shear = 6 * bond.rigidity.shear * per_rest_length * per_rest_length;
    const double of_chord = (bond.rigidity.axial + shear) * extent * per_rest_length;
    stiffness += 2 * of_chord * of_chord;
  }
  const double scale = squares > 0 ? std::sqrt(squares) : 1;
  return {out_of_balance.norm() / scale,
          0.5 * std::numeric_limits<double>::epsilon() * std::sqrt(stiffness) / scale};
}

Eigen::VectorXd field_of(const Equilibrium& equilibrium, double length) {
  Eigen::VectorXd field =
      Eigen::VectorXd::Zero(static_cast<Index>(6 * equilibrium.displacement.size()));
  for (std::size_t e = 0; e < equilibrium.displacement.size(); ++e) {
    add_at(field, static_cast<Index>(6 * e), equilibrium.displacement[e]);
    add_at(field, static_cast<Index>(6 * e + 3), length * equilibrium.rotation[e]);
  }
  return field;
}

void set_motion(const Eigen::VectorXd& field, double length, Equilibrium& equilibrium) {
  const auto elements = static_cast<std::size_t>(field.size()) / 6;
  equilibrium.displacement.resize(elements);
  equilibrium.rotation.resize(elements);
  for (std::size_t e = 0; e < elements; ++e) {
    equilibrium.displacement[e] = vector_at(field, static_cast<Index>(6 * e));
    equilibrium.rotation[e] = (1 / length) * vector_at(field, static_cast<Index>(6 * e + 3));
  }
}

void set_motion(const BodyPose& pose, Equilibrium& equilibrium) {
  equilibrium.displacement = pose.displacement;
  equilibrium.rotation.clear();
  for (const Quaternion<double>& q : pose.orientation) {
    // q and −q are the same orientation: the shorter way round.
    const double sine = norm(q.v), side = q.w < 0 ? -1 : 1;
    const double angle = 2 * std::atan2(sine, std::abs(q.w));
    equilibrium.rotation.push_back(sine == 0 ? Vector{} : (side * angle / sine) * q.v);
  }
}

void set_loads(const BondedBody& body, const BoundaryConditions& conditions,
               const std::vector<BondState>& bonds, const std::vector<BeamLoad<double>>& loads,
               Equilibrium& equilibrium) {
  Eigen::VectorXd reaction = -(body.sum(loads) + conditions.load);
  for (Index k = 0; k < reaction.size(); ++k)
    if (conditions.held[static_cast<std::size_t>(k)] == 0) reaction[k] = 0;
  equilibrium.reaction.resize(body.elements());
  equilibrium.reaction_moment.resize(body.elements());
  for (std::size_t e = 0; e < body.elements(); ++e) {
    equilibrium.reaction[e] = vector_at(reaction, static_cast<Index>(6 * e));
    equilibrium.reaction_moment[e] =
        body.length() * vector_at(reaction, static_cast<Index>(6 * e + 3));
  }
  equilibrium.bond_force.clear();
  equilibrium.bond_strain.clear();
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    equilibrium.bond_force.push_back(loads[b].force);
    equilibrium.bond_strain.push_back(strain_of_load(bonds[b], loads[b]));
  }
}

}  // namespace solidem
