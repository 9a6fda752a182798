// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CONTACT_HEAT_HPP
#define SOLIDEM_EFFECTS_CONTACT_HEAT_HPP

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace solidem {

/// e = √(λ ρ c), W s^½/(m² K): two that rub share the heat in the ratio of theirs, as the surfaces
/// of two half-spaces that touch have one temperature (H. S. Carslaw, J. C. Jaeger, Conduction of
/// Heat in Solids, 2nd ed., §2.15).
inline double effusivity_of(double conductivity, double density, double specific_heat) {
  return std::sqrt(conductivity * density * specific_heat);
}

/// What contacts lose, as heat of both sides.
class ContactHeat {
 public:
  /// `friction`, `damping`: fractions of what slip and dashpots take. `effusivity`: of each
  /// element, W s^½/(m² K).
  ContactHeat(double friction, double damping, std::vector<double> effusivity)
      : friction_(friction), damping_(damping), effusivity_(std::move(effusivity)) {}

  /// J, of what slip and the dashpot took, J.
  double of(double friction, double damping) const {
    return friction_ * friction + damping_ * damping;
  }
  /// The part of it that an element takes beside another, and beside a body of an effusivity.
  double share(std::int32_t element, std::int32_t other) const {
    return share(element, effusivity_[static_cast<std::size_t>(other)]);
  }
  double share(std::int32_t element, double other) const {
    const double own = effusivity_[static_cast<std::size_t>(element)];
    return own / (own + other);
  }

 private:
  double friction_, damping_;
  std::vector<double> effusivity_;
};

}  // namespace solidem

#endif
