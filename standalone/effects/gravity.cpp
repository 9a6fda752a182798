// SPDX-License-Identifier: GPL-2.0-or-later
//
// [gravity]: a uniform field that pulls on all elements.
#include <memory>
#include <nlohmann/json.hpp>

#include "effects/assembly.hpp"
#include "effects/effect_kind.hpp"
#include "effects/push.hpp"
#include "keys/rules.hpp"

namespace solidem {

namespace {

struct GravityParameters {
  Vector acceleration{};  ///< m/s²
};

class Gravity : public Effect {
 public:
  Gravity(const GravityParameters& parameters, const std::vector<double>& mass)
      : acceleration_(parameters.acceleration), mass_(mass) {}

  void advance(Model& model, const Step& step) override {
    for (std::size_t i = 0; i < mass_.size(); ++i)
      push(model, step, static_cast<std::int32_t>(i), mass_[i] * acceleration_);
    work_ = work_on(model, model.next_positions());
  }

  void observe(const Model& model, Observation& observation) const override {
    for (std::size_t i = 0; i < mass_.size(); ++i)
      observe_push(model, observation, static_cast<std::int32_t>(i), mass_[i] * acceleration_);
    observation.energies.add(EnergyLedger::Kind::input, "gravity_work",
                             work_on(model, model.positions()));
  }

  double work() const override { return work_; }
  void state(Archive& archive) override { archive(work_); }
  void summarise(const Model& model, Summary& summary) const override {
    summary["gravity_work"] = work_on(model, model.positions());
  }

 private:
  /// Since the start, J: it depends on where elements are and not on how they came there.
  template <class Positions>
  double work_on(const Model& model, const Positions& positions) const {
    const std::vector<Vector>& start = model.specimen().position;
    double sum = 0;
    for (std::size_t i = 0; i < mass_.size(); ++i) {
      const Vector now{positions[i][0], positions[i][1], positions[i][2]};
      sum += mass_[i] * dot(acceleration_, now - start[i]);
    }
    return sum;
  }

  Vector acceleration_;
  std::vector<double> mass_;  ///< of each element, kg
  double work_ = 0;           ///< up to the end of the step, J
};

std::vector<Key> gravity_keys(GravityParameters& p, Reading& /*reading*/) {
  return {must_have("acceleration", vector(p.acceleration, dimension::acceleration))
              .means("of free fall, along x, y and z")};
}

void plan_gravity(const Setup& setup, Plan& plan) {
  const auto& gravity = setup.get<GravityParameters>();
  if (!gravity) return;
  plan.effects.push_back(
      {"gravity", "[gravity]", "", Phase::push, [gravity = *gravity](Assembly& assembly) {
         return std::make_unique<Gravity>(gravity, assembly.mass);
       }});
}

}  // namespace

EffectKind gravity_kind() {
  EffectKind kind =
      single_kind<GravityParameters>("gravity", gravity_keys, as_read<GravityParameters>);
  kind.needs = Provides::motion;
  kind.plan = plan_gravity;
  kind.example =
      "[gravity]\n"
      "acceleration = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]\n";
  return kind;
}

}  // namespace solidem
