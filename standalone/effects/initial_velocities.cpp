// SPDX-License-Identifier: GPL-2.0-or-later
//
// [[initial_velocities]]: what moves when a run begins. Nothing acts in its steps.
#include "effects/initial_velocities.hpp"
#include "effects/effect_kind.hpp"
#include "effects/selections.hpp"
#include "keys/rules.hpp"

namespace solidem {

namespace {

std::vector<Key> initial_velocity_keys(InitialVelocity& p, Reading& reading) {
  return {must_have("region", region(p.region, reading.regions)),
          may_have("velocity", vector(p.velocity, dimension::velocity)).without("zero"),
          may_have("stretching", vector(p.stretching, dimension::rate))
              .means("besides, along x, y, z as far as from the middle of the body")
              .without("zero")};
}

void finish_initial_velocity(const Section& section, InitialVelocity& /*p*/, Reading& /*reading*/) {
  if (!section.has("velocity") && !section.has("stretching"))
    section.refuse("nothing says how the elements move", "velocity or stretching, or both");
}

void set_velocity(Model& model, std::size_t i, int axis, double v) {
  model.data(columns::velocity)[Model::at(columns::velocity, i, axis)] = v;
  if (model.neighbours_feel_velocity()) model.felt_velocities()[i][axis] = v;
}

void start_moving(const Setup& setup, Model& model) {
  const Domain& domain = model.specimen().domain;
  std::size_t number = 0;
  for (const InitialVelocity& initial : setup.all<InitialVelocity>()) {
    const std::string owner = "[[initial_velocities]] " + std::to_string(++number);
    for (const std::int32_t e : select_some(owner, initial.region, model.specimen())) {
      const auto i = static_cast<std::size_t>(e);
      const Vector from_middle = model.specimen().position[i] - 0.5 * (domain.lower + domain.upper);
      for (int axis = 0; axis < 3; ++axis)
        set_velocity(model, i, axis,
                     component(initial.velocity, axis) +
                         component(initial.stretching, axis) * component(from_middle, axis));
    }
  }
}

}  // namespace

EffectKind initial_velocities_kind() {
  EffectKind kind = list_kind<InitialVelocity>("initial_velocities", initial_velocity_keys,
                                               finish_initial_velocity);
  kind.needs = Provides::motion;
  kind.start = start_moving;
  kind.example =
      "[[initial_velocities]]\n"
      "region = { all = true }\n"
      "stretching = [\"-40000 1/s\", \"40000 1/s\", \"0 1/s\"]\n";
  return kind;
}

}  // namespace solidem
