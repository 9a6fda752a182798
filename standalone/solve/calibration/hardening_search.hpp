// SPDX-License-Identifier: GPL-2.0-or-later
//
// Which hardening of bonds gives a body the curve of a material.
//
// A network of bonds yields one bond after the other, and bears at each strain some multiple of
// what its bonds bear at that plastic strain: less at first, while most bonds are elastic. That
// multiple depends little on the hardening. So each test of a body shows it, at every point of the
// curve, and the law of the bonds is fitted to the wanted curve over that multiple.
#ifndef SOLIDEM_SOLVE_CALIBRATION_HARDENING_SEARCH_HPP
#define SOLIDEM_SOLVE_CALIBRATION_HARDENING_SEARCH_HPP

#include <functional>
#include <string>
#include <vector>

#include "laws/yield_laws.hpp"
#include "solve/calibration/flow_curve.hpp"

namespace solidem {

/// A parameter of a yield law that shapes its curve at rest and cold.
struct HardeningParameter {
  const char* name;
  double value;
};
std::vector<HardeningParameter> hardening_parameters(const YieldLaw& law);

/// The law without what rate and temperature do.
YieldLaw slow_and_cold(const YieldLaw& law);

/// The law of the same form that yields nearest to `yield_strains` at these plastic strains: least
/// squares of the logarithms. Rate and temperature act as they did.
YieldLaw fitted(const YieldLaw& law, const std::vector<double>& plastic_strains,
                const std::vector<double>& yield_strains);

/// What bodies with bonds of a law bear at the points of a curve, Pa; NaN: none came so far.
using CurveTest = std::function<std::vector<double>(const YieldLaw&)>;

/// How a search went.
struct HardeningSearch {
  YieldLaw law;                  ///< of all that were tried the one that misses least
  std::vector<double> stresses;  ///< with it
  double worst = 0;              ///< what it misses where it misses most, of the wanted stress
  std::size_t test = 0;          ///< which of the tests that was, from 0
};

/// Seeks the hardening with which a body meets a curve, in at most `most_tests` tests; ends when
/// every point is met within the tolerance or some tests in a row bring nothing. Of `form` only
/// what rate and temperature do is kept.
HardeningSearch find_hardening(const CurveTarget& target, double young_modulus,
                               const YieldLaw& form, int most_tests, const CurveTest& test);

}  // namespace solidem

#endif
