// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_EFFECT_HPP
#define SOLIDEM_EFFECTS_EFFECT_HPP

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "model/archive.hpp"
#include "model/blocks.hpp"
#include "model/model.hpp"

namespace solidem {

/// The summary of a run, as it is written.
using Summary = nlohmann::ordered_json;

/// One time step, from `time` to `time + time_step`.
/// Velocities stand half a step behind the poses, except at the start, where both stand at time 0:
/// the first kick is half a step long.
struct Step {
  double time;       ///< s, of the poses before the step
  double time_step;  ///< s
  double kick;       ///< s, by which velocities move on: time_step, or half of it at the start
};

/// Where energy is, and where it went, at one instant: each account is a name and an energy, J. An
/// energy that two effects report under one name is one.
class EnergyLedger {
 public:
  enum class Kind {
    stored,      ///< may come back: elastic energy
    dissipated,  ///< since the start: plastic work
    input        ///< work done on the body from outside since the start
  };

  void add(Kind kind, const std::string& name, double energy);
  /// The energy under a name; 0 where nobody reports it.
  double of(const std::string& name) const;
  /// All that is stored.
  double stored() const { return sum(Kind::stored); }
  /// All that was dissipated.
  double dissipated() const { return sum(Kind::dissipated); }
  /// Calls visit(kind, name, energy): all that is stored, then dissipated, then put in.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Kind kind : {Kind::stored, Kind::dissipated, Kind::input})
      for (const Account& account : accounts_)
        if (account.kind == kind) visit(kind, account.name, account.energy);
  }

 private:
  struct Account {
    Kind kind;
    std::string name;
    double energy;
  };
  double sum(Kind kind) const;

  std::vector<Account> accounts_;
};

/// Elements in motion at one instant, velocities brought to the time of the poses.
struct ObservedMotion {
  std::vector<Vector> force;             ///< of its neighbours on each element, N
  std::vector<Vector> moment;            ///< N·m
  std::vector<Vector> velocity;          ///< m/s
  std::vector<Vector> angular_velocity;  ///< rad/s
  double kinetic_energy = 0;             ///< of the motion that no grip imposes, J
  double squared_impulse = 0;  ///< Σ ½ F²/m + ½ M²/J of the same, J/s²: times the square of
                               ///< half a step, what half a kick makes of kinetic energy

  /// Enters a force (or a moment) on something of this inverse mass (or inertia) beside another.
  void add_impulse(const Vector& before, const Vector& after, double inverse_mass) {
    squared_impulse += 0.5 * inverse_mass * (dot(after, after) - dot(before, before));
  }
};

/// Heat at one instant.
struct ObservedHeat {
  double thermal_energy = 0;  ///< Σ C_i (T_i − initial temperature), J
  double heat_input = 0;      ///< through imposed temperatures since the start, J
};

/// A look at the state between two steps, passed from effect to effect; each adds what it knows.
struct Observation {
  double time = 0;    ///< s, of the poses
  double behind = 0;  ///< s, by which the velocities are behind the poses
  ObservedMotion motion;
  EnergyLedger energies;  ///< of the motion, besides the kinetic energy
  ObservedHeat heat;
  std::vector<std::pair<std::string, double>> values;  ///< further columns of the history

  void add(std::string name, double value) { values.emplace_back(std::move(name), value); }
};

/// What a frame of the trajectory shows besides where elements are.
class Frame {
 public:
  struct Field {
    std::string name;
    std::vector<double> values;
    bool of_bonds;
  };
  /// A surface beside the elements, such as a tool's: it moves and keeps its facets.
  struct Surface {
    std::string name;
    std::vector<Vector> vertices;                     ///< where they are, m
    std::vector<std::array<std::int32_t, 3>> facets;  ///< the same in each frame
  };
  /// `bonds`: those that frames draw, in their order: the bonds of the start.
  explicit Frame(const std::vector<Pair>& bonds) : bonds_(bonds) {}

  const std::vector<Pair>& bonds() const { return bonds_; }
  const std::vector<Field>& fields() const { return fields_; }
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  void add(Surface surface) { surfaces_.push_back(std::move(surface)); }
  /// One value for each element.
  void add(const std::string& name, std::vector<double> values) {
    fields_.push_back({name, std::move(values), false});
  }
  /// One value for each bond.
  void add_of_bonds(const std::string& name, std::vector<double> values) {
    fields_.push_back({name, std::move(values), true});
  }

 private:
  const std::vector<Pair>& bonds_;
  std::vector<Field> fields_;
  std::vector<Surface> surfaces_;
};

/// When in a step an effect acts, in this order.
enum class Phase {
  move,          ///< forces between elements, and the motion under them
  change_pairs,  ///< bonds break, after the step that found them broken
  push,          ///< further forces, on elements that have moved: effects/push.hpp
  constrain,     ///< what is imposed on the motion; then the new poses hold
  after_move,    ///< looks at the new poses
  heat           ///< temperatures
};

/// A bound on the time step, and what sets it.
struct TimeStepCriterion {
  std::string name;
  double value;  ///< s
};

/// Something that looks at the state and reports.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void observe(const Model& model, Observation& observation) const = 0;
};

/// Something that acts on the state in each step. An effect exists only when the scene names it.
class Effect : public Observer {
 public:
  virtual void advance(Model& model, const Step& step) = 0;
  void observe(const Model& /*model*/, Observation& /*observation*/) const override {}

  /// Makes ready for a run of so long, s. Throws InputError where that makes no sense.
  virtual void start(const Model& /*model*/, double /*duration*/) {}

  /// Bounds on the time step that it brings, besides those of the forces between elements.
  virtual std::vector<TimeStepCriterion> time_step_criteria(const Model& /*model*/) const {
    return {};
  }
  /// Largest squared frequency that the springs it adds may have by themselves, 1/s²: added to that
  /// of the forces between elements, it bounds the frequencies of both together.
  virtual double added_squared_frequency() const { return 0; }
  /// By how much stiffness may grow in the run beyond that of the start.
  virtual double stiffening() const { return 1; }
  /// By how much it has grown so far, at most, in the same measure.
  virtual double stiffened() const { return 1; }

  /// Work done on the body from outside since the start, J.
  virtual double work(const Model& /*model*/) const { return 0; }
  /// Energy that went from motion into what does not come back, J, as far as the balance that stops
  /// a diverging run needs it.
  virtual double spent(const Model& /*model*/) const { return 0; }

  /// Visits all that must be kept for a run to go on exactly, beside the dynamic columns.
  virtual void state(Archive& /*archive*/) {}

  /// Adds what it shows to a frame of the trajectory, and to a run's summary.
  virtual void show(const Model& /*model*/, Frame& /*frame*/) const {}
  virtual void summarise(const Model& /*model*/, Summary& /*summary*/) const {}
};

}  // namespace solidem

#endif
