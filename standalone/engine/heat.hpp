// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_HEAT_HPP
#define SOLIDEM_ENGINE_HEAT_HPP

#include <memory>
#include <optional>
#include <vector>

#include "effects/conduction.hpp"
#include "effects/imposed_temperature.hpp"
#include "engine/selections.hpp"
#include "engine/setup.hpp"

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
  /// The columns of the plan must be there. Throws InputError for a wall that the body lacks, and
  /// for a region without elements that conduct.
  Heat(const Setup& setup, ConductionGeometry geometry, const std::vector<std::size_t>& material,
       Model& model, Selections& selections);
  ~Heat();

  /// Conduction, its loads and what is imposed, in the order of the plan.
  const std::vector<std::unique_ptr<Effect>>& effects() const { return effects_; }
  const Conduction& conduction() const { return *conduction_; }
  const std::vector<HeatLoad*>& loads() const { return loads_; }
  double area_factor() const { return area_factor_; }

  /// Whether stability bounds the time step.
  bool takes_explicit_steps() const {
    return parameters_.integrator == ConductionParameters::Integrator::explicit_euler;
  }
  const TimeStepCriterion& criterion() const { return criterion_; }
  /// The longest stable explicit step, s.
  double limit() const { return limit_; }

  /// Makes ready to advance, for so long, s. Throws InputError for a source outside the body.
  void start(double duration);
  /// Makes a time step; the temperatures after it are those of the model.
  void advance(const Step& step);

  /// None where conduction takes explicit steps by itself.
  HeatIntegrator* integrator() const { return integrator_.get(); }

 private:
  /// Makes known that bonds changed what conducts. Throws RunError where that makes the explicit
  /// time step too long, unless it was so from the start.
  void adopt_conductors(const Step& step);
  /// Largest conductances to the outside, of elements.
  std::vector<ElementValue> largest_exchange() const;

  ConductionParameters parameters_;
  std::vector<HeatSourceParameters> sources_;
  Model& model_;
  double area_factor_;
  std::vector<std::unique_ptr<Effect>> effects_;
  Conduction* conduction_ = nullptr;
  std::vector<HeatLoad*> loads_;
  std::vector<ImposedTemperature*> imposed_;
  TimeStepCriterion criterion_;
  double limit_ = 0;
  std::unique_ptr<HeatedModel> heated_;
  std::unique_ptr<HeatIntegrator> integrator_;
};

}  // namespace solidem

#endif
