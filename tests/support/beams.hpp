// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bonded bodies for tests: a few elements by hand, what makes them flow, break and touch, and what
// can be said of them as a whole.
#ifndef SOLIDEM_TESTS_SUPPORT_BEAMS_HPP
#define SOLIDEM_TESTS_SUPPORT_BEAMS_HPP

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "support/specimens.hpp"

namespace solidem {

using BeamLaw = BeamParameters::Law;
using FlowLaw = PlasticityParameters::Law;

/// Radius of the elements of bodies made by hand, m.
inline constexpr double hand_radius = 1e-4;

/// Elements at places, each bonded to the next.
inline Specimen string_of(const std::vector<Vector>& places, double radius = hand_radius) {
  Specimen specimen;
  specimen.position = places;
  specimen.radius.assign(places.size(), radius);
  specimen.domain.lower = specimen.domain.upper = places.front();
  for (const Vector& p : places)
    for (int axis = 0; axis < 3; ++axis) {
      double& low = component(specimen.domain.lower, axis);
      double& high = component(specimen.domain.upper, axis);
      low = std::min(low, component(p, axis) - radius);
      high = std::max(high, component(p, axis) + radius);
    }
  specimen.domain.volume = 8 * radius * radius * radius * static_cast<double>(places.size());
  for (std::size_t i = 1; i < places.size(); ++i)
    specimen.bonds.push_back({static_cast<std::int32_t>(i - 1), static_cast<std::int32_t>(i)});
  return specimen;
}

/// Elements in a row along x, `distance` radii apart.
inline Specimen row_of(int elements, double distance = 2) {
  std::vector<Vector> places;
  for (int i = 0; i < elements; ++i) places.push_back({i * distance * hand_radius, 0, 0});
  return string_of(places);
}

/// A random bar along x, three times as long as thick.
inline Specimen random_bar(int elements, int seed = 1) {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {3e-3, 1e-3, 1e-3};
  recipe.elements = elements;
  recipe.seed = static_cast<std::uint64_t>(seed);
  return make_specimen(recipe);
}

/// Aluminium by beams of a law.
inline Setup beam_setup(BeamLaw law = BeamLaw::euler_bernoulli) {
  auto setup = elastic_setup();
  setup.get<BeamParameters>()->law = law;
  return setup;
}

/// The same, which also flows.
inline Setup yielding_setup(double yield_strain = 2e-3, double hardening_ratio = 0.01,
                            FlowLaw flow = FlowLaw::radial_return,
                            BeamLaw law = BeamLaw::euler_bernoulli) {
  auto setup = beam_setup(law);
  setup.get<PlasticityParameters>() =
      PlasticityParameters{flow, LinearHardening{yield_strain, hardening_ratio}};
  return setup;
}

/// Bonds that break at a strain, elastic and plastic together.
inline RuptureParameters breaking_at_strain(double strain, int minimal_bonds = 0) {
  StrainLimit law;
  law.strain = strain;
  return {law, minimal_bonds};
}

/// Bonds that break at an equivalent stress over E.
inline RuptureParameters breaking_at_elastic_strain(double elastic_strain) {
  StrainLimit law;
  law.elastic_strain = elastic_strain;
  return {law};
}

/// The elements of a box that is open along y and z.
inline Region between(double low, double high) {
  Region region;
  region.kind = Region::Kind::box;
  const double far = 1;
  region.lower = {low, -far, -far};
  region.upper = {high, far, far};
  return region;
}

/// A grip that imposes a displacement along every axis, rotation held.
inline GripParameters hold(const std::string& name, const Region& region,
                           const std::array<TimeFunction, 3>& displacement) {
  GripParameters grip;
  grip.name = name;
  grip.region = region;
  for (std::size_t axis = 0; axis < 3; ++axis)
    grip.axis[axis] = {AxisControl::Kind::displacement, displacement[axis]};
  return grip;
}

inline GripParameters hold(const std::string& name, const Region& region) {
  const TimeFunction still = TimeFunction::constant(0);
  return hold(name, region, {still, still, still});
}

/// A grip that moves at a speed along x and holds everything else.
inline GripParameters pull(const std::string& name, const Region& region, double speed) {
  GripParameters grip = hold(name, region);
  grip.axis[0] = {AxisControl::Kind::velocity, TimeFunction::constant(speed)};
  return grip;
}

inline void set_velocity(Simulation& simulation, std::size_t element, const Vector& velocity) {
  double* column = simulation.model().data(columns::velocity);
  for (int axis = 0; axis < 3; ++axis)
    column[Model::at(columns::velocity, element, axis)] = component(velocity, axis);
}

inline void set_spin(Simulation& simulation, std::size_t element, const Vector& spin) {
  double* column = simulation.model().data(columns::angular_velocity);
  for (int axis = 0; axis < 3; ++axis)
    column[Model::at(columns::angular_velocity, element, axis)] = component(spin, axis);
}

inline Vector centre_of(const Simulation& simulation, std::size_t element) {
  const double* row = simulation.model().data(columns::pose) + 8 * element;
  return {row[0], row[1], row[2]};
}

/// A figure of the history now.
inline double seen(const Simulation& simulation, const std::string& name) {
  return value_of(simulation.observe(), name);
}

/// Momentum and angular momentum about the origin, and what they are small against.
struct Momenta {
  Vector linear{}, angular{};
  double linear_scale = 0, angular_scale = 0;
};

inline Momenta momenta_of(const Simulation& simulation) {
  Observation seen;
  simulation.observe(seen);
  const Model& model = simulation.model();
  Momenta sum;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const double m = 1 / model.data(columns::inverse_mass)[i];
    const double J = 1 / model.data(columns::inverse_inertia)[i];
    const Vector p = m * seen.motion.velocity[i];
    const Vector s = J * seen.motion.angular_velocity[i];
    sum.linear += p;
    sum.angular += cross(centre_of(simulation, i), p) + s;
    sum.linear_scale += norm(p);
    sum.angular_scale += norm(centre_of(simulation, i)) * norm(p) + norm(s);
  }
  return sum;
}

/// Loads of all bonds and contacts, which must balance: the largest imbalance of forces and of
/// moments about the origin, each as part of the sum of their sizes.
inline double imbalance_of_loads(const Simulation& simulation) {
  Observation seen;
  simulation.observe(seen);
  Vector force{}, moment{};
  double forces = 0, moments = 0;
  for (std::size_t i = 0; i < simulation.model().elements(); ++i) {
    const Vector& f = seen.motion.force[i];
    const Vector lever = centre_of(simulation, i);
    force += f;
    moment += seen.motion.moment[i] + cross(lever, f);
    forces += norm(f);
    moments += norm(seen.motion.moment[i]) + norm(lever) * norm(f);
  }
  const double of_forces = forces > 0 ? norm(force) / forces : 0;
  const double of_moments = moments > 0 ? norm(moment) / moments : 0;
  return std::max(of_forces, of_moments);
}

/// Pieces that the bonds left hold together, largest first; sizes in elements.
inline std::vector<std::size_t> pieces_of(const Simulation& simulation) {
  std::vector<std::size_t> piece(simulation.model().elements());
  for (std::size_t i = 0; i < piece.size(); ++i) piece[i] = i;
  const auto root = [&](std::size_t i) {
    while (piece[i] != i) i = piece[i];
    return i;
  };
  for (const Pair& bond : simulation.model().slots().pairs()) {
    const std::size_t a = root(static_cast<std::size_t>(bond.i));
    const std::size_t b = root(static_cast<std::size_t>(bond.j));
    piece[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::size_t> size(piece.size(), 0);
  for (std::size_t i = 0; i < piece.size(); ++i) ++size[root(i)];
  std::sort(size.rbegin(), size.rend());
  while (!size.empty() && size.back() == 0) size.pop_back();
  return size;
}

}  // namespace solidem

#endif
