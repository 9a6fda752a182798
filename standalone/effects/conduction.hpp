// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CONDUCTION_HPP
#define SOLIDEM_EFFECTS_CONDUCTION_HPP

#include <vector>

#include "effects/effect.hpp"
#include "effects/parameters.hpp"

namespace solidem {

/// Thermal properties of each element, or one value for all.
struct ThermalProperties {
  std::vector<double> density;        ///< ρ_0, kg/m³
  std::vector<double> specific_heat;  ///< c_p, J/(kg K)
  std::vector<double> conductivity;   ///< λ, W/(m K)
};

/// Heat conduction between bonded elements: laws/platonic_conduction.hpp, explicit Euler. Between
/// two materials the harmonic mean of their conductivities acts.
class Conduction : public Effect {
 public:
  static std::vector<const Column*> columns();

  Conduction(const ConductionParameters& parameters, const ThermalProperties& properties,
             Model& model);

  /// min over elements of C_i / Σ_j conductance_ij: no temperature overshoots its neighbours'.
  TimeStepCriterion time_step_criterion(const Model& model) const;

  void advance(Model& model, const Step& step) override;
  void observe(const Model& model, Observation& observation) const override;

 private:
  double initial_temperature_;
};

}  // namespace solidem

#endif
