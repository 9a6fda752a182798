// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/calibration/tensile_bar.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "effects/beam_parameters.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

constexpr double pull = 1e-3;  // mean strain; small motion is linear, so that any will do

std::string text_of(double length) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g m", length);
  return buffer;
}

double along(const Specimen& specimen, std::int32_t element, int axis) {
  return component(specimen.position[static_cast<std::size_t>(element)], axis);
}

/// The elements that hang together, ascending.
std::vector<std::int32_t> elements_of(const BeamNetwork& network) {
  std::vector<std::int32_t> elements;
  for (const Pair& pair : network.bonds) elements.insert(elements.end(), {pair.i, pair.j});
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

/// Both ends moved along the axis. Two elements of the low end also keep the body from drifting
/// and turning about the axis: nothing pushes it that way, so they bear no force.
std::vector<Constraint> pulled_ends(const BeamNetwork& network, const TensileBar& bar) {
  const Specimen& specimen = *network.specimen;
  const int axis = bar.gauge.axis, next = (axis + 1) % 3, last = (axis + 2) % 3;
  const double low = component(specimen.domain.lower, axis) + bar.grip_depth;
  const double high = component(specimen.domain.upper, axis) - bar.grip_depth;
  std::vector<Constraint> constraints;
  std::vector<std::int32_t> low_end;
  bool high_end_is_held = false;
  for (const std::int32_t element : elements_of(network)) {
    const double place = along(specimen, element, axis);
    if (place <= low) {
      constraints.push_back({element, axis, 0});
      low_end.push_back(element);
    } else if (place >= high) {
      constraints.push_back({element, axis, pull * (high - low)});
      high_end_is_held = true;
    }
  }
  if (low_end.size() < 3 || !high_end_is_held)
    throw RunError(
        "the bar has no ends to pull at: no body of bonded elements reaches from one end to the "
        "other; expected a packing of several layers, or a larger [bonds] tolerance");
  const auto [first, second] =
      std::minmax_element(low_end.begin(), low_end.end(), [&](std::int32_t a, std::int32_t b) {
        return along(specimen, a, next) < along(specimen, b, next);
      });
  constraints.push_back({*first, next, 0});
  constraints.push_back({*first, last, 0});
  constraints.push_back({*second, last, 0});
  return constraints;
}

/// Takes the turn of the whole body about the axis out of its displacements. It is arbitrary, and
/// the lines fitted through displacements across the bar would not be blind to it. A bar in motion
/// has none either: nothing gives it an angular momentum about the axis.
void take_out_turn(Equilibrium& equilibrium, const BeamNetwork& network, int axis) {
  const Specimen& specimen = *network.specimen;
  const std::vector<std::int32_t> elements = elements_of(network);
  Vector middle{};
  for (const std::int32_t e : elements) middle += specimen.position[static_cast<std::size_t>(e)];
  middle = (1.0 / static_cast<double>(elements.size())) * middle;
  Vector direction{};
  component(direction, axis) = 1;
  double swept = 0, squares = 0;
  for (const std::int32_t e : elements) {
    const auto i = static_cast<std::size_t>(e);
    const Vector arm = cross(direction, specimen.position[i] - middle);
    swept += dot(arm, equilibrium.displacement[i]);
    squares += dot(arm, arm);
  }
  for (const std::int32_t e : elements) {
    const auto i = static_cast<std::size_t>(e);
    equilibrium.displacement[i] -=
        (swept / squares) * cross(direction, specimen.position[i] - middle);
  }
}

}  // namespace

TensileBar tensile_bar(const Specimen& specimen, const std::optional<Gauge>& gauge) {
  const Domain& domain = specimen.domain;
  if (domain.is_periodic())
    throw InputError(
        "[specimen] periodic: a periodic body cannot thin as it is stretched, so that a tension "
        "test measures no Poisson ratio; expected periodic = [false, false, false]");
  const Vector extent = domain.upper - domain.lower;
  TensileBar bar{};
  bar.grip_depth = 2 * mean_radius(specimen);
  if (gauge) {
    bar.gauge = *gauge;
  } else {
    int longest = domain.axis >= 0 ? domain.axis : 0;
    for (int axis = 0; axis < 3 && domain.axis < 0; ++axis)
      if (component(extent, axis) > component(extent, longest)) longest = axis;
    const double low = component(domain.lower, longest), length = component(extent, longest);
    bar.gauge = {longest, low + 0.3 * length, low + 0.7 * length};
  }
  const double low = component(domain.lower, bar.gauge.axis) + bar.grip_depth;
  const double high = component(domain.upper, bar.gauge.axis) - bar.grip_depth;
  if (bar.gauge.lower < low || bar.gauge.upper > high)
    throw InputError("[gauge] from " + text_of(bar.gauge.lower) + " to " +
                     text_of(bar.gauge.upper) +
                     " reaches into the ends that are pulled (one mean " +
                     "diameter deep); expected a section between " + text_of(low) + " and " +
                     text_of(high) + ", in a body long enough for it");
  return bar;
}

ElasticConstants elastic_constants(const BeamParameters& beams, const Specimen& specimen,
                                   const TensileBar& bar, std::optional<Equilibrium>* state) {
  const BeamNetwork network = beam_network(beams, specimen);
  EquilibriumOptions options;
  options.tolerance = 1e-7;  // far below the scatter of specimens
  if (state != nullptr && state->has_value()) options.guess = &**state;
  Equilibrium equilibrium = small_equilibrium(network, pulled_ends(network, bar), {}, options);
  if (state != nullptr) *state = equilibrium;
  take_out_turn(equilibrium, network, bar.gauge.axis);
  const GaugeMeasure measure = measure_gauge(network, equilibrium, bar.gauge);
  if (!(measure.strain > 0) || !(measure.stress > 0))
    throw RunError(
        "the bar does not resist: its ends do not hang together; expected a packing of several "
        "layers, or a larger [bonds] tolerance");
  return {measure.stress / measure.strain,
          -0.5 * (measure.lateral_strain[0] + measure.lateral_strain[1]) / measure.strain};
}

}  // namespace solidem
