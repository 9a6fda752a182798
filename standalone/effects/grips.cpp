// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/grips.hpp"

#include <algorithm>
#include <optional>

#include "effects/assembly.hpp"
#include "effects/effect_kind.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/push.hpp"
#include "effects/removed_elements.hpp"
#include "effects/turning_grip.hpp"
#include "keys/rules.hpp"
#include "model/axis_names.hpp"

namespace solidem {

Grip::Grip(const GripParameters& parameters, std::vector<std::int32_t> elements, Model& model)
    : parameters_(parameters), elements_(std::move(elements)) {
  for (const std::int32_t e : elements_) {
    const auto i = static_cast<std::size_t>(e);
    rest_.push_back(model.specimen().position[i]);
    mass_.push_back(1 / model.data(columns::inverse_mass)[i]);
    double* velocity = model.data(columns::velocity);
    for (int axis = 0; axis < 3; ++axis)
      if (imposed(axis)) velocity[Model::at(columns::velocity, i, axis)] = 0;
  }
  if (applies_force()) remember(model, 0);
  if (!model.neighbours_feel_velocity()) return;
  const auto felt = model.felt_velocities();
  for (const std::int32_t e : elements_)
    for (int axis = 0; axis < 3; ++axis)
      if (imposed(axis)) felt[static_cast<std::size_t>(e)][axis] = imposed_velocity(axis, 0);
}

bool Grip::imposed(int axis) const {
  const auto kind = parameters_.axis[static_cast<std::size_t>(axis)].kind;
  return kind == AxisControl::Kind::displacement || kind == AxisControl::Kind::velocity;
}

double Grip::imposed_displacement(int axis, double time) const {
  const AxisControl& control = parameters_.axis[static_cast<std::size_t>(axis)];
  if (control.kind == AxisControl::Kind::displacement) return control.function(time);
  if (control.kind == AxisControl::Kind::velocity) return control.function.integral(time);
  return 0;
}

double Grip::imposed_velocity(int axis, double time) const {
  const AxisControl& control = parameters_.axis[static_cast<std::size_t>(axis)];
  return control.kind == AxisControl::Kind::velocity ? control.function(time)
                                                     : control.function.rate(time);
}

bool Grip::applies_force() const {
  return std::any_of(
      parameters_.axis.begin(), parameters_.axis.end(),
      [](const AxisControl& control) { return control.kind == AxisControl::Kind::force; });
}

void Grip::remember(const Model& model, double time) {
  last_position_.resize(elements_.size());
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const double* now = model.positions()[static_cast<std::size_t>(elements_[k])];
    last_position_[k] = {now[0], now[1], now[2]};
  }
  last_time_ = time;
}

double Grip::force_work(const Model& model, double time) const {
  const PresentElements is_present(model);
  const double total_mass = present_mass(model);
  double work = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const AxisControl& control = parameters_.axis[static_cast<std::size_t>(axis)];
    if (control.kind != AxisControl::Kind::force) continue;
    const double mean_force = 0.5 * (control.function(last_time_) + control.function(time));
    for (std::size_t k = 0; k < last_position_.size(); ++k) {
      if (!is_present(elements_[k])) continue;
      const double now = model.positions()[static_cast<std::size_t>(elements_[k])][axis];
      work += mean_force * mass_[k] / total_mass * (now - component(last_position_[k], axis));
    }
  }
  return work;
}

double Grip::present_mass(const Model& model) const {
  const PresentElements is_present(model);
  double sum = 0;
  for (std::size_t k = 0; k < elements_.size(); ++k)
    if (is_present(elements_[k])) sum += mass_[k];
  return sum;
}

void Grip::advance(Model& model, const Step& step) {
  const PresentElements is_present(model);
  double* velocity = model.data(columns::velocity);
  const auto positions = model.positions(), next = model.next_positions();
  if (applies_force()) {
    work_ += force_work(model, step.time);
    remember(model, step.time);
  }
  const double after = step.time + step.time_step;
  std::optional<Model::Rows<double>> felt;
  if (model.neighbours_feel_velocity()) felt = model.next_felt_velocities();
  for (int axis = 0; axis < 3; ++axis) {
    const AxisControl& control = parameters_.axis[static_cast<std::size_t>(axis)];
    if (imposed(axis)) {
      const double place = imposed_displacement(axis, after);
      // At the start elements are at rest, wherever the displacement begins.
      const double before = step.time > 0 ? imposed_displacement(axis, step.time) : 0;
      const double moved = place - before;
      double bond_force = 0;
      for (std::size_t k = 0; k < elements_.size(); ++k) {
        if (!is_present(elements_[k])) continue;
        const auto i = static_cast<std::size_t>(elements_[k]);
        double& v = velocity[Model::at(columns::velocity, i, axis)];
        bond_force += v * mass_[k];
        v = 0;
        next[i][axis] = component(rest_[k], axis) + place;
        if (felt) (*felt)[i][axis] = moved / step.time_step;
      }
      double& last = last_displacement_[static_cast<std::size_t>(axis)];
      work_ -= bond_force / step.kick * 0.5 * (last + moved);
      last = moved;
    } else if (control.kind == AxisControl::Kind::force) {
      const double force = control.function(step.time), total_mass = present_mass(model);
      const double gain = force / total_mass * step.kick;
      const Pushes pushes(model, step);
      for (std::size_t k = 0; k < elements_.size(); ++k) {
        if (!is_present(elements_[k])) continue;
        pushes.kick(static_cast<std::size_t>(elements_[k]), axis, gain);
      }
    }
  }
  if (!parameters_.rotation_fixed || !model.has(columns::angular_velocity)) return;
  double* spin = model.data(columns::angular_velocity);
  for (const std::int32_t e : elements_) {
    const auto i = static_cast<std::size_t>(e);
    for (int axis = 0; axis < 3; ++axis) spin[Model::at(columns::angular_velocity, i, axis)] = 0;
    std::copy_n(positions[i] + 4, 4, next[i] + 4);
  }
}

void Grip::observe(const Model& model, Observation& observation) const {
  Vector bond_force{};
  for (const std::int32_t e : elements_)
    bond_force += observation.motion.force[static_cast<std::size_t>(e)];
  double work = work_ + force_work(model, observation.time);
  Vector grip_force{};
  for (int axis = 0; axis < 3; ++axis) {
    const AxisControl& control = parameters_.axis[static_cast<std::size_t>(axis)];
    if (imposed(axis)) {
      component(grip_force, axis) = -component(bond_force, axis);
      work -=
          component(bond_force, axis) * 0.5 * last_displacement_[static_cast<std::size_t>(axis)];
    } else if (control.kind == AxisControl::Kind::force) {
      component(grip_force, axis) = control.function(observation.time);
    }
  }
  observation.energies.add(EnergyLedger::Kind::input, "external_work", work);
  correct_motion(model, grip_force, observation);
  for (int axis = 0; axis < 3; ++axis)
    observation.add("grip." + parameters_.name + ".force_" + axis_names[axis],
                    component(grip_force, axis));
  for (int axis = 0; axis < 3; ++axis)
    if (imposed(axis))
      observation.add("grip." + parameters_.name + ".displacement_" + axis_names[axis],
                      imposed_displacement(axis, observation.time));
}

void Grip::correct_motion(const Model& model, const Vector& grip_force,
                          Observation& observation) const {
  const bool held = parameters_.rotation_fixed && model.has(columns::angular_velocity);
  const double total_mass = present_mass(model);
  ObservedMotion& motion = observation.motion;
  const PresentElements is_present(model);
  double& energy = motion.kinetic_energy;
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    if (!is_present(elements_[k])) continue;
    const auto i = static_cast<std::size_t>(elements_[k]);
    for (int axis = 0; axis < 3; ++axis) {
      double& v = component(motion.velocity[i], axis);
      Vector alone{}, in_all{};
      component(alone, axis) = component(motion.force[i], axis);
      energy -= 0.5 * mass_[k] * v * v;
      if (imposed(axis)) {
        v = imposed_velocity(axis, observation.time);
      } else {
        const double acceleration = component(grip_force, axis) / total_mass;
        component(in_all, axis) = component(alone, axis) + mass_[k] * acceleration;
        v += acceleration * observation.behind;
        energy += 0.5 * mass_[k] * v * v;
      }
      motion.add_impulse(alone, in_all, 1 / mass_[k]);
    }
    if (!held) continue;
    Vector& spin = motion.angular_velocity[i];
    const double inverse_inertia = model.data(columns::inverse_inertia)[i];
    energy -= 0.5 * dot(spin, spin) / inverse_inertia;
    motion.add_impulse(motion.moment[i], {}, inverse_inertia);
    spin = {};
  }
}

void Grip::state(Archive& archive) {
  archive(work_, last_displacement_, last_position_, last_time_);
}

namespace {

/// What one of displacement, velocity and force imposes along x, y and z.
Rule controls(std::array<AxisControl, 3>& axes, AxisControl::Kind kind,
              const Dimension& dimension) {
  const std::string expected = describe(dimension, anything) + ", a function of time, or \"free\"";
  return triple(expected, [&axes, kind, dimension, expected](const Value& entry, int k) {
    const toml::node& node = entry.node();
    if (node.is_string() && node.as_string()->get() == "free") return;
    AxisControl& control = axes[static_cast<std::size_t>(k)];
    if (control.kind != AxisControl::Kind::free)
      entry.refuse(std::string("the grip is controlled twice along ") + "xyz"[k],
                   "\"free\" in all but one of displacement, velocity and force");
    control = {kind, read_function(entry, dimension, anything)};
  });
}

/// A grip as it is read, whether it turns or not.
struct ReadGrip {
  GripParameters grip;
  GripTurn turn;
  TimeFunction angle, angular_velocity, torque;
};

std::vector<Key> grip_keys(ReadGrip& p, Reading& reading) {
  using Kind = AxisControl::Kind;
  return {
      must_have("name", name(p.grip.name, reading.taken)).means("names the columns `grip.NAME.…`"),
      must_have("region", region(p.grip.region, reading.regions)),
      may_have("displacement", controls(p.grip.axis, Kind::displacement, dimension::length))
          .without("free"),
      may_have("velocity", controls(p.grip.axis, Kind::velocity, dimension::velocity))
          .without("free"),
      may_have("force", controls(p.grip.axis, Kind::force, dimension::force))
          .means("for the whole grip")
          .without("free"),
      may_have("rotation", choice<bool>(p.grip.rotation_fixed, {{"fixed", true}, {"free", false}}))
          .means("of each element: as the grip turns, or as its bonds turn it"),
      may_have("angle", function(p.angle, dimension::angle))
          .means("by which the grip turns as a whole")
          .without("it does not turn"),
      may_have("angular_velocity", function(p.angular_velocity, dimension::angular_velocity))
          .without("or this"),
      may_have("torque", function(p.torque, dimension::torque))
          .means("that turns the grip against its bonds and its inertia")
          .without("or this"),
      may_have("rotation_axis", direction(p.turn.axis)).without("needed with these"),
      may_have("rotation_point", vector(p.turn.point, dimension::length))
          .means("of that axis, at the start: it goes where the grip goes")
          .without("zero")};
}

bool is_controlled(const AxisControl& control) {
  return control.kind != AxisControl::Kind::free;
}

/// A grip that turns is held along all axes along which nothing else is said.
void finish_turn(const Section& section, ReadGrip& p) {
  if (!section.has("rotation_axis"))
    section.refuse("\"rotation_axis\" is missing", "the axis about which the grip turns");
  if (!p.grip.rotation_fixed)
    section.refuse("rotation", "the elements of a grip that turns turn with it",
                   "no rotation = \"free\" beside angle, angular_velocity or torque");
  for (AxisControl& control : p.grip.axis) {
    if (control.kind == AxisControl::Kind::force)
      section.refuse("force", "a grip that turns does not go where a force pushes it",
                     "displacement or velocity beside angle, angular_velocity or torque");
    if (control.kind == AxisControl::Kind::free)
      control = {AxisControl::Kind::displacement, TimeFunction::constant(0)};
  }
  using Kind = GripTurn::Kind;
  p.turn.kind = section.has("angle")    ? Kind::angle
                : section.has("torque") ? Kind::torque
                                        : Kind::angular_velocity;
  p.turn.function = section.has("angle")    ? p.angle
                    : section.has("torque") ? p.torque
                                            : p.angular_velocity;
}

void read_grip(const Section& section, Reading& reading) {
  ReadGrip p;
  section.read(grip_keys(p, reading));
  section.at_most_one_of({"angle", "angular_velocity", "torque"});
  if (section.has("angle") || section.has("angular_velocity") || section.has("torque")) {
    finish_turn(section, p);
    reading.setup.all<TurningGripParameters>().push_back({p.grip, p.turn});
    return;
  }
  for (const char* key : {"rotation_axis", "rotation_point"})
    if (section.has(key))
      section.refuse(key, "the grip does not turn", "angle, angular_velocity or torque beside it");
  if (std::none_of(p.grip.axis.begin(), p.grip.axis.end(), is_controlled) && !p.grip.rotation_fixed)
    section.refuse("the grip does nothing",
                   "a displacement, velocity or force, or rotation = \"fixed\"");
  reading.setup.all<GripParameters>().push_back(p.grip);
}

std::vector<std::int32_t> held_by(const GripParameters& grip, Assembly& assembly) {
  std::vector<std::int32_t> elements =
      select_some("[[grips]] \"" + grip.name + "\"", grip.region, assembly.specimen());
  assembly.selections["grip." + grip.name] = elements;
  assembly.claim("[[grips]]", grip.name, elements);
  if (std::any_of(grip.axis.begin(), grip.axis.end(), is_controlled))
    assembly.model.note_driven(elements);
  return elements;
}

void plan_grips(const Setup& setup, Plan& plan) {
  for (const GripParameters& grip : setup.all<GripParameters>())
    plan.effects.push_back(
        {"grip " + grip.name, "[[grips]]", "", Phase::constrain, [grip](Assembly& assembly) {
           return std::make_unique<Grip>(grip, held_by(grip, assembly), assembly.model);
         }});
  for (const TurningGripParameters& turning : setup.all<TurningGripParameters>())
    plan.effects.push_back({"grip " + turning.grip.name, "[[grips]]", "", Phase::constrain,
                            [turning](Assembly& assembly) {
                              return std::make_unique<TurningGrip>(
                                  turning, held_by(turning.grip, assembly), assembly.model);
                            }});
}

}  // namespace

EffectKind grips_kind() {
  EffectKind kind = kind_with_keys<ReadGrip>("grips", grip_keys);
  kind.is_list = true;
  kind.is_named = [](const Setup& setup) {
    return !setup.all<GripParameters>().empty() || !setup.all<TurningGripParameters>().empty();
  };
  kind.read = [](const Value& value, Reading& reading) {
    tables([&](const Section& section) { read_grip(section, reading); }).read(value);
  };
  kind.needs = Provides::motion;
  kind.plan = plan_grips;
  kind.example =
      "[[grips]]\n"
      "name = \"left\"\n"
      "region = { axis = \"x\", side = \"low\", layers = 1 }\n"
      "velocity = [\"0 m/s\", \"0 m/s\", \"0 m/s\"]\n"
      "\n"
      "[[grips]]\n"
      "name = \"right\"\n"
      "region = { axis = \"x\", side = \"high\", layers = 1 }\n"
      "velocity = [{ time = [\"0 us\", \"1 us\"], value = [\"0 m/s\", \"-50 m/s\"] }, \"free\", "
      "\"free\"]\n";
  return kind;
}

}  // namespace solidem
