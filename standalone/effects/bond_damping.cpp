// SPDX-License-Identifier: GPL-2.0-or-later
//
// [damping] bonds: dashpots beside the modes of every beam, laws/bond_damping.hpp. They push in the
// poses and with the velocities of one time: an effect of its own leads the velocities, which stand
// half a step behind, on to each new pose.
#include "effects/bond_damping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "effects/assembly.hpp"
#include "effects/beams.hpp"
#include "effects/bond_slot.hpp"
#include "effects/grips.hpp"
#include "effects/pseudo_random.hpp"
#include "effects/push.hpp"
#include "laws/bond_damping.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

namespace {

constexpr Column motion_at_pose{"motion_at_pose",
                                Site::element,
                                Column::Layout::rows,
                                8,
                                1,
                                true,
                                "m/s, 1/kg, rad/s, 1/(kg m²)",
                                "velocity x y z, inverse mass, angular velocity x y z, inverse "
                                "inertia: led on from the middle of the step to the pose"};
constexpr Column velocity_in_step{"velocity_in_step",
                                  Site::element,
                                  Column::Layout::lanes,
                                  3,
                                  1,
                                  true,
                                  "m/s",
                                  "half a step behind the pose, as far as no grip imposes it"};
constexpr Column angular_velocity_in_step{
    "angular_velocity_in_step",   Site::element, Column::Layout::lanes, 3, 1, true, "rad/s",
    "half a step behind the pose"};
constexpr Column bond_damping_energy{"bond_damping",
                                     Site::element,
                                     Column::Layout::lanes,
                                     1,
                                     1,
                                     true,
                                     "J",
                                     "half of what the dashpots of its bonds took"};

/// Velocities at the times of the poses.
class MotionAtPose : public Effect {
 public:
  MotionAtPose(const std::vector<Grip*>& grips, Model& model) : grips_(grips) {
    double* rows = model.data(motion_at_pose);
    for (std::size_t i = 0; i < model.elements(); ++i) {
      rows[8 * i + 3] = model.data(columns::inverse_mass)[i];
      if (model.has(columns::angular_velocity))
        rows[8 * i + 7] = model.data(columns::inverse_inertia)[i];
    }
    for_each_motion(model, [&](const Column& velocity, const Column& before, std::size_t place) {
      std::copy_n(model.data(velocity), model.size(velocity), model.data(before));
      lead(model, velocity, before, place, 0);
    });
    impose(model, 0);
  }

  void advance(Model& model, const Step& step) override {
    const double weight = lead_to_pose(step.time_step, step.kick);
    for_each_motion(model, [&](const Column& velocity, const Column& before, std::size_t place) {
      lead(model, velocity, before, place, weight);
    });
    impose(model, step.time + step.time_step);
  }

 private:
  template <class Visit>
  static void for_each_motion(Model& model, const Visit& visit) {
    visit(columns::velocity, velocity_in_step, 0);
    if (model.has(columns::angular_velocity))
      visit(columns::angular_velocity, angular_velocity_in_step, 4);
  }

  static void lead(Model& model, const Column& velocity, const Column& before, std::size_t place,
                   double weight) {
    const double* now = model.data(velocity);
    double* last = model.data(before);
    double* led = model.data(motion_at_pose);
    for_blocks(model.slots().blocks(), 40, [&](std::size_t first, std::size_t past) {
      for (std::size_t i = first * lanes; i < past * lanes; ++i)
        for (int axis = 0; axis < 3; ++axis) {
          const std::size_t at = Model::at(velocity, i, axis);
          led[8 * i + place + static_cast<std::size_t>(axis)] =
              now[at] + weight * (now[at] - last[at]);
          last[at] = now[at];
        }
    });
  }

  void impose(Model& model, double time) const {
    double* led = model.data(motion_at_pose);
    for (const Grip* grip : grips_)
      for (int axis = 0; axis < 3; ++axis) {
        if (!grip->imposed(axis)) continue;
        for (const std::int32_t e : grip->elements())
          led[std::ptrdiff_t{8} * e + axis] = grip->imposed_velocity(axis, time);
      }
  }

  std::vector<Grip*> grips_;
};

class BondDamping : public Effect {
 public:
  BondDamping(double critical_ratio, const Beams& beams, Model& model)
      : ratio_(critical_ratio), beams_(beams) {
    const auto dashpots = [this](const BeamRigidity<double>& rigidity, double rest_length,
                                 const BondInertia<double>& inertia) {
      return bond_dashpots(ratio_, rigidity, rest_length, inertia);
    };
    const auto stiffness = [](const BeamRigidity<double>& rigidity, double rest_length,
                              const BondInertia<double>&) {
      return bond_mode_stiffness(rigidity, rest_length);
    };
    shortening_ =
        damping_shortens(largest_rate(model, dashpots), std::sqrt(largest_rate(model, stiffness)));
  }

  void advance(Model& model, const Step& step) override {
    BeamMotion m = beams_.motion(model);
    m.kick = step.kick;
    m.drift = step.time_step;
    const DampedBonds bonds{model.data(motion_at_pose), ratio_, model.data(bond_damping_energy)};
    for_blocks(model.slots().blocks(), 40, [&](std::size_t first, std::size_t last) {
      kernels().damp_bonds(m, bonds, first, last);
    });
  }

  void observe(const Model& model, Observation& observation) const override {
    const BeamMotion m = beams_.motion(const_cast<Model&>(model));  // who looks changes nothing
    double taken = 0;
    for (std::size_t block = 0; block < model.slots().blocks(); ++block) {
      Sum sums[lanes] = {};
      add_block(model, m, block, sums);
      for (int lane = 0; lane < lanes; ++lane) {
        const std::size_t i = block * lanes + static_cast<std::size_t>(lane);
        if (i >= model.elements()) continue;
        taken += model.data(bond_damping_energy)[i] + 0.5 * observation.behind * sums[lane].power;
        observe_push(model, observation, static_cast<std::int32_t>(i), sums[lane].force);
        if (m.has_rotation)
          observe_twist(model, observation, static_cast<std::int32_t>(i), sums[lane].moment);
      }
    }
    observation.energies.add(EnergyLedger::Kind::dissipated, "bond_damping", taken);
  }

  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const override {
    double bound = std::numeric_limits<double>::infinity();
    for (const TimeStepCriterion& criterion : beams_.time_step_criteria(model))
      bound = std::min(bound, criterion.value);
    return {{"damping of the bonds", bound / shortening_}};
  }
  double stiffening() const override { return shortening_; }
  double stiffened() const override { return shortening_; }

 private:
  /// What all dashpots of an element do to it, and the power that they take.
  struct Sum {
    Vector force, moment;
    double power;
  };

  /// A bond as its dashpots see it, from element i.
  struct Seen {
    BeamRigidity<double> rigidity;
    double rest_length;
    Vector chord;
    BondInertia<double> inertia;
  };

  static Seen see(const BeamMotion& m, std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const SlotReader slot{row, lane};
    // A spring has no dashpot against turning, whatever turns.
    return {rigidity_in<double>(m, slot),
            slot.number(m.rest_length),
            ends_in(m.pose, m, slot, i, j).chord,
            {m.inverse_mass[i] + m.inverse_mass[j],
             m.has_rotation ? m.inverse_inertia[i] + m.inverse_inertia[j] : 1.0}};
  }

  /// Motion of two elements by rows of eight, of which the fourth and the eighth are other than
  /// motion.
  static BondMotion<double> motion_of(const double* rows, std::int32_t i, std::int32_t j) {
    const double* a = rows + std::ptrdiff_t{8} * i;
    const double* b = rows + std::ptrdiff_t{8} * j;
    return {{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, {a[4], a[5], a[6]}, {b[4], b[5], b[6]}};
  }

  void add_block(const Model& model, const BeamMotion& m, std::size_t block, Sum* sums) const {
    const double* rows = model.data(motion_at_pose);
    model.slots().for_each_in(
        block, [&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
          const Seen bond = see(m, i, j, row, lane);
          const DashpotAction<double> action =
              bond_damping(bond_dashpots(ratio_, bond.rigidity, bond.rest_length, bond.inertia),
                           bond.chord, motion_of(rows, i, j));
          sums[lane].force += action.load.force;
          sums[lane].moment += action.load.moment_i;
          sums[lane].power += action.power;
        });
  }

  /// The largest eigenvalue of what `factors` of the bonds' modes do to motion, over inertia: the
  /// largest rate of all dashpots, or squared frequency of all springs. By power iteration.
  template <class Factors>
  double largest_rate(const Model& model, const Factors& factors) const {
    constexpr int iterations = 60;
    const BeamMotion m = beams_.motion(const_cast<Model&>(model));
    std::vector<double> shape(8 * model.slots().padded_elements());
    const double radius = mean_radius(model.specimen());
    for (std::size_t k = 0; k < shape.size(); ++k)
      if (k % 4 != 3 && (k % 8 < 4 || m.has_rotation))
        shape[k] = pseudo_random(k) / (k % 8 < 4 ? 1.0 : radius);
    double rate = 0;
    for (int n = 0; n < iterations; ++n) {
      std::vector<double> answer(shape.size());
      double product = 0, square = 0;
      model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
        const Seen bond = see(m, i, j, row, lane);
        const DashpotAction<double> action =
            bond_damping(factors(bond.rigidity, bond.rest_length, bond.inertia), bond.chord,
                         motion_of(shape.data(), i, j));
        product += 0.5 * action.power;
        double* a = &answer[8 * static_cast<std::size_t>(i)];
        for (int axis = 0; axis < 3; ++axis) {
          a[axis] -= m.inverse_mass[i] * component(action.load.force, axis);
          if (m.has_rotation)
            a[4 + axis] -= m.inverse_inertia[i] * component(action.load.moment_i, axis);
        }
      });
      for (std::size_t i = 0; i < model.elements(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          square += shape[8 * i + axis] * shape[8 * i + axis] / m.inverse_mass[i];
          if (m.has_rotation)
            square += shape[8 * i + 4 + axis] * shape[8 * i + 4 + axis] / m.inverse_inertia[i];
        }
      if (!(product > 0)) return 0;
      rate = product / square;
      for (std::size_t k = 0; k < shape.size(); ++k) shape[k] = answer[k] / rate;
    }
    return rate;
  }

  double ratio_;
  const Beams& beams_;
  double shortening_;  ///< of the longest stable step
};

}  // namespace

void plan_bond_damping(double critical_ratio, const Setup& setup, Plan& plan) {
  // Who reports forces of the body, as grips do, comes after; bonds that form in a step are not
  // damped in it.
  const auto after_bonds =
      std::find_if(plan.effects.begin(), plan.effects.end(), [](const PlannedEffect& planned) {
        return planned.phase == Phase::push || planned.phase == Phase::constrain;
      });
  plan.effects.insert(after_bonds, {"bond damping", "[damping]", "", Phase::push,
                                    [critical_ratio](Assembly& assembly) {
                                      return std::make_unique<BondDamping>(
                                          critical_ratio, assembly.need<Beams>(), assembly.model);
                                    }});
  plan.effects.push_back(
      {"motion at the poses", "[damping]", "", Phase::after_move, [](Assembly& assembly) {
         return std::make_unique<MotionAtPose>(assembly.all<Grip>(), assembly.model);
       }});
  plan.ask("bond damping", {&motion_at_pose, &bond_damping_energy});
  plan.ask("motion at the poses", {&motion_at_pose, &velocity_in_step});
  if (demands_of(setup).has_rotation())
    plan.ask("motion at the poses", {&angular_velocity_in_step});
}

}  // namespace solidem
