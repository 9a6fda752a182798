// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>

#include "app/bond_sections.hpp"
#include "app/calibrate_curve.hpp"
#include "app/calibrate_orthotropic.hpp"
#include "app/commands.hpp"
#include "app/notes.hpp"
#include "app/say.hpp"
#include "effects/beam_parameters.hpp"
#include "engine/calibration.hpp"
#include "engine/tension_bench.hpp"
#include "model/error.hpp"
#include "model/seconds_since.hpp"
#include "output/replace_file.hpp"
#include "output/results_folder.hpp"
#include "output/summary.hpp"
#include "scene/body.hpp"
#include "solve/calibration/hardening_search.hpp"
#include "specimen/pieces.hpp"
#include "specimen/report.hpp"

namespace solidem {

namespace {

using Json = nlohmann::ordered_json;

/// What a user reads figures in.
struct FigureName {
  const char* key;
  const char* symbol;
  double unit;
  const char* unit_name;
};
constexpr FigureName figure_names[] = {{"young_modulus", "E", 1e9, " GPa"},
                                       {"poisson_ratio", "nu", 1, ""},
                                       {"yield_stress", "sigma_0.2", 1e6, " MPa"},
                                       {"peak_stress", "peak", 1e6, " MPa"},
                                       {"rupture_strain", "rupture", 0.01, " %"}};

std::string text_of(const std::vector<BodyFigures>& figures) {
  std::string text;
  for (const auto& [key, spread] : spreads(figures))
    for (const FigureName& name : figure_names)
      if (key == name.key) {
        text += fmt::format("  {} {:.4g}", name.symbol, spread.mean / name.unit);
        if (figures.size() > 1) text += fmt::format(" ± {:.2g}", spread.deviation / name.unit);
        text += name.unit_name;
        if (spread.count < figures.size())
          text += fmt::format(" ({} of {})", spread.count, figures.size());
      }
  return text;
}

std::string text_of(const CalibrationTrial& trial, const CalibrationTargets& targets) {
  const BondParameters& bonds = trial.bonds;
  std::string text;
  if (!trial.is_dynamic) {
    text = fmt::format("static  radius_ratio {:.5g}", bonds.beams.radius_ratio);
    if (bonds.beams.law != BeamParameters::Law::spring)
      text += fmt::format(" poisson_ratio {:.4g}", poisson_ratio_of(bonds.beams));
  } else {
    text = "pulled ";
    if (bonds.plasticity)
      for (const HardeningParameter& parameter : hardening_parameters(bonds.plasticity->hardening))
        text += fmt::format(" {} {:.4g}", parameter.name, parameter.value);
    if (const std::optional<double> strain = rupture_strain(bonds))
      text += fmt::format(" rupture {:.4g}", *strain);
  }
  const bool is_of_curve = trial.is_dynamic && targets.curve;
  return fmt::format(
      "{:<68}:{}  ({:.2g} s)", text,
      is_of_curve ? text_of_curve(*targets.curve, trial.figures) : text_of(trial.figures),
      trial.seconds);
}

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(const BondParameters& bonds) {
  Json json = {{"young_modulus", bonds.beams.young_modulus},
               {"shear_modulus", bonds.beams.shear_modulus},
               {"radius_ratio", bonds.beams.radius_ratio}};
  if (bonds.plasticity)
    for (const HardeningParameter& parameter : hardening_parameters(bonds.plasticity->hardening))
      json[parameter.name] = parameter.value;
  if (bonds.rupture) json["rupture_strain"] = json_of(rupture_strain(bonds));
  return json;
}

Json json_of(const std::vector<BodyFigures>& figures, bool with_tension) {
  Json list = Json::array();
  for (const BodyFigures& body : figures) {
    Json json = {{"young_modulus", body.elastic.young_modulus},
                 {"poisson_ratio", body.elastic.poisson_ratio}};
    if (with_tension) {
      json["yield_stress"] = json_of(body.tension.yield_stress);
      json["peak_stress"] = json_of(body.tension.peak_stress);
      json["rupture_strain"] = json_of(body.tension.rupture_strain);
    }
    list.push_back(json);
  }
  return list;
}

Json json_of(const CalibrationTargets& targets) {
  Json json = {{"young_modulus", targets.young_modulus},
               {"poisson_ratio", json_of(targets.poisson_ratio)},
               {"yield_stress", json_of(targets.yield_stress)},
               {"peak_stress", json_of(targets.peak_stress)},
               {"rupture_strain", nullptr}};
  if (targets.rupture_strain) json["rupture_strain"] = *targets.rupture_strain;
  if (targets.curve) json["curve_tolerance"] = targets.curve->tolerance;
  return json;
}

/// How far the parameters of one specimen would lie from those of the next: the scatter of the
/// figures, over what each parameter does to its figure.
Json uncertainty_of(const Calibration& found) {
  Json json = Json::object();
  if (found.figures.size() < 2) return json;
  for (const auto& [key, spread] : spreads(found.figures)) {
    const double fraction = spread.deviation / spread.mean;
    if (key == "young_modulus") json[key] = fraction * found.bonds.beams.young_modulus;
    if (key == "poisson_ratio" && found.poisson_slope != 0)
      json["poisson_parameter"] = spread.deviation / std::abs(found.poisson_slope);
    if (const LinearHardening* hardening = linear_hardening(found.bonds);
        key == "yield_stress" && hardening != nullptr)
      json["yield_strain"] = fraction * hardening->yield_strain;
    if (const std::optional<double> strain = rupture_strain(found.bonds);
        key == "rupture_strain" && strain)
      json["rupture_strain"] = fraction * *strain;
  }
  return json;
}

Json json_of(const Calibration& found, const CalibrationTargets& targets) {
  const bool with_tension = found.trials.back().is_dynamic && !targets.curve;
  Json mean = Json::object(), deviation = Json::object(), trials = Json::array();
  for (const auto& [key, spread] : spreads(found.figures)) {
    mean[key] = spread.mean;
    deviation[key] = spread.deviation;
  }
  for (const CalibrationTrial& trial : found.trials) {
    trials.push_back({{"test", trial.is_dynamic ? "tension" : "static"},
                      {"parameters", json_of(trial.bonds)},
                      {"figures", json_of(trial.figures, trial.is_dynamic && !targets.curve)},
                      {"wall_seconds", trial.seconds}});
    if (targets.curve && trial.is_dynamic)
      trials.back()["curve"] = curve_json(*targets.curve, trial.figures);
  }
  Json json = {{"parameters", json_of(found.bonds)},
               {"uncertainty", uncertainty_of(found)},
               {"figures", json_of(found.figures, with_tension)},
               {"mean", mean},
               {"deviation", deviation},
               {"misses", found.misses}};
  if (targets.curve) json["curve"] = curve_json(*targets.curve, found.figures);
  json["trials"] = trials;
  return json;
}

std::vector<Specimen> make_specimens(const Scene& scene, int count) {
  if (count > 1 && (!scene.specimen.file.empty() || scene.specimen.shape == "crystal"))
    throw InputError(fmt::format(
        "[calibration] specimens = {}: a {} has no seed, so there is one specimen of it; "
        "expected specimens = 1",
        count, scene.specimen.file.empty() ? "crystal" : "specimen file"));
  std::vector<Specimen> specimens(static_cast<std::size_t>(count));
  for_each_at_once(specimens.size(), [&](std::size_t k) {
    Scene own = scene;
    own.specimen.seed += k;
    specimens[k] = make_body(own);
  });
  return specimens;
}

void print_result(const Calibration& found, const CalibrationTargets& targets,
                  const std::string& file, const std::string& title, const Voice& tell) {
  tell("\n{}:{}\n", title, text_of(found.figures));
  if (targets.curve) print_curve(*targets.curve, found.figures, tell);
  const Json uncertainty = uncertainty_of(found);
  if (!uncertainty.empty()) {
    tell("from specimen to specimen the parameters differ by");
    for (const auto& [key, value] : uncertainty.items())
      tell(" {} ± {:.2g}", key, value.get<double>());
    tell("\n");
  }
  tell("\n{}\n-> {}\n", bond_sections(found.bonds), file);
}

int calibrate_that(const Scene& scene, const CalibrateCommand& command) {
  const Voice tell{command.quiet};
  const auto start = Clock::now();
  if (!scene.calibration && !scene.orthotropic_calibration)
    throw InputError(scene.path +
                     ": nothing to calibrate for; expected a section [calibration] with targets");
  const Setup& setup = scene.setup;
  if (setup.materials.size() > 1)
    throw InputError(
        "[[material]] 2: there are several of them: a bar is calibrated for one; expected "
        "[material]");
  const std::string directory = command.output.empty()
                                    ? std::filesystem::path(scene.path).stem().string() + ".results"
                                    : command.output;
  const ResultsFolder folder(directory, {"calibration.json", "calibrated*.toml"},
                             command.overwrite ? Earlier::replace : Earlier::refuse);
  const std::vector<Specimen> specimens =
      make_specimens(scene, scene.calibration ? scene.calibration->specimens
                                              : scene.orthotropic_calibration->specimens);
  tell("{}: {} specimen(s) of {} elements, {} bonds in the first, from seed {}\n", scene.title,
       specimens.size(), specimens[0].size(), specimens[0].bonds.size(), scene.specimen.seed);
  if (specimens[0].report.count(estimated_volume) != 0)
    throw InputError(
        "[calibration] stress is force over the section of the body, which the "
        "specimen's file does not tell; expected [specimen] shape or volume");
  if (!command.quiet) print_notes(notes_on(specimens[0], specimens[0].bonds));

  if (scene.orthotropic_calibration)
    return calibrate_orthotropic_scene(scene, specimens, directory, folder, tell);

  const CalibrationRequest& request = *scene.calibration;
  const BondParameters bonds{*setup.get<BeamParameters>(), setup.get<PlasticityParameters>(),
                             setup.get<RuptureParameters>(), setup.get<ContactParameters>()};
  std::vector<Calibration> found(request.one_set ? 1 : specimens.size());
  std::mutex printing;
  const auto teller = [&](const std::string& prefix) {
    return [&printing, &tell, &request, prefix](const CalibrationTrial& trial) {
      const std::lock_guard<std::mutex> lock(printing);
      tell("{}{}\n", prefix, text_of(trial, request.targets));
      std::fflush(stdout);
    };
  };
  const auto name = [&](std::size_t k) { return fmt::format("seed {}", scene.specimen.seed + k); };
  for_each_at_once(found.size(), [&](std::size_t k) {
    const std::vector<Specimen> own{specimens[k]};
    found[k] =
        calibrate(request, bonds, setup.materials, setup.gauge, request.one_set ? specimens : own,
                  teller(request.one_set ? "" : name(k) + ": "));
  });

  folder.begin();
  Json results = Json::array();
  std::string misses;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::string file =
        directory + "/calibrated" +
        (request.one_set ? std::string() : fmt::format("_{}", scene.specimen.seed + k)) + ".toml";
    replace_text_file(file, bond_sections(found[k].bonds));
    print_result(found[k], request.targets, file, request.one_set ? "found" : name(k), tell);
    results.push_back(json_of(found[k], request.targets));
    for (const std::string& miss : found[k].misses) misses += "\n  " + miss;
  }
  const double seconds = seconds_since(start);
  write_summary(directory + "/calibration.json", {{"solidem", version()},
                                                  {"scene", scene.path},
                                                  {"set", scene.set},
                                                  {"elements", specimens[0].size()},
                                                  {"specimens", specimens.size()},
                                                  {"seed", scene.specimen.seed},
                                                  {"fit", request.one_set ? "mean" : "each"},
                                                  {"targets", json_of(request.targets)},
                                                  {"results", results},
                                                  {"wall_seconds", seconds},
                                                  {"threads", omp_get_max_threads()},
                                                  {"hardware", to_json(hardware())}});
  tell("in all {:.3g} s\n", seconds);
  if (misses.empty()) return 0;
  throw RunError("[calibration] not every target was met; the nearest parameters are in " +
                 directory + ":" + misses);
}

}  // namespace

int calibrate_scene(const CalibrateCommand& command) {
  if (command.threads > 0) omp_set_num_threads(command.threads);
  const Scene scene = read_scene(command.scene);
  return at_places_of(scene, [&] { return calibrate_that(scene, command); });
}

}  // namespace solidem
