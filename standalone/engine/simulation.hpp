// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_SIMULATION_HPP
#define SOLIDEM_ENGINE_SIMULATION_HPP

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "effects/effect.hpp"
#include "effects/plan.hpp"
#include "effects/selections.hpp"
#include "effects/setup.hpp"
#include "engine/energy_guard.hpp"

namespace solidem {

class Assembly;
class Heat;
class Mechanics;
struct ConductionGeometry;

/// The time step of a simulation and where it comes from.
struct TimeStepChoice {
  double value = 0;       ///< s
  std::string criterion;  ///< what bounds it
  double bound = 0;       ///< s, of the criterion
  double limit = 0;       ///< s, beyond it the run diverges: 2/ω_max, or 2/largest decay rate
  double ratio = 0;       ///< value / bound
};

/// One row of the history.
struct HistoryRow {
  std::int64_t step;
  double time;
  std::vector<std::pair<std::string, double>> values;
};

/// A specimen under the effects of a setup, step by step.
class Simulation {
 public:
  /// Builds the columns and effects of the plan. `force`: accept a time step beyond the limit.
  /// Throws InputError when the setup does not fit the specimen: an element without a material, a
  /// region without elements, two grips that share elements, a time step beyond the limit.
  Simulation(const Setup& setup, Specimen specimen, bool force = false);
  ~Simulation();
  /// Effects know the model by its place.
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Runs so many time steps; the one that reaches the duration ends there. Throws RunError within
  /// 256 steps, and at the last of them, when the elements move with more energy than was ever put
  /// in or are held more stiffly than the time step allows, and of a temperature below absolute
  /// zero.
  void advance(std::int64_t steps);

  /// Throws RunError where the state now shows that the run diverged.
  void check() const;

  /// Looks at the state; throws RunError when it is no longer finite.
  HistoryRow observe() const;
  /// The same, with what was seen.
  HistoryRow observe(Observation& observation) const;

  /// Energy of no account, J.
  double round_off_energy() const { return guard_.round_off(); }

  std::int64_t step() const { return step_; }
  double time() const { return time_; }
  const TimeStepChoice& time_step() const { return time_step_; }
  /// Number of steps that the setup's run control asks for, those before a resumed run among them.
  std::int64_t steps_to_run() const;

  Model& model() { return model_; }
  const Model& model() const { return model_; }
  const Plan& plan() const { return plan_; }
  const Setup& setup() const { return setup_; }
  /// Elements that the regions of the setup select.
  const Selections& selections() const { return selections_; }
  /// Elements without a bond: free to move, with nothing to move them, and outside of all measures.
  std::size_t unbonded() const { return unbonded_; }

  /// The pairs that were neighbours at the start or, where bonds join them, are bonded now.
  std::vector<Pair> pairs() const;

  /// The effects, in the order of the plan.
  const std::vector<std::unique_ptr<Effect>>& effects() const { return effects_; }
  /// The first effect of a type, such as Beams or Rupture; null: the scene has none.
  template <class Type>
  const Type* find() const {
    for (const auto& effect : effects_)
      if (const auto* found = dynamic_cast<const Type*>(effect.get())) return found;
    return nullptr;
  }

  /// What conducts and heats; none without conduction.
  const Heat* heat() const { return heat_.get(); }

  /// Everything that is needed to go on exactly: dynamic columns and the effects' sums, by name.
  std::map<std::string, std::vector<double>> save() const;
  /// Goes on from what was saved at a step, with the time step of then where the scene gives none
  /// and stability does not bound it. Throws InputError when it does not fit.
  void restore(std::int64_t step, const std::map<std::string, std::vector<double>>& saved);

 private:
  /// Makes the effects that act in some phases, where the plan has them.
  void make_effects(Assembly& assembly, Phase first, Phase last);
  std::vector<Effect*> of_phase(Phase phase) const;
  void sort_by_phase();
  /// Makes the model: bonds and, if heat passes elsewhere, its conductors.
  Model make_model(Specimen specimen);
  void add_observers();
  /// Takes the energy that is there now as what the run starts with.
  void record_initial_energy();
  void choose_time_step(bool force);
  /// Whether the time step follows from the duration: heat that stability does not bound.
  bool step_follows_duration() const;
  /// Refuses more steps than can be counted.
  void check_number_of_steps() const;
  /// Length of the next step, s: the last one before the duration may be shorter.
  double next_length() const;
  void finish_step(double length);
  EnergyInMotion energy_in_motion() const;
  /// J
  double stored_energy() const;
  /// Throws RunError when the elements move with more energy than was ever put in, or are held more
  /// stiffly than the time step allows. What was put in so far, J.
  double check_stability() const;
  /// Throws RunError when an element leaps past others that it should meet.
  void check_leaps(const std::string& at_step) const;
  /// ½ m (v² − v₋·v₊) of all that moves, with its velocities half a step before and after, J.
  double swing_of(const ObservedMotion& motion) const;
  void step_once(const Step& step);
  /// Whether a run changes a column, so that it belongs into a checkpoint.
  bool changes(const Column& column) const;

  Setup setup_;
  std::size_t unbonded_ = 0;
  std::unique_ptr<ConductionGeometry> geometry_;  ///< while the simulation is built
  Selections selections_;
  Model model_;
  Plan plan_;
  TimeStepChoice time_step_;
  std::int64_t step_ = 0;
  double time_ = 0;                               ///< s
  double last_length_ = 0;                        ///< of the step before, s
  std::int64_t origin_step_ = 0;                  ///< from which steps of equal length are counted
  double origin_time_ = 0;                        ///< its time, s
  std::vector<std::unique_ptr<Effect>> effects_;  ///< in the order of the plan
  std::vector<Effect*> moving_;                   ///< those up to the constraints, by phase
  std::vector<Effect*> looking_;                  ///< those after the move
  std::vector<std::unique_ptr<Observer>> observers_;
  Mechanics* mechanics_ = nullptr;  ///< what moves elements, if anything does
  std::unique_ptr<Heat> heat_;
  std::vector<double> specimen_marks_;  ///< by which a checkpoint knows what it was made of
  double motion_limit_ = 0;             ///< longest stable step of the motion at the start, s
  double initial_energy_ = 0;
  double initially_stored_ = 0;  ///< of it, J
  double initial_swing_ = 0;     ///< J
  EnergyGuard guard_;
};

/// What a user of a simulation should know before it runs: of its effects together, of its body.
std::vector<std::string> notes_of(const Simulation& simulation);

}  // namespace solidem

#endif
