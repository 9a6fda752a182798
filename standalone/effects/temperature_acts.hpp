// SPDX-License-Identifier: GPL-2.0-or-later
//
// What joins heat and motion: effects that heat elements before heat is conducted, and effects that
// follow the temperatures after it. Both act when heat steps, and not in each step of the motion.
#ifndef SOLIDEM_EFFECTS_TEMPERATURE_ACTS_HPP
#define SOLIDEM_EFFECTS_TEMPERATURE_ACTS_HPP

#include "effects/effect.hpp"

namespace solidem {

/// Heat that motion has made since heat last stepped, or that passes where elements touch now.
class HeatOfMotion : public Effect {
 public:
  void advance(Model& /*model*/, const Step& /*step*/) override {}  // see deliver()
  /// Gives it to the elements, whose temperatures change at once, before heat takes a step.
  virtual void deliver(Model& model, const Step& step) = 0;
};

/// What temperatures change about motion.
class FollowsTemperature : public Effect {
 public:
  void advance(Model& /*model*/, const Step& /*step*/) override {}  // see follow()
  /// Takes over the temperatures that the model has now, after a step of the motion of so long, s.
  virtual void follow(Model& model, double time_step) = 0;
};

}  // namespace solidem

#endif
