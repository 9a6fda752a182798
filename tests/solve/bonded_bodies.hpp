// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bodies held at their ends, for tests of equilibrium.
#ifndef SOLIDEM_TESTS_SOLVE_BONDED_BODIES_HPP
#define SOLIDEM_TESTS_SOLVE_BONDED_BODIES_HPP

#include <algorithm>
#include <cmath>

#include "effects/beam_parameters.hpp"
#include "laws/constants.hpp"
#include "model/region.hpp"
#include "solve/statics/static_equilibrium.hpp"
#include "support/specimens.hpp"

namespace solidem {

inline BeamParameters beam_parameters(
    BeamParameters::Law law = BeamParameters::Law::euler_bernoulli) {
  BeamParameters beams = *elastic_setup().get<BeamParameters>();
  beams.law = law;
  return beams;
}

/// A straight row of beams along x from the first centre to the last.
struct Row {
  explicit Row(int elements, const BeamParameters& parameters = beam_parameters())
      : specimen(crystal("simple_cubic", {elements, 1, 1})),
        network(beam_network(parameters, specimen)) {
    const auto by_x = [&](std::int32_t a, std::int32_t b) {
      return specimen.position[static_cast<std::size_t>(a)].x <
             specimen.position[static_cast<std::size_t>(b)].x;
    };
    std::vector<std::int32_t> all;
    for (int e = 0; e < elements; ++e) all.push_back(e);
    first = *std::min_element(all.begin(), all.end(), by_x);
    last = *std::max_element(all.begin(), all.end(), by_x);
    for (int degree = 0; degree < 6; ++degree) clamped.push_back({first, degree, 0.0});
    const double radius = parameters.radius_ratio * 1e-4;
    young = parameters.young_modulus;
    shear = parameters.shear_modulus;
    area = pi * radius * radius;
    second_moment = area * radius * radius / 4;
    length = 2e-4 * (elements - 1);
  }

  double bending() const { return young * second_moment; }

  Specimen specimen;
  BeamNetwork network;
  std::int32_t first = 0, last = 0;
  std::vector<Constraint> clamped;  ///< the first element
  double young, shear, area, second_moment, length;
};

/// Both faces of a body along x, all degrees of freedom held; the upper one displaced.
inline std::vector<Constraint> stretched(const Specimen& specimen, double displacement) {
  std::vector<Constraint> constraints;
  for (const bool high : {false, true})
    for (const std::int32_t e : select(face(0, high), specimen))
      for (int degree = 0; degree < 6; ++degree)
        constraints.push_back({e, degree, high && degree == 0 ? displacement : 0.0});
  return constraints;
}

inline Vector at(const std::vector<Vector>& values, std::int32_t element) {
  return values[static_cast<std::size_t>(element)];
}

}  // namespace solidem

#endif
