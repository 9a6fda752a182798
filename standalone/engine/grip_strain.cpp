// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grip_strain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/grips.hpp"
#include "effects/initial_velocities.hpp"
#include "laws/bond_limit.hpp"
#include "laws/central_interaction.hpp"

namespace solidem {

namespace {

constexpr int looks = 1000;      // at the grips, from the start to the end of a run
constexpr double least = 1e-12;  // strains below it are none

Vector middle_of(const Grip& grip, const Specimen& specimen) {
  Vector sum{};
  for (const std::int32_t e : grip.elements())
    sum += specimen.position[static_cast<std::size_t>(e)];
  return (1 / static_cast<double>(grip.elements().size())) * sum;
}

/// Two grips, and how their distance changes along the axes on which both say where they are.
struct GripPair {
  const Grip *first, *second;
  std::string first_name, second_name;
  Vector middle, direction;
  double distance;  ///< m

  Vector gradient(double time) const {
    Vector opened{};
    for (int axis = 0; axis < 3; ++axis)
      if (first->imposed(axis) && second->imposed(axis))
        component(opened, axis) =
            second->imposed_displacement(axis, time) - first->imposed_displacement(axis, time);
    return (1 / distance) * opened;
  }
};

std::vector<GripPair> pairs_of_grips(const Simulation& simulation) {
  const Specimen& specimen = simulation.model().specimen();
  std::vector<const Grip*> grips;
  for (const auto& effect : simulation.effects())
    if (const auto* grip = dynamic_cast<const Grip*>(effect.get())) grips.push_back(grip);
  const auto& parameters = simulation.setup().all<GripParameters>();
  std::vector<GripPair> pairs;
  for (std::size_t a = 0; a < grips.size(); ++a)
    for (std::size_t b = a + 1; b < grips.size(); ++b) {
      const Vector from = middle_of(*grips[a], specimen), to = middle_of(*grips[b], specimen);
      const double distance = norm(to - from);
      if (!(distance > 0)) continue;
      pairs.push_back({grips[a], grips[b], parameters[a].name, parameters[b].name,
                       0.5 * (from + to), (1 / distance) * (to - from), distance});
    }
  return pairs;
}

double stretch_of(const GripPair& pair, const Vector& gradient) {
  return dot(gradient, pair.direction);
}

/// Of the stretch, or of half the shear where that is more.
double size_of(const GripPair& pair, const Vector& gradient) {
  const double stretch = stretch_of(pair, gradient);
  return std::max(std::abs(stretch), 0.5 * norm(gradient - stretch * pair.direction));
}

NominalStrain largest_strain(const std::vector<GripPair>& pairs, double duration) {
  NominalStrain largest;
  for (const GripPair& pair : pairs)
    for (int look = 1; look <= looks; ++look) {
      const double time = duration * look / looks;
      const Vector gradient = pair.gradient(time);
      const double size = size_of(pair, gradient);
      if (!(size > std::max(largest.size, least))) continue;
      largest = {size,
                 time,
                 stretch_of(pair, gradient) < -0.5 * size,
                 pair.first_name,
                 pair.second_name,
                 pair.middle,
                 pair.direction,
                 gradient};
    }
  return largest;
}

/// Strain of the bond that an even strain of the body stretches most, over that strain. In a
/// crystal no bond need lie along it.
double alignment_of(const Model& model, const NominalStrain& strain) {
  double most = 0;
  for (const Pair& pair : model.slots().pairs()) {
    const Vector chord = rest_chord(model.specimen(), pair);
    most = std::max(most, std::abs(dot(chord, strain.direction) * dot(chord, strain.gradient)) /
                              dot(chord, chord));
  }
  return most > 0 ? most / strain.size : 1;
}

/// Share of a run during which a strain is beyond a limit.
double share_beyond(const std::vector<GripPair>& pairs, double duration, double limit) {
  int beyond = 0;
  for (int look = 1; look <= looks; ++look)
    if (std::any_of(pairs.begin(), pairs.end(), [&](const GripPair& pair) {
          return size_of(pair, pair.gradient(duration * look / looks)) > limit;
        }))
      ++beyond;
  return static_cast<double>(beyond) / looks;
}

double first_yield(const YieldLaw& hardening) {
  return std::visit(
      [](const auto& law) {
        return YieldCurve<std::decay_t<decltype(law)>, double>{law}.limit(0.0);
      },
      hardening);
}

/// The state of a bond that is pulled to a strain and, where it yields, flows on the way.
BondStrain<double> pulled(const std::optional<PlasticityParameters>& plasticity, double strain,
                          bool is_pressure) {
  double elastic = strain;
  if (plasticity && strain > first_yield(plasticity->hardening))
    elastic = std::visit(
        [&](const auto& law) {
          const YieldCurve<std::decay_t<decltype(law)>, double> curve{law};
          return returned_strain(curve, strain, 0.0);
        },
        plasticity->hardening);
  return {elastic, strain - elastic, is_pressure ? -elastic : elastic, 0, 0};
}

PairLimits limits_of_beams(const Setup& setup, bool is_pressure) {
  PairLimits limits;
  const auto& plasticity = setup.get<PlasticityParameters>();
  if (plasticity) limits.yield = first_yield(plasticity->hardening);
  const auto& rupture = setup.get<RuptureParameters>();
  if (!rupture) return limits;
  double low = 0, high = 10;  // no body is pulled to ten times its length
  const auto breaks_at = [&](double strain) {
    return breaks(rupture->law, pulled(plasticity, strain, is_pressure));
  };
  if (!breaks_at(high)) return limits;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (breaks_at(middle) ? high : low) = middle;
  }
  limits.rupture = high;
  return limits;
}

/// Where attraction stops growing as two elements part, and where they no longer see each other.
PairLimits limits_of_central_forces(const CentralForceParameters& forces, double radius,
                                    bool is_pressure) {
  if (is_pressure) return {};
  const double equilibrium = 2 * radius;
  PairLimits limits{unlimited, forces.range - 1};
  double strongest = 0;
  for (int look = 1; look < looks; ++look) {
    const double strain = limits.rupture * look / looks;
    const double pull = -std::visit(
        [&](const auto& law) {
          return central_force(law, forces.interpenetration, (1 + strain) * equilibrium,
                               equilibrium)
              .force;
        },
        forces.law);
    if (pull <= strongest * (1 + 1e-9)) continue;
    strongest = pull;
    limits.yield = strain;
  }
  return limits;
}

PairLimits limits_of(const Simulation& simulation, bool is_pressure) {
  const Setup& setup = simulation.setup();
  if (const auto& forces = setup.get<CentralForceParameters>())
    return limits_of_central_forces(*forces, mean_radius(simulation.model().specimen()),
                                    is_pressure);
  return limits_of_beams(setup, is_pressure);
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}

/// Whether something happens at a limit: strain never spreads quite evenly.
std::string verdict(double strain, double limit, const char* what) {
  constexpr double concentrated = 3;
  if (strain >= limit) return fmt::format("it will {}", what);
  if (concentrated * strain >= limit)
    return fmt::format("it may {} where strain concentrates", what);
  return fmt::format("it will not {}", what);
}

std::string saying_of(const StrainForecast& forecast, bool has_beams) {
  const NominalStrain& strain = forecast.strain;
  const PairLimits& limits = forecast.limits;
  const double of_bonds = forecast.alignment * strain.size;
  std::string saying =
      fmt::format("the grips {} and {} strain the body by up to {}, its {} by {}", strain.first,
                  strain.second, percent(strain.size) + (strain.is_pressure ? " of pressure" : ""),
                  has_beams ? "bonds" : "pairs", percent(of_bonds));
  if (limits.yield < unlimited)
    saying += has_beams ? fmt::format("; bonds yield at {}: {}", percent(limits.yield),
                                      verdict(of_bonds, limits.yield, "flow"))
                        : fmt::format("; attraction is largest at {}: {}", percent(limits.yield),
                                      verdict(of_bonds, limits.yield, "give way"));
  if (limits.rupture < unlimited)
    saying +=
        fmt::format("; {} at {}: {}", has_beams ? "bonds break" : "neighbours lose each other",
                    percent(limits.rupture), verdict(of_bonds, limits.rupture, "break"));
  if (!(limits.yield < unlimited) && !(limits.rupture < unlimited))
    saying += has_beams ? "; bonds neither yield nor break: it stays elastic"
                        : "; nothing breaks under pressure";
  return saying;
}

/// What loads the body and is not counted.
std::vector<std::string> loads_left_out(const Setup& setup) {
  std::vector<std::string> left_out;
  for (const GripParameters& grip : setup.all<GripParameters>())
    if (std::any_of(grip.axis.begin(), grip.axis.end(),
                    [](const AxisControl& axis) { return axis.kind == AxisControl::Kind::force; }))
      left_out.push_back(fmt::format("the force of the grip {}", grip.name));
  if (!setup.all<InitialVelocity>().empty()) left_out.emplace_back("the initial velocities");
  return left_out;
}

}  // namespace

StrainForecast foretell_strain(const Simulation& simulation, double duration) {
  StrainForecast forecast;
  const Setup& setup = simulation.setup();
  const bool has_beams = setup.get<BeamParameters>().has_value();
  if (!has_beams && !setup.get<CentralForceParameters>()) return forecast;
  const std::vector<GripPair> pairs = pairs_of_grips(simulation);
  forecast.strain = largest_strain(pairs, duration);
  forecast.limits = limits_of(simulation, forecast.strain.is_pressure);
  if (forecast.strain.size > 0) {
    forecast.alignment = alignment_of(simulation.model(), forecast.strain);
    if (has_beams && forecast.limits.yield < unlimited)
      forecast.flowing_share =
          share_beyond(pairs, duration, forecast.limits.yield / forecast.alignment);
    forecast.sayings.push_back(saying_of(forecast, has_beams));
  } else {
    forecast.sayings.emplace_back("no two grips strain the body");
  }
  if (const std::vector<std::string> left_out = loads_left_out(setup); !left_out.empty())
    forecast.sayings.push_back(fmt::format(
        "what strains it besides is not foretold: {} (`solidem solve` finds bodies at rest)",
        fmt::join(left_out, ", ")));
  return forecast;
}

}  // namespace solidem
