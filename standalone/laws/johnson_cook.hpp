// SPDX-License-Identifier: GPL-2.0-or-later
//
// Flow of metals that harden, the more the faster they flow, and soften as they warm.
//
// Source: Johnson & Cook, Proc. 7th Int. Symp. Ballistics, 541 (1983):
//   ε_y(κ, κ̇, T) = (a + b κ^n) (1 + C ln(κ̇ / κ̇_0)) (1 − T*^m),  T* = (T − T_ref)/(T_melt − T_ref),
// a = A / E and b = B / E. The logarithm is cut below κ̇_0, where the rate counts no more; T* is cut
// to [0, 1]: below T_ref temperature counts no more, and from T_melt on nothing is borne. Without C
// the rate, without T_melt the temperature does not count.
#ifndef SOLIDEM_LAWS_JOHNSON_COOK_HPP
#define SOLIDEM_LAWS_JOHNSON_COOK_HPP

#include <array>
#include <cmath>

#include "laws/bond_law.hpp"
#include "laws/yield_law.hpp"

namespace solidem {

struct JohnsonCook {
  double yield_strain = 0;                ///< a
  double hardening_strain = 0;            ///< b
  double hardening_exponent = 1;          ///< n
  double rate_sensitivity = 0;            ///< C
  double reference_rate = 1;              ///< κ̇_0, 1/s
  double softening_exponent = 1;          ///< m
  double reference_temperature = 0;       ///< T_ref, K
  double melting_temperature = HUGE_VAL;  ///< T_melt, K

  static constexpr bool depends_on_state = true;
  constexpr bool follows_temperature() const { return melting_temperature < HUGE_VAL; }
  constexpr bool follows_rate() const { return rate_sensitivity > 0; }

  static constexpr const char* name = "johnson-cook";
  static constexpr std::array<BondLawParameter<JohnsonCook>, 8> parameters() {
    return {
        {{"yield_strain", "yield_stress", &JohnsonCook::yield_strain, LawBound::above_zero, true,
          "A / E, at which a bond first flows, cold and slow"},
         {"hardening_strain", "hardening_stress", &JohnsonCook::hardening_strain,
          LawBound::from_zero, true, "B / E, what it gains up to a plastic strain of 1"},
         {"hardening_exponent", nullptr, &JohnsonCook::hardening_exponent, LawBound::above_zero,
          true, "n of the plastic strain"},
         {"rate_sensitivity", nullptr, &JohnsonCook::rate_sensitivity, LawBound::from_zero, false,
          "C, what a rate e times as large adds"},
         {"reference_rate", nullptr, &JohnsonCook::reference_rate, LawBound::above_zero, false,
          "of the plastic strain, below which the rate does not count", LawUnit::rate},
         {"softening_exponent", nullptr, &JohnsonCook::softening_exponent, LawBound::above_zero,
          false, "m of the homologous temperature"},
         {"reference_temperature", nullptr, &JohnsonCook::reference_temperature,
          LawBound::from_zero, false, "below which temperature does not count",
          LawUnit::temperature},
         {"melting_temperature", nullptr, &JohnsonCook::melting_temperature, LawBound::above_zero,
          false, "from which on nothing is borne", LawUnit::temperature}}};
  }

  /// What is wrong with the parameters together; null: nothing.
  constexpr const char* complaint() const {
    if (!follows_temperature())
      return reference_temperature == 0 ? nullptr : "melting_temperature is needed too";
    if (reference_temperature == 0) return "reference_temperature is needed too";
    return melting_temperature > reference_temperature
               ? nullptr
               : "melting_temperature must be above reference_temperature";
  }

  template <class Real>
  Real limit(const Real& plastic_strain, const YieldState<Real>& state) const {
    const Real one{1.0};
    const Real hard =
        Real{yield_strain} + Real{hardening_strain} * power(plastic_strain, hardening_exponent);
    return hard * fastness(state.rate) *
           (one - power(warmth(state.temperature), softening_exponent));
  }

  /// Molten bonds bear nothing.
  template <class Real>
  Real lower_bound(const Real& /*plastic_strain*/) const {
    return Real{0.0};
  }

 private:
  /// x^p; 0 where x is not above 0, with a slope of 0.
  template <class Real>
  static Real power(const Real& x, double p) {
    using std::exp;
    using std::log;
    const Real none{0.0};
    const auto counts = greater(x, none);
    const Real base = select(counts, x, Real{1.0});
    return select(counts, exp(Real{p} * log(base)), none);
  }

  /// 1 + C ln(κ̇ / κ̇_0), from κ̇_0 on.
  template <class Real>
  Real fastness(const Real& rate) const {
    using std::log;
    const Real times = rate / Real{reference_rate}, one{1.0};
    return one + Real{rate_sensitivity} * log(select(greater(times, one), times, one));
  }

  /// T*, from 0 to 1.
  template <class Real>
  Real warmth(const Real& temperature) const {
    const Real none{0.0}, one{1.0};
    const Real part = (temperature - Real{reference_temperature}) /
                      Real{melting_temperature - reference_temperature};
    return select(greater(none, part), none, select(greater(part, one), one, part));
  }
};

}  // namespace solidem

#endif
