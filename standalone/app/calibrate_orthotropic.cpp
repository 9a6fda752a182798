// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/calibrate_orthotropic.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/bond_sections.hpp"
#include "app/say.hpp"
#include "effects/beam_parameters.hpp"
#include "model/error.hpp"
#include "model/seconds_since.hpp"
#include "output/replace_file.hpp"
#include "output/summary.hpp"

namespace solidem {

namespace {

using Json = nlohmann::ordered_json;

bool is_modulus(std::size_t constant) {
  return constant < 6;
}

std::string text_of(std::size_t constant, double value) {
  return is_modulus(constant) ? fmt::format("{:.4g} GPa", value / 1e9)
                              : fmt::format("{:.3f}", value);
}

void print_trial(const OrthotropicTrial& trial, double seconds, const Voice& tell) {
  const BeamParameters& beams = trial.beams;
  const Anisotropy& grain = *beams.anisotropy;
  tell(
      "misfit {:7.4f}:  beams E_L {:.4g} GPa  E_R/E_L {:.3g}  E_T/E_L {:.3g}  exponent {:.3g}"
      "  radius_ratio {:.3g}",
      trial.misfit, beams.young_modulus / 1e9, grain.radial_modulus / beams.young_modulus,
      grain.tangential_modulus / beams.young_modulus, grain.exponent, beams.radius_ratio);
  if (beams.fibres) tell("  fibres {:.3g}", beams.fibres->stiffness_ratio);
  const auto& e = trial.reached.front().young_modulus;
  tell("  -> E_L/E_T {:.3g}  ({:.2g} s)\n", e[0] / e[2], seconds);
  std::fflush(stdout);
}

void print_result(const OrthotropicRequest& request, const OrthotropicCalibration& found,
                  const Voice& tell) {
  tell("\n{:<6} {:>12} {:>12} {:>9} {:>8}\n", "", "wanted", "reached", "± one", "missed by");
  for (std::size_t c = 0; c < 9; ++c) {
    tell("{:<6} {:>12} {:>12}", constant_names[c],
         request.target[c] ? text_of(c, *request.target[c]) : "free", text_of(c, found.mean[c]));
    tell(" {:>7.2g} %", 100 * found.deviation[c] / std::abs(found.mean[c]));
    if (request.target[c]) tell(" {:>+7.1f} %", 100 * (found.mean[c] / *request.target[c] - 1));
    tell("\n");
  }
  tell("E_L/E_T {:.4g}, E_L/G_LT {:.4g}; from an orthotropic body {:.2g}\n",
       found.mean[0] / found.mean[2], found.mean[0] / found.mean[4], found.coupling);
}

Json by_name(const NineConstants& values) {
  Json json = Json::object();
  for (std::size_t c = 0; c < 9; ++c) json[constant_names[c]] = values[c];
  return json;
}

Json json_of(const BeamParameters& beams) {
  const Anisotropy& grain = *beams.anisotropy;
  Json json = {{"young_modulus", beams.young_modulus},
               {"shear_modulus", beams.shear_modulus},
               {"radius_ratio", beams.radius_ratio},
               {"radial_modulus", grain.radial_modulus},
               {"tangential_modulus", grain.tangential_modulus},
               {"exponent", grain.exponent}};
  if (beams.fibres) json["stiffness_ratio"] = beams.fibres->stiffness_ratio;
  return json;
}

}  // namespace

int calibrate_orthotropic_scene(const Scene& scene, const std::vector<Specimen>& specimens,
                                const std::string& directory, const ResultsFolder& folder,
                                const Voice& tell) {
  const auto start = Clock::now();
  const OrthotropicRequest& request = *scene.orthotropic_calibration;
  auto last = start;
  const OrthotropicCalibration found = calibrate_orthotropic(
      request, *scene.setup.get<BeamParameters>(), specimens,
      [&last, &tell](const OrthotropicTrial& trial) {
        const auto now = Clock::now();
        print_trial(trial, std::chrono::duration<double>(now - last).count(), tell);
        last = now;
      });
  print_result(request, found, tell);

  const std::string sections =
      bond_sections({found.beams, scene.setup.get<PlasticityParameters>(),
                     scene.setup.get<RuptureParameters>(), scene.setup.get<ContactParameters>()});
  folder.begin();
  replace_text_file(directory + "/calibrated.toml", sections);
  tell("\n{}\n-> {}/calibrated.toml\n", sections, directory);

  Json targets = Json::object(), trials = Json::array();
  for (std::size_t c = 0; c < 9; ++c)
    if (request.target[c]) targets[constant_names[c]] = *request.target[c];
  for (const OrthotropicTrial& trial : found.trials) {
    Json reached = Json::array();
    for (const OrthotropicConstants& own : trial.reached)
      reached.push_back(by_name(nine_constants(own)));
    trials.push_back(
        {{"parameters", json_of(trial.beams)}, {"reached", reached}, {"misfit", trial.misfit}});
  }
  const double seconds = seconds_since(start);
  write_summary(directory + "/calibration.json", {{"solidem", version()},
                                                  {"scene", scene.path},
                                                  {"set", scene.set},
                                                  {"elements", specimens[0].size()},
                                                  {"specimens", specimens.size()},
                                                  {"seed", scene.specimen.seed},
                                                  {"targets", targets},
                                                  {"parameters", json_of(found.beams)},
                                                  {"mean", by_name(found.mean)},
                                                  {"deviation", by_name(found.deviation)},
                                                  {"coupling", found.coupling},
                                                  {"misses", found.misses},
                                                  {"trials", trials},
                                                  {"wall_seconds", seconds},
                                                  {"threads", omp_get_max_threads()},
                                                  {"hardware", to_json(hardware())}});
  tell("in all {:.3g} s\n", seconds);
  if (found.misses.empty()) return 0;
  std::string misses;
  for (const std::string& miss : found.misses) misses += "\n  " + miss;
  throw RunError("[calibration] not every target was met; the nearest parameters are in " +
                 directory + ":" + misses);
}

}  // namespace solidem
