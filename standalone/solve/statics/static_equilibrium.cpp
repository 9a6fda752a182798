// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/statics/static_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "effects/beam_parameters.hpp"
#include "effects/beam_properties.hpp"
#include "effects/gauge_check.hpp"
#include "model/displacement_gradient.hpp"
#include "model/error.hpp"
#include "solve/statics/bonded_body.hpp"
#include "solve/statics/stiffness_solver.hpp"
#include "specimen/bonds.hpp"

namespace solidem {

BeamNetwork beam_network(const BeamParameters& parameters, const Specimen& specimen) {
  BeamNetwork network;
  network.specimen = &specimen;
  std::vector<char> inside(specimen.size(), 0);
  for (const std::int32_t e : largest_component(specimen)) inside[static_cast<std::size_t>(e)] = 1;
  const BeamProperties properties(parameters, specimen);
  for (const Pair& pair : specimen.bonds) {
    if (inside[static_cast<std::size_t>(pair.i)] == 0) continue;
    network.bonds.push_back(pair);
    network.rigidity.push_back(
        properties.rigidity(properties.section(specimen, pair), norm(rest_chord(specimen, pair))));
  }
  return network;
}

namespace {

/// Loads of bonds at rest whose thermal strain is held back: pressure.
void add_thermal_loads(const BondedBody& body, std::vector<BeamLoad<double>>& loads) {
  const std::vector<double>& strain = body.network().thermal_strain;
  for (std::size_t b = 0; b < strain.size(); ++b) {
    const BondState& rest = body.rest()[b];
    loads[b].force += -(rest.rigidity.axial * strain[b]) * rest.rest_direction;
  }
}

/// Half of what the loads would do on the way to a thermal strain, J.
double thermal_energy_part(const BondedBody& body, const std::vector<BeamLoad<double>>& loads) {
  const std::vector<double>& strain = body.network().thermal_strain;
  double energy = 0;
  for (std::size_t b = 0; b < strain.size(); ++b) {
    const BondState& rest = body.rest()[b];
    energy += 0.5 * strain[b] * rest.rest_length * dot(loads[b].force, rest.rest_direction);
  }
  return energy;
}

}  // namespace

Equilibrium small_equilibrium(const BeamNetwork& network,
                              const std::vector<Constraint>& constraints,
                              const std::vector<ElementLoad>& loads,
                              const EquilibriumOptions& options) {
  const BondedBody body(network);
  const BoundaryConditions conditions = boundary_conditions(body, constraints, loads);
  StiffnessSolver solver(*network.specimen, network.bonds, conditions.held, body.length(),
                         options.method);
  solver.assemble([&](std::size_t b) { return tangent(body.rest()[b]); });
  insist_on_resistance(solver, body, conditions.load);

  // Everything starts from the values that are imposed, or from the guess. What the bonds leave out
  // of balance is taken from their law itself, so that solving again mends the round-off of the
  // first time.
  Eigen::VectorXd field = conditions.value;
  if (options.guess != nullptr) {
    field = field_of(*options.guess, body.length());
    for (Eigen::Index k = 0; k < field.size(); ++k)
      if (!solver.is_free(static_cast<std::size_t>(k))) field[k] = conditions.value[k];
  }
  Equilibrium result;
  result.periodic_gradient = options.periodic_gradient;
  std::vector<BeamLoad<double>> bond_loads;
  double last = 0, allowed = 0;
  for (int round = 0;; ++round) {
    bond_loads = body.load_rates(body.rest(), field, options.periodic_gradient);
    add_thermal_loads(body, bond_loads);
    Eigen::VectorXd force = body.sum(bond_loads) + conditions.load;
    for (Eigen::Index k = 0; k < force.size(); ++k)
      if (!solver.is_free(static_cast<std::size_t>(k))) force[k] = 0;
    const Balance now = balance(body, bond_loads, force, 4 * field.cwiseAbs().maxCoeff());
    result.residual = now.residual;
    allowed = options.tolerance + now.round_off;
    if (round > 0 && result.residual <= allowed) break;
    if (round > 1 && result.residual > 0.5 * last) break;  // as far as round-off lets it come
    if (round == 8) break;
    last = result.residual;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(force.size());
    const double goal = round == 0 ? options.tolerance : 0.5 * options.tolerance / result.residual;
    const auto solved = solver.solve(force, change, goal);
    if (!solved.positive)
      throw RunError(
          "no static equilibrium: the body can move without its bonds resisting, though it is held "
          "against rigid motion; expected more bonds, or beams instead of springs");
    result.iterations = solver.is_factorised() ? 1 : result.iterations + solved.iterations;
    field += change;
  }
  if (!(result.residual <= std::max(1e-6, allowed)))
    throw RunError("no static equilibrium: forces out of balance remain at " +
                   std::to_string(result.residual) + " of the bonds' forces after " +
                   std::to_string(result.iterations) + " iterations");
  set_motion(field, body.length(), result);
  set_loads(body, conditions, body.rest(), bond_loads, result);
  result.energy = body.small_motion_energy(field, options.periodic_gradient, bond_loads) -
                  thermal_energy_part(body, bond_loads);
  return result;
}

GaugeMeasure measure_gauge(const BeamNetwork& network, const Equilibrium& equilibrium,
                           const Gauge& gauge) {
  const Specimen& specimen = *network.specimen;
  check_gauge(gauge, specimen.domain);
  const auto place = [&](std::int32_t e, int axis) {
    return component(specimen.position[static_cast<std::size_t>(e)], axis);
  };
  std::vector<char> bonded(specimen.size(), 0);
  double tension = 0;  // force times length along the axis
  for (std::size_t b = 0; b < network.bonds.size(); ++b) {
    const Pair pair = network.bonds[b];
    bonded[static_cast<std::size_t>(pair.i)] = bonded[static_cast<std::size_t>(pair.j)] = 1;
    const double from = place(pair.i, gauge.axis);
    const double along = component(rest_chord(specimen, pair), gauge.axis);
    const double pull = component(equilibrium.bond_force[b], gauge.axis);
    tension += (along > 0 ? pull : -pull) * length_inside(gauge, specimen.domain, from, along);
  }
  std::vector<std::int32_t> elements;
  for (std::size_t e = 0; e < specimen.size(); ++e) {
    const auto element = static_cast<std::int32_t>(e);
    const double along = place(element, gauge.axis);
    if (bonded[e] != 0 && gauge.lower <= along && along <= gauge.upper) elements.push_back(element);
  }
  if (elements.size() < 10)
    throw InputError("[gauge] holds " + std::to_string(elements.size()) +
                     " elements; widen lower … upper until it holds 10 or more");
  const std::vector<Vector> weights = gradient_weights(specimen, elements);
  const auto strain = [&](int axis) {
    double sum = 0;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const auto e = static_cast<std::size_t>(elements[k]);
      sum += component(weights[k], axis) * component(equilibrium.displacement[e], axis);
    }
    return sum;
  };
  const double stress =
      tension / (gauge.upper - gauge.lower) / specimen.domain.cross_section(gauge.axis);
  return {stress, strain(gauge.axis), {strain((gauge.axis + 1) % 3), strain((gauge.axis + 2) % 3)}};
}

std::vector<SymmetricTensor<double>> element_stress(const BeamNetwork& network,
                                                    const Equilibrium& equilibrium,
                                                    const std::vector<double>& volume) {
  std::vector<SymmetricTensor<double>> stress(volume.size());
  for (std::size_t b = 0; b < network.bonds.size(); ++b) {
    const Pair pair = network.bonds[b];
    const auto of_pair =
        virial_of_pair(equilibrium.bond_force[b], rest_chord(*network.specimen, pair));
    for (const std::int32_t end : {pair.i, pair.j}) {
      const auto e = static_cast<std::size_t>(end);
      stress[e] += of_pair / volume[e];
    }
  }
  return stress;
}

Matrix3 mean_stress(const BeamNetwork& network, const Equilibrium& equilibrium) {
  Matrix3 stress{};
  for (std::size_t b = 0; b < network.bonds.size(); ++b) {
    const Vector chord = rest_chord(*network.specimen, network.bonds[b]);
    for (int row = 0; row < 3; ++row)
      stress[static_cast<std::size_t>(row)] +=
          (component(equilibrium.bond_force[b], row) / network.specimen->domain.volume) * chord;
  }
  return stress;
}

}  // namespace solidem
