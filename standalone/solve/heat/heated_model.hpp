// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_HEATED_MODEL_HPP
#define SOLIDEM_SOLVE_HEAT_HEATED_MODEL_HPP

#include <vector>

#include "effects/heat_load.hpp"
#include "effects/imposed_temperature.hpp"
#include "solve/heat/heat_equation.hpp"

namespace solidem {

/// A model's conduction, loads and imposed temperatures as the equation that integrators of heat
/// solve. Accounts: the loads, then the imposed temperatures (minus what flows into their
/// elements).
class HeatedModel : public HeatEquation {
 public:
  /// `stable_step`: the longest stable explicit step with the conductors of the start, s.
  HeatedModel(Model& model, const Conduction& conduction, std::vector<HeatLoad*> loads,
              std::vector<ImposedTemperature*> imposed, double stable_step);

  std::size_t elements() const override { return model_.elements(); }
  std::size_t accounts() const override { return loads_.size() + imposed_.size(); }
  bool is_linear() const override;
  void powers(double time, const double* temperature, double* power, double* account) override;
  const std::vector<std::int32_t>& imposed() const override { return imposed_elements_; }
  void impose(double time, double* temperature) const override;
  double enthalpy(std::size_t i, double temperature) const override;
  double temperature(std::size_t i, double enthalpy) const override;
  double capacity(std::size_t i, double temperature) const override;
  Eigen::SparseMatrix<double> conductance_matrix(double time,
                                                 const double* temperature) const override;
  double stable_step(double /*time*/, const double* /*temperature*/) const override {
    return conduction_.surely_stable_step(stable_step_);
  }
  std::uint64_t version() const override { return model_.conductors_version(); }

  /// Hands to the effects what an integrator counted in the accounts while the temperatures (N)
  /// went from `before` to what the model has now.
  void count(const std::vector<double>& before, const std::vector<double>& accounts);

 private:
  Model& model_;
  const Conduction& conduction_;
  std::vector<HeatLoad*> loads_;
  std::vector<ImposedTemperature*> imposed_;
  std::vector<std::int32_t> imposed_elements_;
  double stable_step_;
  Buffer<double> power_;
  std::vector<ElementValue> values_;
};

}  // namespace solidem

#endif
