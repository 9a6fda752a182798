// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_HEAT_SOURCE_HPP
#define SOLIDEM_EFFECTS_HEAT_SOURCE_HPP

#include <memory>
#include <vector>

#include "effects/heat_load.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/heat_spread.hpp"

namespace solidem {

/// Heat that arises in the elements of a region, or in a shape that may move. An element on the
/// surface of a shape is heated as far as its cell lies inside, so that the heat is that of the
/// shape and does not jump when it passes over the element.
class HeatSource : public HeatLoad {
 public:
  /// Of a region: the volume that each of its elements is heated in, m³.
  HeatSource(const HeatSourceParameters& parameters, std::vector<ElementValue> fixed);
  /// Of a shape: its volume shared among elements.
  HeatSource(const HeatSourceParameters& parameters, std::unique_ptr<HeatSpread> spread);
  ~HeatSource() override;

  void powers(double time, const double* temperature,
              std::vector<ElementValue>& powers) const override;

  bool is_steady() const override;

  /// Refuses a source that heats nothing all the time.
  void start(const Model& model, double duration) override;

  /// Whether it heats anything at a time.
  bool reaches(double time) const;

 private:
  /// Heated volume of each element at a time, m³.
  void heated(double time, std::vector<ElementValue>& volumes) const;

  HeatSourceParameters parameters_;
  std::vector<ElementValue> fixed_;     ///< heated volumes of a region
  std::unique_ptr<HeatSpread> spread_;  ///< of a shape
};

}  // namespace solidem

#endif
