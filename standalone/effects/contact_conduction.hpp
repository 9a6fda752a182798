// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CONTACT_CONDUCTION_HPP
#define SOLIDEM_EFFECTS_CONTACT_CONDUCTION_HPP

#include <optional>
#include <vector>

#include "effects/conduction.hpp"
#include "effects/temperature_acts.hpp"

namespace solidem {

class ElementContacts;
class Tool;

/// Exactly one of them.
struct ContactConductionParameters {
  std::optional<double> coefficient;  ///< of the circle in which two overlap, W/(m² K)
  std::optional<double> conductance;  ///< of each contact, W/K
};

/// Elements that touch each other, or a tool that has a temperature, exchange heat:
/// laws/contact_exchange.hpp.
///
/// It acts before heat is conducted, for the time of that step, through the contacts that there are
/// then: one after the other for half of the time, each exactly, and in the opposite order for the
/// other half. So it is stable for any step, second order in it, and the same for all integrators.
/// Pairs that conduct already, by a bond or a face of their cells, have no second way.
class ContactConduction : public HeatOfMotion {
 public:
  /// Contacts: null where elements do not touch each other.
  ContactConduction(const ContactConductionParameters& parameters, const Conduction& conduction,
                    const ElementContacts* contacts, const std::vector<Tool*>& tools);

  void deliver(Model& model, const Step& step) override;
  void observe(const Model& model, Observation& observation) const override;
  void state(Archive& archive) override { archive(of_tools_); }

 private:
  /// Between two elements, or between an element and a tool.
  struct Way {
    std::int32_t element;
    std::int32_t other;  ///< an element, or less than zero: tool number −1 − other
    double conductance;  ///< W/K
  };
  void list_ways(const Model& model);
  double conductance(double curvature, double other_curvature, double overlap) const;
  void exchange(Model& model, const Way& way, const Step& part);

  ContactConductionParameters parameters_;
  const Conduction& conduction_;
  const ElementContacts* contacts_;
  std::vector<const Tool*> tools_;  ///< that have a temperature
  std::vector<double> of_tools_;    ///< heat that they gave to elements since the start, J
  std::vector<Way> ways_;
};

}  // namespace solidem

#endif
