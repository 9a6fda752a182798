// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_FRICTION_HEAT_HPP
#define SOLIDEM_EFFECTS_FRICTION_HEAT_HPP

#include <vector>

#include "effects/conduction.hpp"
#include "effects/contact_heat.hpp"
#include "effects/temperature_acts.hpp"

namespace solidem {

class ElementContacts;
class Tool;

struct FrictionHeatParameters {
  double fraction = 1;          ///< of the work of friction that becomes heat
  double damping_fraction = 0;  ///< of what dashpots of contacts take
};

/// Friction of elements with each other and with tools heats both sides, as their effusivities say.
///
/// Contacts add to what stands for each element in a column; elements are given it when heat steps.
/// What a tool takes leaves the body.
class FrictionHeat : public HeatOfMotion {
 public:
  static std::vector<const Column*> columns() {
    return {&columns::friction_heat, &columns::given_friction_heat};
  }

  /// Contacts: null where there are none.
  FrictionHeat(const FrictionHeatParameters& parameters, std::vector<double> effusivity,
               const Conduction& conduction, ElementContacts* contacts,
               const std::vector<Tool*>& tools);

  void deliver(Model& model, const Step& step) override;

  /// The heat of all that contacts lost, that of tools too, and how much of it waits.
  void observe(const Model& model, Observation& observation) const override;

 private:
  ContactHeat heat_;
  const Conduction& conduction_;
};

}  // namespace solidem

#endif
