// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_HEAT_SOURCE_HPP
#define SOLIDEM_EFFECTS_HEAT_SOURCE_HPP

#include <vector>

#include "effects/heat_load.hpp"
#include "effects/parameters.hpp"

namespace solidem {

/// Heat that arises in the elements of a region, or in a shape that may move. An element on the
/// surface of a shape takes the share that lies inside of a ball of its volume, so that the heat
/// does not jump when the shape passes over it.
class HeatSource : public HeatLoad {
 public:
  /// `elements`: of the region, if it has one. `volume`: that each element stands for, m³;
  /// one that stands for none takes no heat.
  HeatSource(const HeatSourceParameters& parameters, const std::vector<std::int32_t>& elements,
             std::vector<double> volume, const Specimen& specimen);

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
  std::vector<ElementValue> fixed_;  ///< heated volumes of a region
  std::vector<double> volume_, radius_;
  const Vector* centre_;  ///< of the specimen, which outlives every effect
  Vector lower_, upper_;  ///< box round the shape and an element, at its origin, m
};

}  // namespace solidem

#endif
