// SPDX-License-Identifier: GPL-2.0-or-later
//
// [damping]: viscous damping, and Cundall's local damping, of all that moves freely:
// laws/damping.hpp. It acts last in a step, when all forces are known and grips have taken the
// motion that they impose out of the velocities, which so stays undamped. Damping of bonds is
// effects/bond_damping.cpp.
//
// Viscous damping is exact over half a step before elements move and half a step after: second
// order in the step, and stable at any step and rate.
#include "laws/damping.hpp"
#include "effects/beam_parameters.hpp"

#include <algorithm>
#include <memory>

#include "effects/assembly.hpp"
#include "effects/bond_damping.hpp"
#include "effects/effect_kind.hpp"
#include "effects/grips.hpp"
#include "effects/kernels/kernels.hpp"
#include "effects/turning_grip.hpp"
#include "keys/rules.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

namespace {

constexpr Column viscous_damping{"viscous_damping",
                                 Site::element,
                                 Column::Layout::lanes,
                                 1,
                                 1,
                                 true,
                                 "J",
                                 "energy that viscous damping took from it"};
constexpr Column local_damping_energy{"local_damping",
                                      Site::element,
                                      Column::Layout::lanes,
                                      1,
                                      1,
                                      true,
                                      "J",
                                      "energy that local damping took from it"};
constexpr Column velocity_before{
    "velocity_before", Site::element, Column::Layout::lanes, 3, 1, true, "m/s", "a step before"};
constexpr Column angular_velocity_before{"angular_velocity_before",
                                         Site::element,
                                         Column::Layout::lanes,
                                         3,
                                         1,
                                         true,
                                         "rad/s",
                                         "a step before"};

struct DampingParameters {
  std::optional<double> viscous;  ///< c, 1/s
  std::optional<double> local;    ///< α
  std::optional<double> bonds;    ///< ζ
};

/// Columns of velocities, or of angular velocities, of their inertia, and of what damping remembers
/// of them.
struct MotionColumns {
  const Column* velocity;
  const Column* before;
  const Column* inverse_inertia;
};

constexpr MotionColumns translation{&columns::velocity, &velocity_before, &columns::inverse_mass};
constexpr MotionColumns rotation{&columns::angular_velocity, &angular_velocity_before,
                                 &columns::inverse_inertia};

class Damping : public Effect {
 public:
  Damping(const DampingParameters& parameters, const std::vector<Grip*>& grips, Model& model)
      : parameters_(parameters), motions_{translation} {
    if (model.has(columns::angular_velocity)) motions_.push_back(rotation);
    if (!parameters_.local) return;
    for (const MotionColumns& motion : motions_)
      std::copy_n(model.data(*motion.velocity), model.size(*motion.velocity),
                  model.data(*motion.before));
    note_imposed(grips, model.elements());
  }

  void advance(Model& model, const Step& step) override {
    DampedElements damped{};
    damped.translation = columns_of(model, translation);
    if (motions_.size() > 1) damped.rotation = columns_of(model, rotation);
    damped.inverse_mass = model.data(columns::inverse_mass);
    damped.pose = model.positions().first;
    damped.next_position = model.next_positions().first;
    damped.row_length = model.positions().components;
    damped.velocity_is_felt = model.neighbours_feel_velocity();
    damped.time_step = step.time_step;
    damped.left = viscous_decay(parameters_.viscous.value_or(0), 0.5 * step.time_step);
    damped.local = parameters_.local.value_or(0);
    for_blocks(model.slots().blocks(), least_blocks_moving,
               [&](std::size_t first, std::size_t last) { kernels().damp(damped, first, last); });
  }

  void observe(const Model& model, Observation& observation) const override {
    double viscous = 0, local = 0;
    for (std::size_t i = 0; i < model.elements(); ++i) {
      if (parameters_.viscous) viscous += model.data(viscous_damping)[i];
      if (!parameters_.local) continue;
      local += model.data(local_damping_energy)[i];
      if (!(model.data(columns::inverse_mass)[i] > 0)) continue;
      for (std::size_t k = 0; k < motions_.size(); ++k)
        local += observe_local(model, observation.motion, k, i);
    }
    using Kind = EnergyLedger::Kind;
    if (parameters_.viscous) observation.energies.add(Kind::dissipated, "viscous_damping", viscous);
    if (parameters_.local) observation.energies.add(Kind::dissipated, "local_damping", local);
  }

 private:
  /// Along which axes, in turning too, grips say how elements move.
  void note_imposed(const std::vector<Grip*>& grips, std::size_t elements) {
    imposed_.assign(motions_.size(), std::vector<char>(3 * elements, 0));
    for (const Grip* grip : grips)
      for (const std::int32_t element : grip->elements())
        for (int axis = 0; axis < 3; ++axis) {
          const auto at = 3 * static_cast<std::size_t>(element) + static_cast<std::size_t>(axis);
          imposed_[0][at] = grip->imposed(axis) ? 1 : 0;
          if (motions_.size() > 1) imposed_[1][at] = grip->holds_rotation() ? 1 : 0;
        }
  }

  /// The columns of a motion, as a step finds them.
  static DampedMotion columns_of(Model& model, const MotionColumns& motion) {
    const auto find = [&](const Column& column) {
      return model.has(column) ? model.data(column) : nullptr;
    };
    return {model.data(*motion.velocity), find(*motion.before), model.data(*motion.inverse_inertia),
            find(viscous_damping), find(local_damping_energy)};
  }

  /// Brings an observed velocity to what local damping leaves of it at the time of the pose; the
  /// energy taken since the last kick, J.
  double observe_local(const Model& model, ObservedMotion& observed, std::size_t kind,
                       std::size_t i) const {
    const MotionColumns& motion = motions_[kind];
    const double inertia = 1 / model.data(*motion.inverse_inertia)[i];
    const Vector before =
        lanes_vector(model.data(*motion.velocity), Model::at(*motion.velocity, i));
    Vector& velocity = kind == 0 ? observed.velocity[i] : observed.angular_velocity[i];
    double taken = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (imposed_[kind][3 * i + static_cast<std::size_t>(axis)] != 0) continue;
      const double start = component(before, axis), free = component(velocity, axis);
      const double damped = free + local_damping(*parameters_.local, start, free);
      taken -= 0.5 * inertia * (damped - free) * (start + damped);
      observed.kinetic_energy += 0.5 * inertia * (damped * damped - free * free);
      component(velocity, axis) = damped;
    }
    return taken;
  }

  DampingParameters parameters_;
  std::vector<MotionColumns> motions_;      ///< translation, and rotation where there is any
  std::vector<std::vector<char>> imposed_;  ///< for each motion: axes of elements, 1 where imposed
};

std::vector<Key> damping_keys(DampingParameters& p, Reading& /*reading*/) {
  return {may_have("viscous", quantity(p.viscous, dimension::rate, positive))
              .means("c of the force −c m v and the moment −c I ω on each element")
              .without("none"),
          may_have("local", number(p.local, Range{0, 1, false, false}))
              .means("Cundall's α: of the sum of all other forces on an element, along each axis, "
                     "this fraction acts against its velocity; moments alike")
              .without("none"),
          may_have("bonds", number(p.bonds, positive))
              .means("critical ratio ζ of dashpots beside the tension, shear, bending and twist of "
                     "each beam; the stable step is shorter by about √(1 + 4ζ²) + 2ζ")
              .without("none")};
}

void finish_damping(const Section& section, DampingParameters& p, Reading& reading) {
  if (!p.viscous && !p.local && !p.bonds)
    section.refuse("nothing is damped", "viscous, local or bonds");
  if (p.bonds && !reading.setup.get<BeamParameters>())
    section.refuse("bonds", "there are no beams to be damped", "a section [beams]");
  if (p.bonds && !reading.setup.all<TurningGripParameters>().empty())
    section.refuse("bonds", "dashpots do not follow grips that turn",
                   "no bonds here, or grips that do not turn");
}

void plan_damping(const Setup& setup, Plan& plan) {
  const auto& damping = setup.get<DampingParameters>();
  if (!damping) return;
  if (damping->bonds) plan_bond_damping(*damping->bonds, setup, plan);
  if (!damping->viscous && !damping->local) return;
  plan.effects.push_back(
      {"damping", "[damping]", "", Phase::constrain, [damping = *damping](Assembly& assembly) {
         return std::make_unique<Damping>(damping, assembly.all<Grip>(), assembly.model);
       }});
  if (damping->viscous) plan.ask("damping", {&viscous_damping});
  if (!damping->local) return;
  plan.ask("damping", {&local_damping_energy, &velocity_before});
  if (plan.has(columns::angular_velocity)) plan.ask("damping", {&angular_velocity_before});
}

}  // namespace

EffectKind damping_kind() {
  EffectKind kind = single_kind<DampingParameters>("damping", damping_keys, finish_damping);
  kind.needs = Provides::motion;
  kind.plan = plan_damping;
  kind.example =
      "[damping]\n"
      "viscous = \"1e4 1/s\"\n"
      "local = 0.1\n";
  return kind;
}

}  // namespace solidem
