// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/heat/heat_integrator.hpp"

#include <fmt/format.h>

#include "model/error.hpp"
#include "solve/heat/adaptive_heat_steps.hpp"
#include "solve/heat/explicit_euler.hpp"
#include "solve/heat/fixed_heat_steps.hpp"
#include "solve/heat/implicit_heat.hpp"
#include "solve/heat/super_time_stepping.hpp"

namespace solidem {

std::unique_ptr<HeatIntegrator> make_heat_integrator(HeatIntegration choice,
                                                     const HeatIntegratorParameters& parameters) {
  const double tolerance = parameters.tolerance;
  if (!(tolerance >= 0))
    throw InputError(fmt::format("heat: a tolerance of {} K; it must be positive", tolerance));
  if (choice == HeatIntegration::automatic) {
    if (tolerance == 0)
      throw InputError("heat: integrator \"auto\" needs a tolerance, in kelvin, to choose by");
    std::vector<std::unique_ptr<HeatMethod>> methods;
    methods.push_back(std::make_unique<ExplicitEuler>());
    methods.push_back(std::make_unique<SuperTimeStepping>());
    methods.push_back(std::make_unique<ImplicitHeat>());
    return std::make_unique<AdaptiveHeatSteps>(std::move(methods), tolerance);
  }
  if (choice == HeatIntegration::explicit_euler) {
    if (tolerance > 0)
      throw InputError(
          "heat: integrator \"explicit\" takes the time step as it is and has no use for a "
          "tolerance; drop it, or choose \"rkl2\", \"implicit\" or \"auto\"");
    return std::make_unique<FixedHeatSteps>(std::make_unique<ExplicitEuler>());
  }
  std::unique_ptr<HeatMethod> method;
  if (choice == HeatIntegration::rkl2)
    method = std::make_unique<SuperTimeStepping>();
  else
    method = std::make_unique<ImplicitHeat>();
  if (tolerance == 0) return std::make_unique<FixedHeatSteps>(std::move(method));
  std::vector<std::unique_ptr<HeatMethod>> methods;
  methods.push_back(std::move(method));
  return std::make_unique<AdaptiveHeatSteps>(std::move(methods), tolerance);
}

}  // namespace solidem
