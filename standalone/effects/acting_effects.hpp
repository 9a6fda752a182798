// SPDX-License-Identifier: GPL-2.0-or-later
//
// Effects by what they act on: pairs of elements (effects/pair_loads.hpp), or elements that they
// touch from outside.
#ifndef SOLIDEM_EFFECTS_ACTING_EFFECTS_HPP
#define SOLIDEM_EFFECTS_ACTING_EFFECTS_HPP

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "effects/pair_loads.hpp"
#include "laws/virial_stress.hpp"

namespace solidem {

/// An effect that touches elements from outside of the body.
class TouchesElements {
 public:
  TouchesElements() = default;
  TouchesElements(const TouchesElements&) = default;
  TouchesElements& operator=(const TouchesElements&) = default;
  virtual ~TouchesElements() = default;

  /// Called for one element: with the sum of sym(force ⊗ lever from its centre), N·m.
  using Visit = std::function<void(std::int32_t, const SymmetricTensor<double>&)>;
  virtual void for_each_touched(const Visit& visit) const = 0;
};

/// Those of some effects that are of a kind, in their order.
template <class Kind, class Effect>
std::vector<const Kind*> those_that_are(const std::vector<std::unique_ptr<Effect>>& effects) {
  std::vector<const Kind*> found;
  for (const auto& effect : effects)
    if (const auto* one = dynamic_cast<const Kind*>(effect.get())) found.push_back(one);
  return found;
}

}  // namespace solidem

#endif
