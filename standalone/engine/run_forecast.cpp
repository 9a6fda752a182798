// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/run_forecast.hpp"

#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is of POSIX

#include <algorithm>
#include <filesystem>

#include "engine/run.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

/// A folder that goes again with all that is in it.
class TrialFolder {
 public:
  TrialFolder() : path_((std::filesystem::temp_directory_path() / "solidem-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr)
      throw RunError("cannot make a folder for the trial of a run: " + path_);
  }
  ~TrialFolder() {
    std::error_code error;  // whoever cleans up takes what is left
    std::filesystem::remove_all(path_, error);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Puts a body into a homogeneous stretch that goes on growing. Nobody does work for it.
void stretch(Simulation& simulation, const NominalStrain& strain, double size) {
  std::map<std::string, std::vector<double>> saved = simulation.save();
  constexpr double more_than_enough = 1e300;  // J, for the balance that stops diverging runs
  saved["largest_work"] = {more_than_enough};
  simulation.restore(simulation.step(), saved);
  Model& model = simulation.model();
  const Specimen& specimen = model.specimen();
  const auto positions = model.positions();
  double* velocity = model.data(columns::velocity);
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector moved = strain.displacement_at(specimen.position[i]);
    const Vector shift = (size / strain.size) * moved, speed = (1 / strain.time) * moved;
    for (int axis = 0; axis < 3; ++axis) {
      positions[i][axis] += component(shift, axis);
      velocity[Model::at(columns::velocity, i, axis)] = component(speed, axis);
    }
  }
}

/// Seconds of processors that a step takes while bonds flow.
double measured_flow(Simulation& simulation, const StrainForecast& forecast) {
  constexpr double well_beyond = 2, short_of = 0.5, enough = 0.3;  // s
  const double of_bonds =
      std::min(well_beyond * forecast.limits.yield, short_of * forecast.limits.rupture);
  stretch(simulation, forecast.strain, of_bonds / forecast.alignment);
  simulation.advance(2);
  const std::int64_t steps = 8;
  std::int64_t taken = 0;
  double spent = 0;
  while (spent < enough && taken < 200) {
    const double start = processor_seconds();
    simulation.advance(steps);
    spent += processor_seconds() - start;
    taken += steps;
  }
  return spent / static_cast<double>(taken);
}

}  // namespace

RunForecast foretell_run(Simulation& simulation, const StrainForecast& strain) {
  RunForecast forecast;
  forecast.counts = counts_of(simulation);
  RunOptions options;
  const TrialFolder folder;
  options.directory = folder.path();
  options.quiet = true;
  forecast.costs = try_run(simulation, options);
  forecast.flowing_step = forecast.costs.step;
  forecast.flowing_share = strain.flowing_share;
  if (!(strain.flowing_share > 0)) return forecast;
  try {
    // Flow costs so much more; how busy the machine is was better seen in the longer trial.
    if (forecast.costs.processor_step > 0)
      forecast.flowing_step *= measured_flow(simulation, strain) / forecast.costs.processor_step;
  } catch (const RunError&) {  // a body that does not bear this stretch is foretold as elastic
  }
  return forecast;
}

}  // namespace solidem
