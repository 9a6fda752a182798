// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/run.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "effects/beam_parameters.hpp"
#include "effects/beams.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/kernels/kernels.hpp"
#include "engine/body_figures.hpp"
#include "engine/energy_gained.hpp"
#include "engine/frame_fields.hpp"
#include "engine/heat.hpp"
#include "engine/interrupt_watch.hpp"
#include "model/error.hpp"
#include "model/seconds_since.hpp"
#include "output/checkpoint.hpp"
#include "output/disk.hpp"
#include "output/history.hpp"
#include "output/progress.hpp"
#include "output/results_folder.hpp"
#include "output/summary.hpp"
#include "output/trajectory.hpp"
#include "solve/heat/heat_integrator.hpp"

namespace solidem {

namespace {

/// Adds the time of a scope to one of the phases of a run.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
  ~Stopwatch() { seconds_ += seconds_since(start_); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  Clock::time_point start_;
};

template <class Work>
double seconds_of(const Work& work) {
  const auto start = Clock::now();
  work();
  return seconds_since(start);
}

/// Of few measurements: one may have been made while the machine did something else.
template <std::size_t count>
double median(std::array<double, count> values) {
  std::sort(values.begin(), values.end());
  return values[count / 2];
}

std::vector<std::string> names_of(const HistoryRow& row) {
  std::vector<std::string> names;
  for (const auto& [name, value] : row.values) names.push_back(name);
  return names;
}

std::vector<double> values_of(const HistoryRow& row) {
  std::vector<double> values;
  for (const auto& [name, value] : row.values) values.push_back(value);
  return values;
}

nlohmann::ordered_json figures_of(const HeatIntegrator& integrator) {
  const HeatIntegratorStatistics& s = integrator.statistics();
  return {{"what", integrator.explanation()},
          {"inner_steps", s.inner_steps},
          {"rejected", s.rejected},
          {"evaluations", s.evaluations},
          {"solves", s.solves},
          {"iterations", s.iterations},
          {"factorisations", s.factorisations},
          {"explicit_steps", s.explicit_steps},
          {"rkl2_steps", s.rkl2_steps},
          {"implicit_steps", s.implicit_steps}};
}

/// First multiple of an interval after a step.
std::int64_t next_multiple(std::int64_t step, std::int64_t interval) {
  return (step / interval + 1) * interval;
}

/// When frames are written: so many in a run, evenly, the last at its end.
class FrameSteps {
 public:
  FrameSteps(std::int64_t frames, std::int64_t last)
      : frames_(std::min(frames, last)), last_(last) {}

  /// The first one after a step; beyond the end: there is none.
  std::int64_t after(std::int64_t step) const {
    if (frames_ == 0 || step >= last_) return last_ + 1;
    const double passed = static_cast<double>(step) / static_cast<double>(last_);
    auto n = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(passed * static_cast<double>(frames_)) - 1);
    while (step_of(n) <= step) ++n;
    return step_of(n);
  }

 private:
  std::int64_t step_of(std::int64_t n) const {
    return last_ / frames_ * n + last_ % frames_ * n / frames_;
  }

  std::int64_t frames_, last_;
};

class Recorder {
 public:
  Recorder(Simulation& simulation, const RunOptions& options)
      : simulation_(simulation),
        options_(options),
        seconds_(options.wall_seconds),
        fields_(simulation, simulation.setup().output.fields),
        watch_(options.interrupted, [this] { end_from_kept(); }) {
    prepare_directory(options.directory);
    // Bonds are drawn where they carry loads, those that have broken as well; without motion their
    // list is not worth its memory.
    // Under central forces, neighbours change: what is drawn are the elements.
    if (simulation.find<Beams>() != nullptr && simulation.setup().output.frames > 0)
      bonds_ = simulation.model().slots().pairs();
    state_.fingerprint = options.fingerprint;
    if (options.resume)
      restore();
    else
      state_.run = new_identity();
    first_step_ = simulation.step();
  }

  RunOutcome run() {
    const RunCounts counts = counts_of(simulation_);
    const std::int64_t last = counts.steps, frames = simulation_.setup().output.frames;
    const std::int64_t observe_every = counts.observe_every;
    const std::int64_t checkpoint_every = counts.checkpoint_every;
    const FrameSteps frame_steps(frames, last);
    open();
    tell_what_is_beyond(last);
    if (!options_.resume) {
      write_row();
      if (frames > 0) write_frame();
    }
    ProgressBar progress(
        first_step_, last,
        options_.quiet ? ProgressBar::Style::quiet : ProgressBar::style_for(stderr));
    try {
      while (simulation_.step() < last && !interrupted()) {
        const std::int64_t now = simulation_.step(), frame = frame_steps.after(now);
        const std::int64_t target =
            std::min({last, now + stride(), next_multiple(now, observe_every), frame,
                      next_multiple(now, checkpoint_every)});
        advance(target - now);
        if (target % observe_every == 0 || target == last) write_row();
        if (target == frame) write_frame();
        if (target % checkpoint_every == 0) write_checkpoint();
        progress.update(target);
      }
      if (history_->last_step() != simulation_.step()) write_row();
      write_checkpoint();
    } catch (const RunError& error) {
      summarise(false, error.what());
      throw;
    }
    if (const auto gained = note_on_gained_energy(last_row_, simulation_.round_off_energy()))
      note(*gained);
    const bool completed = simulation_.step() >= last;
    summarise(completed, completed ? "" : "interrupted");
    return {completed, last_row_, peak_row_};
  }

  RunCosts try_out() {
    constexpr double enough = 0.5;  // s
    constexpr std::size_t few = 5;
    const bool has_frames = simulation_.setup().output.frames > 0;
    // A scene that does not say how long to run can be tried for any time.
    const std::int64_t asked = simulation_.steps_to_run();
    const std::int64_t last = asked > 0 ? asked : std::numeric_limits<std::int64_t>::max();
    RunCosts costs;
    costs.files = seconds_of([&] { open(); });
    std::array<double, few> row{}, frame{}, checkpoint{};
    for (std::size_t n = 0; n < few; ++n) {
      if (simulation_.step() < last) simulation_.advance(1);  // the first ones warm up
      row[n] = seconds_of([&] { write_row(); });
      if (has_frames) frame[n] = seconds_of([&] { write_frame(); });
      checkpoint[n] = seconds_of([&] { write_checkpoint(); });
    }
    costs.row = median(row);
    costs.frame = median(frame);
    costs.checkpoint = median(checkpoint);
    std::int64_t taken = 0;
    const double start = processor_seconds();
    while (seconds_["steps"] < enough && simulation_.step() < last) {
      const std::int64_t steps = std::min(stride(), last - simulation_.step());
      advance(steps);
      taken += steps;
    }
    if (taken > 0) {
      costs.step = seconds_["steps"] / static_cast<double>(taken);
      costs.processor_step = (processor_seconds() - start) / static_cast<double>(taken);
    }
    costs.files += seconds_of([&] { summarise(true, ""); });
    return costs;
  }

 private:
  /// What a long step that is interrupted goes back to.
  struct Kept {
    std::int64_t step;
    double time;
    std::map<std::string, std::vector<double>> state;
    nlohmann::ordered_json summary;
  };

  /// Strides are short, so that an interrupt is answered and the bar moves.
  std::int64_t stride() const {
    constexpr double longest = 0.3, most = 64;  // s, steps
    return static_cast<std::int64_t>(std::clamp(longest / seconds_per_step_, 1.0, most));
  }

  void advance(std::int64_t steps) {
    constexpr double is_long = 0.2;  // s
    kept_.reset();
    if (options_.ends_program && seconds_per_step_ > is_long)
      kept_ = Kept{simulation_.step(), simulation_.time(), simulation_.save(),
                   summary_of(false, "interrupted")};
    const Stopwatch stopwatch(seconds_["steps"]);
    const auto start = Clock::now();
    watch_.while_busy([&] { simulation_.advance(steps); });
    seconds_per_step_ = seconds_since(start) / static_cast<double>(steps);
  }

  /// Ends the program within a long step, from what was kept before it.
  void end_from_kept() {
    if (!kept_) return;
    try {
      write_checkpoint(kept_->step, kept_->time, std::move(kept_->state));
      write_summary(path("summary.json"), kept_->summary);
      std::printf("\ninterrupted within the step after %lld; go on with --resume\n",
                  static_cast<long long>(kept_->step));
    } catch (const std::exception& error) {
      std::fprintf(stderr, "error: %s\n", error.what());
    }
    std::fflush(nullptr);
    std::_Exit(130);  // the other thread is in the middle of a step
  }

  bool interrupted() const { return options_.interrupted != nullptr && *options_.interrupted; }
  std::string path(const char* file) const { return options_.directory + "/" + file; }

  void open() {
    const Stopwatch stopwatch(seconds_["output"]);
    last_row_ = simulation_.observe();
    const std::vector<std::string> columns = names_of(last_row_);
    const Model& model = simulation_.model();
    Specimen with_bonds;
    if (!bonds_.empty()) {
      with_bonds = model.specimen();
      with_bonds.bonds = bonds_;
    }
    const Specimen& specimen = bonds_.empty() ? model.specimen() : with_bonds;
    const bool has_frames = simulation_.setup().output.frames > 0;
    if (options_.resume) {
      resume_history(columns);
      if (has_frames) resume_trajectory(specimen);
    } else {
      history_.emplace(path("history.csv"), columns);
      if (has_frames) trajectory_.emplace(path("trajectory.h5"), specimen, state_.run);
    }
  }

  /// A scene may have become shorter than the run from which it goes on.
  void tell_what_is_beyond(std::int64_t last) {
    const std::optional<double>& duration = simulation_.setup().run.duration;
    constexpr double round_off = 1e-9;
    if (first_step_ <= last && simulation_.time() <= duration.value_or(1e300) * (1 + round_off))
      return;
    note("the checkpoint is of step " + std::to_string(first_step_) + ", " +
         text(simulation_.time()) + " s, beyond the end that the scene asks for: nothing is left " +
         "to compute");
  }

  /// A history that somebody moved away begins anew; one that lost rows is refused.
  void resume_history(const std::vector<std::string>& columns) {
    if (is_there(path("history.csv"))) {
      history_.emplace(HistoryWriter::resume(path("history.csv"), columns, state_.history));
      return;
    }
    note(path("history.csv") + " is missing: it begins anew at step " +
         std::to_string(first_step_));
    history_.emplace(path("history.csv"), columns);
    write_row();
  }

  void resume_trajectory(const Specimen& specimen) {
    trajectory_.emplace(
        TrajectoryWriter::resume(path("trajectory.h5"), specimen, first_step_, state_.run));
    for (const std::string& found : trajectory_->notes()) note(found);
    const auto missing = state_.frames - static_cast<std::int64_t>(trajectory_->frames());
    if (missing > 0)
      note(std::to_string(missing) + " frames before step " + std::to_string(first_step_) +
           " are missing in " + path("trajectory.h5"));
  }

  /// What the user should know, now and in the summary.
  void note(const std::string& text) {
    notes_.push_back(text);
    std::fprintf(stderr, "note: %s\n", text.c_str());
  }

  void restore() {
    const CheckpointReader checkpoint(path("checkpoint.h5"), options_.fingerprint);
    state_ = checkpoint.header();
    std::map<std::string, std::vector<double>> saved;
    for (const auto& [name, values] : simulation_.save())
      saved[name] =
          checkpoint.read<double>(name);  // sums may have grown since; columns are checked
    simulation_.restore(state_.step, saved);
  }

  void write_row() {
    const Stopwatch stopwatch(seconds_["observation"]);
    last_row_ = simulation_.observe();
    note_peak();
    history_->write_row(last_row_.step, last_row_.time, values_of(last_row_));
  }

  /// Keeps the row in which the gauge shows the largest stress.
  void note_peak() {
    for (const auto& [name, value] : last_row_.values) {
      if (name != "gauge.stress" || (!peak_row_.values.empty() && std::abs(value) <= peak_stress_))
        continue;
      peak_stress_ = std::abs(value);
      peak_row_ = last_row_;
    }
  }

  void write_frame() {
    const Stopwatch stopwatch(seconds_["output"]);
    const Model& model = simulation_.model();
    Observation observation;
    simulation_.observe(observation);
    std::vector<Field> fields;
    std::vector<double> position;
    if (model.moves()) {
      const auto positions = model.positions();
      for (std::size_t i = 0; i < model.elements(); ++i)
        position.insert(position.end(), positions[i], positions[i] + 3);
      fields.push_back({"position", 3, position.data()});
      fields.push_back({"velocity", 3, &observation.motion.velocity.data()->x});
    }
    if (model.has(columns::temperature))
      fields.push_back({"temperature", 1, model.data(columns::temperature)});
    Frame frame(bonds_);
    for (const auto& effect : simulation_.effects()) effect->show(model, frame);
    for (const Frame::Field& field : frame.fields())
      fields.push_back({field.name, 1, field.values.data(), field.of_bonds});
    const std::vector<FrameFields::Values> asked_for = fields_.of_now(frame);
    for (const FrameFields::Values& field : asked_for)
      fields.push_back({field.name, field.components, field.values.data(), field.of_bonds});
    std::vector<DrawnSurface> surfaces;
    for (const Frame::Surface& surface : frame.surfaces())
      surfaces.push_back({surface.name, surface.vertices, surface.facets});
    trajectory_->write_frame(simulation_.step(), simulation_.time(), fields, surfaces);
  }

  void write_checkpoint() {
    const Stopwatch stopwatch(seconds_["output"]);
    simulation_.check();  // what has diverged must not take the place of what has not
    write_checkpoint(simulation_.step(), simulation_.time(), simulation_.save());
  }

  void write_checkpoint(std::int64_t step, double time,
                        std::map<std::string, std::vector<double>> saved) {
    state_.step = step;
    state_.time = time;
    state_.history = history_->mark();
    state_.frames = trajectory_ ? static_cast<std::int64_t>(trajectory_->frames()) : 0;
    solidem::write_checkpoint(path("checkpoint.h5"), state_,
                              [&](const CheckpointContents& contents) {
                                for (auto& [name, values] : saved) {
                                  contents.write(name, values);
                                  std::vector<double>().swap(values);  // it is held once
                                }
                              });
  }

  void summarise(bool completed, const std::string& reason) {
    write_summary(path("summary.json"), summary_of(completed, reason));
  }

  nlohmann::ordered_json summary_of(bool completed, const std::string& reason) {
    const Model& model = simulation_.model();
    const std::int64_t steps = simulation_.step() - first_step_;
    const auto bond_steps = static_cast<double>(model.slots().bonds()) * static_cast<double>(steps);
    nlohmann::ordered_json summary;
    summary["solidem"] = version();
    summary["scene"] = options_.scene;
    if (!options_.set.empty()) summary["set"] = options_.set;
    summary["run"] = state_.run;
    summary["completed"] = completed;
    if (!reason.empty()) summary["stopped"] = reason;
    for (const PlannedEffect& effect : simulation_.plan().effects)
      summary["effects"].push_back(effect.name);
    summary["notes"] = notes_;
    summary["elements"] = model.elements();
    if (!model.specimen().bodies.empty()) summary["bodies"] = body_figures(model);
    summary["bonds"] = model.slots().bonds();
    summary["unbonded_elements"] = simulation_.unbonded();
    summary["first_step"] = first_step_;
    summary["steps"] = simulation_.step();
    const TimeStepChoice& dt = simulation_.time_step();
    summary["time_step"] = dt.value;
    summary["time_step_ratio"] = dt.ratio;
    summary["time_step_limit"] = dt.limit;
    summary["simulated_time"] = simulation_.time();
    summary["wall_seconds"] = seconds_;
    summary["nanoseconds_per_bond_step"] =
        bond_steps > 0 ? nlohmann::ordered_json(seconds_["steps"] * 1e9 / bond_steps) : nullptr;
    for (const auto& effect : simulation_.effects()) effect->summarise(model, summary);
    if (const Heat* heat = simulation_.heat()) {
      summary["conduction"] = {
          {"law", name_of(simulation_.setup().get<ConductionParameters>()->law)},
          {"area_factor", heat->area_factor()}};
      if (heat->integrator() != nullptr) summary["integrator"] = figures_of(*heat->integrator());
    }
    summary["peak_memory_bytes"] = peak_memory_bytes();
    summary["bytes_per_element"] =
        static_cast<double>(model.bytes()) / static_cast<double>(model.elements());
    summary["precision"] = "double";
    summary["threads"] = omp_get_max_threads();
    summary["instruction_set"] = kernels().instruction_set;
    summary["hardware"] = to_json(hardware());
    for (const auto& [name, value] : last_row_.values) summary["final"][name] = value;
    if (!peak_row_.values.empty()) summary["peak"]["time"] = peak_row_.time;
    for (const auto& [name, value] : peak_row_.values) summary["peak"][name] = value;
    return summary;
  }

  Simulation& simulation_;
  const RunOptions& options_;
  std::map<std::string, double> seconds_;
  FrameFields fields_;       ///< that the scene asks frames for
  std::vector<Pair> bonds_;  ///< at the start, where they are drawn
  std::int64_t first_step_ = 0;
  HistoryRow last_row_{}, peak_row_{};
  double peak_stress_ = 0;                                  ///< of its row, Pa
  CheckpointHeader state_;                                  ///< of the last checkpoint
  std::vector<std::string> notes_ = notes_of(simulation_);  ///< of the start, and on the way
  std::optional<HistoryWriter> history_;
  std::optional<TrajectoryWriter> trajectory_;
  double seconds_per_step_ = 1;  ///< of the last ones; at first as if they were long
  std::optional<Kept> kept_;
  InterruptWatch watch_;
};

}  // namespace

RunOutcome run(Simulation& simulation, const RunOptions& options) {
  return Recorder(simulation, options).run();
}

RunCosts try_run(Simulation& simulation, const RunOptions& options) {
  return Recorder(simulation, options).try_out();
}

RunCounts counts_of(const Simulation& simulation) {
  const RunControl& run = simulation.setup().run;
  const OutputControl& output = simulation.setup().output;
  RunCounts counts;
  counts.steps = simulation.steps_to_run();
  counts.observe_every = run.observe_every.value_or(std::max<std::int64_t>(1, counts.steps / 200));
  counts.rows = (counts.steps + counts.observe_every - 1) / counts.observe_every + 1;
  counts.frames = output.frames > 0 ? std::min(output.frames, counts.steps) + 1 : 0;
  counts.checkpoint_every =
      output.checkpoint_every > 0 ? output.checkpoint_every : counts.steps + 1;
  counts.checkpoints = counts.steps / counts.checkpoint_every + 1;
  return counts;
}

}  // namespace solidem
