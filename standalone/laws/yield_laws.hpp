// SPDX-License-Identifier: GPL-2.0-or-later
//
// The table of yield laws of bonds: a new law is a header like these and a line here. Keys of
// scenes, kernels and words of the bond style are made from it.
#ifndef SOLIDEM_LAWS_YIELD_LAWS_HPP
#define SOLIDEM_LAWS_YIELD_LAWS_HPP

#include <type_traits>
#include <variant>

#include "laws/johnson_cook.hpp"
#include "laws/law_table.hpp"
#include "laws/linear_hardening.hpp"
#include "laws/voce_hardening.hpp"

namespace solidem {

using YieldLaws = LawTable<LinearHardening,  //
                           VoceHardening,    //
                           JohnsonCook>;

/// Any of them, with its parameters.
using YieldLaw = YieldLaws::Any;

/// Whether bonds of a law yield otherwise when they are warm.
inline bool follows_temperature(const YieldLaw& any) {
  return std::visit(
      [](const auto& law) {
        if constexpr (depends_on_state<std::decay_t<decltype(law)>>)
          return law.follows_temperature();
        else
          return false;
      },
      any);
}

/// Whether they yield otherwise when they flow fast.
inline bool follows_rate(const YieldLaw& any) {
  return std::visit(
      [](const auto& law) {
        if constexpr (depends_on_state<std::decay_t<decltype(law)>>)
          return law.follows_rate();
        else
          return false;
      },
      any);
}

}  // namespace solidem

#endif
