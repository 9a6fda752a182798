// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat that comes into a body from outside or arises in it: what every such effect has in common.
#ifndef SOLIDEM_EFFECTS_HEAT_LOAD_HPP
#define SOLIDEM_EFFECTS_HEAT_LOAD_HPP

#include <string>
#include <vector>

#include "effects/effect.hpp"

namespace solidem {

/// A figure of one element: a power, W, or a conductance, W/K.
struct ElementValue {
  std::int32_t element;
  double value;
};

class HeatLoad : public Effect {
 public:
  /// `column`: what its columns in the history begin with.
  explicit HeatLoad(std::string column) : column_(std::move(column)) {}

  const std::string& column() const { return column_; }

  /// Appends the power into each element that it heats, W, at a time and at temperatures.
  virtual void powers(double time, const double* temperature,
                      std::vector<ElementValue>& powers) const = 0;

  /// Appends −∂P/∂T of each element whose power depends on its temperature, W/K.
  virtual void conductances(double /*time*/, const double* /*temperature*/,
                            std::vector<ElementValue>& /*conductances*/) const {}

  /// Whether those are the same at all times and temperatures.
  virtual bool is_linear() const { return true; }

  /// Whether its power, or the temperature outside where it exchanges heat, stays the same.
  virtual bool is_steady() const = 0;

  /// Appends the largest that those can be.
  virtual void largest_conductances(std::vector<ElementValue>& /*conductances*/) const {}

  /// Its part of an explicit Euler step, after conduction's.
  void advance(Model& model, const Step& step) override;

  /// Counts heat, J, that an integrator brought in.
  void count(double heat) { heat_ += heat; }

  void observe(const Model& model, Observation& observation) const override;
  void state(Archive& archive) override { archive(heat_); }

 private:
  std::string column_;
  double heat_ = 0;  ///< J, since the start
  std::vector<ElementValue> powers_;
};

}  // namespace solidem

#endif
