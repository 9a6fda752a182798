// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/run.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "app/closing.hpp"
#include "app/colours.hpp"
#include "app/commands.hpp"
#include "app/notes.hpp"
#include "app/say.hpp"
#include "effects/central_forces.hpp"
#include "effects/kernels/kernels.hpp"
#include "engine/heat.hpp"
#include "model/error.hpp"
#include "model/seconds_since.hpp"
#include "output/results_folder.hpp"
#include "scene/body.hpp"
#include "scene/fingerprint.hpp"
#include "solve/heat/heat_integrator.hpp"

namespace solidem {

namespace {

std::atomic<bool> interrupted{false};

/// The first Ctrl-C ends the run in order, the second at once.
void on_interrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

/// A word as a shell takes it.
std::string in_shell(const std::string& word) {
  const bool is_plain = std::all_of(word.begin(), word.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::strchr("_./+:=@,-", c) != nullptr;
  });
  if (is_plain && !word.empty()) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

int run_that(const Scene& scene, const RunCommand& command, Clock::time_point beginning) {
  if (!scene.setup.run.duration && !scene.setup.run.steps)
    throw InputError(scene.path +
                     ": nothing says how long to run; expected a section [run] with duration or "
                     "steps (without it a scene serves solidem calibrate)");
  RunOptions options;
  options.scene = scene.path;
  options.set = scene.set;
  options.fingerprint = fingerprint(scene);
  options.directory = command.output.empty()
                          ? std::filesystem::path(scene.path).stem().string() + ".results"
                          : command.output;
  options.resume = command.resume;
  const ResultsFolder folder(options.directory, run_results(),
                             command.resume      ? Earlier::keep
                             : command.overwrite ? Earlier::replace
                                                 : Earlier::refuse);
  options.quiet = command.quiet;
  options.interrupted = &interrupted;

  auto start = Clock::now();
  Specimen body = make_body(scene);
  options.wall_seconds["specimen"] = seconds_since(start);
  start = Clock::now();
  Simulation simulation(scene.setup, std::move(body), command.force);
  options.wall_seconds["set-up"] = seconds_since(start);

  const Slots& slots = simulation.model().slots();
  say("{}: {} elements, {} bonds, {} steps of {:.4g} s -> {}\n", scene.title,
      simulation.model().elements(), slots.bonds(), simulation.steps_to_run(),
      simulation.time_step().value, options.directory);
  print_notes(notes_of(simulation));
  if (simulation.time_step().value > simulation.time_step().limit)
    say("{} the time step is beyond the stable limit {:.4g} s, as forced\n",
        with_look(Look::note, "warning:", stdout), simulation.time_step().limit);
  std::fflush(stdout);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error to tell, not an end
  // All that ask a program to end: by the keyboard, by another program, as the terminal closes, and
  // as the time that the system grants runs out.
  for (const int signal : {SIGINT, SIGTERM, SIGXCPU}) std::signal(signal, on_interrupt);
  if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // as nohup asks
  folder.begin();
  const RunOutcome outcome = run(simulation, options);
  if (const Heat* heat = simulation.heat(); heat != nullptr && heat->integrator() != nullptr)
    say("heat in time: {}\n", heat->integrator()->explanation());
  if (const CentralForces* forces = simulation.find<CentralForces>();
      forces != nullptr && forces->has_exceeded())
    say("{} elements came as near as {:.3g} of their equilibrium distance overlapping, the "
        "scene "
        "allows for {:.3g}; beyond it the law went on with its slope there ([central_forces] "
        "interpenetration)\n",
        with_look(Look::note, "note:", stdout), forces->largest_interpenetration(),
        forces->allowed_interpenetration());
  if (outcome.completed) {
    say("{}", closing_lines(simulation, outcome, options.directory, seconds_since(beginning)));
    return 0;
  }
  std::string words = in_shell(scene.path);
  for (const std::string& assignment : scene.set) words += " --set " + in_shell(assignment);
  say("interrupted at step {}; go on with: solidem run {} --output {} --resume\n",
      simulation.step(), words, in_shell(options.directory));
  return 130;
}

}  // namespace

int run_scene(const RunCommand& command) {
  const auto beginning = Clock::now();
  kernels();  // an impossible choice of instruction set must fail before any work
  if (command.threads > 0) omp_set_num_threads(command.threads);
  const Scene scene = read_scene(command.scene);
  return at_places_of(scene, [&] { return run_that(scene, command, beginning); });
}

}  // namespace solidem
