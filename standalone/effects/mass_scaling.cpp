// SPDX-License-Identifier: GPL-2.0-or-later
//
// [mass_scaling]: elements resist acceleration as if they were denser, so that a process that is
// slow against sound takes fewer, longer steps. Source: W. C. Chung, J. W. Cho and T. Belytschko,
// On the dynamic effects of explicit FEM in sheet metal forming analysis, Eng. Comput. 15 (1998).
//
// A density times f makes waves slower and the stable step longer by √f. Weights and capacities for
// heat stay those of the true mass. The result stands for the slow process as long as the kinetic
// energy is a small part of the work, which the history tells: kinetic_over_work, below 0.01.
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "effects/assembly.hpp"
#include "effects/effect_kind.hpp"
#include "keys/rules.hpp"

namespace solidem {

namespace {

struct MassScalingParameters {
  double factor = 1;  ///< of masses and moments of inertia
};

class MassScaling : public Effect {
 public:
  explicit MassScaling(const MassScalingParameters& parameters) : parameters_(parameters) {}

  void advance(Model& /*model*/, const Step& /*step*/) override {}

  void observe(const Model& /*model*/, Observation& observation) const override {
    double work = 0;
    observation.energies.for_each([&](EnergyLedger::Kind kind, const std::string&, double energy) {
      if (kind == EnergyLedger::Kind::input) work += energy;
    });
    const double kinetic = observation.motion.kinetic_energy;
    observation.add("kinetic_over_work", work != 0 ? kinetic / std::fabs(work) : 0);
  }

  void summarise(const Model& /*model*/, Summary& summary) const override {
    summary["mass_scaling"] = {
        {"factor", parameters_.factor},
        {"time_step_over_that_of_the_true_mass", std::sqrt(parameters_.factor)}};
  }

 private:
  MassScalingParameters parameters_;
};

std::vector<Key> mass_scaling_keys(MassScalingParameters& p, Reading& /*reading*/) {
  return {must_have("factor", number(p.factor, Range{1, 1e12, false, false}))
              .means("by which the masses and moments of inertia in the equations of motion grow; "
                     "the stable time step grows by its root, weights and heat capacities stay")};
}

/// Elements have their true inertia until then.
void make_heavier(const Setup& setup, Model& model) {
  const double fraction = 1 / setup.get<MassScalingParameters>()->factor;
  for (const Column* inverse : {&columns::inverse_mass, &columns::inverse_inertia})
    if (model.has(*inverse))
      for (std::size_t i = 0; i < model.size(*inverse); ++i) model.data(*inverse)[i] *= fraction;
}

void plan_mass_scaling(const Setup& setup, Plan& plan) {
  const auto& scaling = setup.get<MassScalingParameters>();
  if (!scaling) return;
  plan.effects.push_back(
      {"mass_scaling", "[mass_scaling]", "", Phase::after_move,
       [scaling = *scaling](Assembly&) { return std::make_unique<MassScaling>(scaling); }});
}

}  // namespace

EffectKind mass_scaling_kind() {
  EffectKind kind = single_kind<MassScalingParameters>("mass_scaling", mass_scaling_keys,
                                                       as_read<MassScalingParameters>);
  kind.needs = Provides::motion;
  kind.start = make_heavier;
  kind.plan = plan_mass_scaling;
  kind.example =
      "[mass_scaling]\n"
      "factor = 4\n";
  return kind;
}

}  // namespace solidem
