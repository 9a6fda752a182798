// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_HEAT_CLOCK_HPP
#define SOLIDEM_EFFECTS_HEAT_CLOCK_HPP

#include <algorithm>
#include <limits>
#include <optional>

#include "effects/conduction_parameters.hpp"
#include "effects/effect.hpp"

namespace solidem {

/// The clock of heat beside motion: heat steps once in several steps of the motion, over all of the
/// time that they took, and at the end of the run.
///
/// How many is given, or chosen: twice as many as before at most, so that no temperature changes by
/// more than is allowed from one heat step to the next, and never more than a longest step of heat.
class HeatClock : public Effect {
 public:
  explicit HeatClock(const ConductionParameters& parameters)
      : every_(parameters.every), largest_change_(parameters.largest_change) {}

  bool is_automatic() const { return largest_change_.has_value(); }
  /// The longest step that heat may take, s, where the clock chooses.
  void bound(double longest) { longest_ = longest; }

  /// Tells that a step of the motion has passed: the step that heat takes now, if any.
  std::optional<Step> pass(const Step& motion);
  /// How long a step of heat would be, s.
  double length(const Step& motion) const { return static_cast<double>(every_) * motion.time_step; }
  /// Chooses, after a step of heat that changed a temperature by so much, K.
  void adapt(double change, const Step& motion);

  void advance(Model& /*model*/, const Step& /*step*/) override {}
  void start(const Model& /*model*/, double duration) override { duration_ = duration; }
  void observe(const Model& /*model*/, Observation& observation) const override {
    if (is_automatic()) observation.add("heat_every", static_cast<double>(every_));
  }
  void state(Archive& archive) override { archive(every_, waiting_, since_, passed_); }

 private:
  std::int64_t every_;
  std::optional<double> largest_change_;  ///< K
  double longest_ = std::numeric_limits<double>::infinity();
  double duration_ = std::numeric_limits<double>::infinity();
  std::int64_t waiting_ = 0;  ///< steps of the motion since heat last stepped
  double since_ = 0;          ///< when the first of them began, s
  double passed_ = 0;         ///< how long they took, s
};

}  // namespace solidem

#endif
