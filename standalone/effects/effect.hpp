// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_EFFECT_HPP
#define SOLIDEM_EFFECTS_EFFECT_HPP

#include <omp.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace solidem {

/// One time step, from `time` to `time + time_step`.
/// Velocities stand half a step behind the poses, except at the start, where both stand at time 0:
/// the first kick is half a step long.
struct Step {
  double time;       ///< s, of the poses before the step
  double time_step;  ///< s
  double kick;       ///< s, by which velocities move on: time_step, or half of it at the start
};

/// Elements in motion at one instant, velocities brought to the time of the poses.
struct ObservedMotion {
  std::vector<Vector> force;             ///< of its neighbours on each element, N
  std::vector<Vector> moment;            ///< N·m
  std::vector<Vector> velocity;          ///< m/s
  std::vector<Vector> angular_velocity;  ///< rad/s
  double kinetic_energy = 0;             ///< of the motion that no grip imposes, J
  double elastic_energy = 0;             ///< of the bonds, or the potential of central forces, J
  double contact_energy = 0;             ///< stored in contacts, J
  double plastic_work = 0;               ///< of the bonds since the start, J
  double dissipated_energy = 0;          ///< by drag between elements since the start, J
  double fracture_energy = 0;            ///< lost where bonds broke or formed, J
  double external_work = 0;              ///< done by the grips since the start, J
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
  ObservedHeat heat;
  std::vector<std::pair<std::string, double>> values;  ///< further columns of the history

  void add(std::string name, double value) { values.emplace_back(std::move(name), value); }
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
  /// Work done on the body from outside since the start, J.
  virtual double work() const { return 0; }
  /// Sums kept since the start that belong into a checkpoint beside the dynamic columns.
  virtual std::vector<double> save() const { return {}; }
  virtual void restore(const std::vector<double>& /*saved*/) {}
};

/// Calls work(first, last) on all threads for ranges that together hold each block once. Below
/// `least_blocks` a thread would cost more than it saves, and one thread does it all.
template <class Work>
void for_blocks(std::size_t blocks, std::size_t least_blocks, const Work& work) {
#pragma omp parallel if (blocks >= least_blocks)
  {
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    work(blocks * thread / threads, blocks * (thread + 1) / threads);
  }
}

}  // namespace solidem

#endif
