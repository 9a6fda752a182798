// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bodies under central forces for tests: laws of a usual size, a few elements by hand, and what can
// be said of them as a whole.
#ifndef SOLIDEM_TESTS_SUPPORT_CENTRAL_FORCES_HPP
#define SOLIDEM_TESTS_SUPPORT_CENTRAL_FORCES_HPP

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "effects/central_force_parameters.hpp"
#include "effects/central_forces.hpp"
#include "effects/damage.hpp"
#include "laws/central_interaction.hpp"
#include "model/error.hpp"
#include "support/beams.hpp"

namespace solidem {

using CentralEquilibrium = CentralForceParameters::Equilibrium;
using Neighbours = CentralForceParameters::Neighbours;

/// Parameters for elements of a tenth of a millimetre, for whatever law of the table it is.
template <class Law>
Law usual() {
  Law law;
  for (const auto& parameter : Law::parameters()) {
    const std::string name = parameter.name;
    switch (parameter.quantity) {
      case LawQuantity::energy:
        law.*parameter.place = name.rfind("beyond", 0) == 0 ? 2e-4 : 1e-3;
        break;
      case LawQuantity::force:
        law.*parameter.place = 25;
        break;
      case LawQuantity::stiffness:
        law.*parameter.place = 1.5e6;
        break;
      case LawQuantity::ratio:
        law.*parameter.place = name == "threshold_strain" ? 0.02 : 1.15;
        break;
      case LawQuantity::exponent:
        law.*parameter.place = name.find("repulsive") != std::string::npos ? 8 : 4;
        break;
    }
  }
  return law;
}

/// All laws of the table with such parameters.
inline std::vector<CentralLaw> usual_laws() {
  std::vector<CentralLaw> laws;
  CentralLaws::for_each([&](auto law) { laws.emplace_back(usual<decltype(law)>()); });
  return laws;
}

inline const char* name_of(const CentralLaw& law) {
  return std::visit([](const auto& which) { return which.name; }, law);
}

/// Aluminium under a central force; all within range at the start are initial pairs.
inline Setup central_setup(const CentralLaw& law = usual<Mie>(), double range = 1.5) {
  Setup setup;
  setup.materials.push_back(material_of(2790, 880, 134));
  CentralForceParameters forces;
  forces.law = law;
  forces.range = range;
  forces.bond_tolerance = range - 1;
  setup.get<CentralForceParameters>() = forces;
  setup.run.steps = 0;
  return setup;
}

/// The same among the pairs of the start only.
inline Setup fixed_setup(const CentralLaw& law = usual<Mie>(), double range = 1.5) {
  auto setup = central_setup(law, range);
  setup.get<CentralForceParameters>()->neighbours = Neighbours::fixed;
  return setup;
}

/// Elements on the places of a simple cubic lattice with a distance of `spacing` radii, moved by up
/// to `jitter` radii along each axis, the same way every time.
inline std::vector<Vector> lattice(std::array<int, 3> cells, double spacing = 2, double jitter = 0,
                                   const Vector& origin = {}) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-jitter, jitter);
  std::vector<Vector> places;
  for (int x = 0; x < cells[0]; ++x)
    for (int y = 0; y < cells[1]; ++y)
      for (int z = 0; z < cells[2]; ++z)
        places.push_back(origin + hand_radius * Vector{spacing * x + uniform(random),
                                                       spacing * y + uniform(random),
                                                       spacing * z + uniform(random)});
  return places;
}

/// Elements of one radius at places.
inline Specimen elements_at(const std::vector<Vector>& places, double radius = hand_radius) {
  Specimen specimen = string_of(places, radius);
  specimen.bonds.clear();
  return specimen;
}

inline Vector place_of(const Simulation& simulation, std::size_t element) {
  const double* place = simulation.model().positions()[element];
  return {place[0], place[1], place[2]};
}

/// Of the column: half a step behind the places.
inline Vector velocity_of(const Simulation& simulation, std::size_t element) {
  const double* column = simulation.model().data(columns::velocity);
  const std::size_t at = Model::at(columns::velocity, element);
  return {column[at], column[at + lanes], column[at + std::size_t{2} * lanes]};
}

/// Sets an element in motion, also as its neighbours feel it.
inline void launch(Simulation& simulation, std::size_t element, const Vector& velocity) {
  set_velocity(simulation, element, velocity);
  Model& model = simulation.model();
  if (!model.neighbours_feel_velocity()) return;
  for (int axis = 0; axis < 3; ++axis)
    model.felt_velocities()[element][axis] = component(velocity, axis);
}

/// Sets all elements in motion without any order, each up to a speed along each axis.
inline void shake(Simulation& simulation, double speed) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-speed, speed);
  for (std::size_t i = 0; i < simulation.model().elements(); ++i)
    launch(simulation, i, {uniform(random), uniform(random), uniform(random)});
}

/// Sum of the elements' momenta, as a part of the sum of their sizes, or of what it would be at a
/// speed; an element that was removed has none.
inline double net_momentum(const Simulation& simulation, double speed = 0) {
  Vector sum{};
  double size = 0;
  for (std::size_t i = 0; i < simulation.model().elements(); ++i) {
    const double inverse_mass = simulation.model().data(columns::inverse_mass)[i];
    if (!(inverse_mass > 0)) continue;
    const Vector momentum = (1 / inverse_mass) * velocity_of(simulation, i);
    sum += momentum;
    size += speed > 0 ? speed / inverse_mass : norm(momentum);
  }
  return size > 0 ? norm(sum) / size : 0;
}

/// Kinetic and potential energy now, J.
inline double energy_of(const Simulation& simulation) {
  return seen(simulation, "kinetic_energy") + seen(simulation, "potential_energy");
}

}  // namespace solidem

#endif
