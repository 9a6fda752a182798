// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_PLASTIC_HEAT_HPP
#define SOLIDEM_EFFECTS_PLASTIC_HEAT_HPP

#include <vector>

#include "effects/conduction.hpp"
#include "effects/temperature_acts.hpp"

namespace solidem {

struct PlasticHeatParameters {
  double fraction = 0.9;  ///< β of Taylor and Quinney: of plastic work that becomes heat
};

/// Plastic work of bonds heats their ends, either by half of it.
///
/// An element keeps the heat that it was given, J; the rest of its share waits until heat steps.
class PlasticHeat : public HeatOfMotion {
 public:
  static std::vector<const Column*> columns() { return {&columns::plastic_heat}; }

  PlasticHeat(const PlasticHeatParameters& parameters, const Conduction& conduction)
      : parameters_(parameters), conduction_(conduction) {}

  void deliver(Model& model, const Step& step) override;

  /// The heat of all plastic work, that of the flow at this moment too, and how much of it waits.
  void observe(const Model& model, Observation& observation) const override;

 private:
  PlasticHeatParameters parameters_;
  const Conduction& conduction_;
};

}  // namespace solidem

#endif
