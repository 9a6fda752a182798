// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_HEAT_HPP
#define SOLIDEM_ENGINE_HEAT_HPP

#include <memory>
#include <optional>
#include <vector>

#include "effects/conduction.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/exposed_surface.hpp"
#include "effects/heat_clock.hpp"
#include "effects/imposed_temperature.hpp"
#include "effects/setup.hpp"
#include "effects/temperature_acts.hpp"

namespace solidem {

class HeatedModel;
class HeatIntegrator;

/// What the elements of a specimen stand for in conduction; for the calibrated law scaled by a
/// factor, or by the one that a steady bar test gives.
ConductionGeometry scaled_geometry(const ConductionParameters& parameters, const Specimen& specimen,
                                   std::optional<double> area_factor);

/// All that conducts and heats in a simulation, and what carries it through time.
class Heat {
 public:
  /// `effects`: those of the phase of heat, in their order; one of them conducts.
  Heat(const ConductionParameters& parameters, double area_factor, std::vector<Effect*> effects,
       Model& model);
  ~Heat();

  const Conduction& conduction() const { return *conduction_; }
  const std::vector<HeatLoad*>& loads() const { return loads_; }
  double area_factor() const { return area_factor_; }

  /// Whether stability bounds the time step.
  bool takes_explicit_steps() const {
    return parameters_.integrator == ConductionParameters::Integrator::explicit_euler;
  }
  /// Bounds on the step of the motion where heat takes explicit steps, s, and the longest stable
  /// one: heat's own, shared among the steps that it waits for.
  TimeStepCriterion criterion() const {
    return {criterion_.name, criterion_.value / static_cast<double>(parameters_.every)};
  }
  double limit() const { return limit_ / static_cast<double>(parameters_.every); }

  /// Makes ready to advance, in a run of so long, s.
  void start(double duration);
  /// Takes in a time step of the motion, and steps where it is time to; the temperatures after that
  /// are those of the model.
  void advance(const Step& motion);

  /// Throws RunError where a temperature is below absolute zero, or no number.
  void check(std::int64_t step, double time) const;

  /// None where conduction takes explicit steps by itself.
  HeatIntegrator* integrator() const { return integrator_.get(); }

 private:
  /// Gives elements the heat that motion has made before a step.
  void take_heat_of_motion(const Step& step);
  /// Conducts and heats over a step.
  void carry(const Step& step);
  /// Takes in which bonds broke or were made; whether heat passes otherwise now.
  bool follow_bonds();
  /// Makes known that bonds changed what conducts. Throws RunError where that makes the explicit
  /// time step too long, unless it was so from the start.
  void adopt_conductors(double time, double time_step);
  /// Largest conductances to the outside, of elements.
  std::vector<ElementValue> largest_exchange() const;

  ConductionParameters parameters_;
  Model& model_;
  double area_factor_;
  std::vector<Effect*> effects_;
  Conduction* conduction_ = nullptr;
  std::vector<HeatLoad*> loads_;
  std::vector<ImposedTemperature*> imposed_;
  std::vector<HeatOfMotion*> of_motion_;
  std::vector<FollowsTemperature*> following_;
  ExposedSurface* surface_ = nullptr;  ///< none: nobody heats it
  HeatClock* clock_ = nullptr;         ///< none: heat steps with the motion
  TimeStepCriterion criterion_;
  double limit_ = 0;
  std::unique_ptr<HeatedModel> heated_;
  std::unique_ptr<HeatIntegrator> integrator_;
};

}  // namespace solidem

#endif
