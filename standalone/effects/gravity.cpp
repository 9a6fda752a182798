// SPDX-License-Identifier: GPL-2.0-or-later
//
// [gravity]: a uniform field that pulls on all elements.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "effects/assembly.hpp"
#include "effects/effect_kind.hpp"
#include "effects/push.hpp"
#include "keys/rules.hpp"
#include "model/blocks.hpp"

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
    const Pushes pushes(model, step);
    for_elements(model, [&](std::size_t i) { pushes.push(i, mass_[i] * acceleration_); });
  }

  void observe(const Model& model, Observation& observation) const override {
    for (std::size_t i = 0; i < mass_.size(); ++i)
      observe_push(model, observation, static_cast<std::int32_t>(i), mass_[i] * acceleration_);
    observation.energies.add(EnergyLedger::Kind::input, "gravity_work", work(model));
  }

  /// It depends on where elements are and not on how they came there.
  double work(const Model& model) const override {
    const std::vector<Vector>& start = model.specimen().position;
    const auto positions = model.positions();
    std::vector<double> of_block(model.slots().blocks(), 0.0);
    for_elements(model, [&](std::size_t i) {
      const Vector now{positions[i][0], positions[i][1], positions[i][2]};
      of_block[i / lanes] += mass_[i] * dot(acceleration_, now - start[i]);
    });
    return std::accumulate(of_block.begin(), of_block.end(), 0.0);
  }

  void summarise(const Model& model, Summary& summary) const override {
    summary["gravity_work"] = work(model);
  }

 private:
  /// act(element) of each, on all threads.
  template <class Act>
  void for_elements(const Model& model, const Act& act) const {
    for_blocks(model.slots().blocks(), 40, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first * lanes; i < std::min(last * lanes, mass_.size()); ++i) act(i);
    });
  }

  Vector acceleration_;
  std::vector<double> mass_;  ///< of each element, kg
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
