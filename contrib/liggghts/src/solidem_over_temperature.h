// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_OVER_TEMPERATURE_H
#define LMP_SOLIDEM_OVER_TEMPERATURE_H

#include "laws/heat_exchange.hpp"
#include "laws/interpolation.hpp"

namespace LAMMPS_NS {

/// A property over temperature, of few points; one is a constant, none says that it is not given.
/// Plain data.
struct SolidemOverTemperature {
  enum { MOST_POINTS = 16 };
  int points = 0;
  double temperature[MOST_POINTS] = {};  ///< K, increasing
  double value[MOST_POINTS] = {};
  double integral[MOST_POINTS] = {};  ///< of the value, from the first temperature on

  bool is_given() const { return points > 0; }
  double operator()(double at) const { return solidem::interpolate(table(), at); }
  /// Of the value between two temperatures.
  double integral_between(double from, double to) const {
    return solidem::integrate(table(), to) - solidem::integrate(table(), from);
  }
  void integrate() { solidem::integrate_table(points, temperature, value, integral); }

 private:
  solidem::TablePoints table() const { return {points, temperature, value, integral}; }
};

/// What the temperatures of its two atoms change about a beam: either half of it has that of its
/// atom. Plain data.
struct SolidemBeamWarmth {
  SolidemOverTemperature expansion_coefficient;  ///< 1/K
  double reference_temperature = 0.0;    ///< K, at which bonds are as long as when first seen
  SolidemOverTemperature modulus_ratio;  ///< to the coefficients' moduli

  /// The length free of load over that at the reference temperature.
  double stretch(double at_i, double at_j) const {
    if (!expansion_coefficient.is_given()) return 1.0;
    const double from = reference_temperature;
    return 1.0 + 0.5 * (expansion_coefficient.integral_between(from, at_i) +
                        expansion_coefficient.integral_between(from, at_j));
  }
  /// All stiffness over that of the coefficients: two halves in series.
  double stiffness(double at_i, double at_j) const {
    if (!modulus_ratio.is_given()) return 1.0;
    return solidem::series_conductivity(modulus_ratio(at_i), modulus_ratio(at_j));
  }
};

}  // namespace LAMMPS_NS

#endif
