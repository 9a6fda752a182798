// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/notes.hpp"
#include "app/print_json.hpp"
#include "app/say.hpp"
#include "effects/beam_parameters.hpp"
#include "model/error.hpp"
#include "model/seconds_since.hpp"
#include "scene/body.hpp"
#include "solve/calibration/orthotropic_calibration.hpp"
#include "specimen/bonds.hpp"
#include "specimen/pieces.hpp"

namespace solidem {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Vector& v) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x + 0.0, v.y + 0.0, v.z + 0.0);
}

void measure(const Scene& scene, bool json) {
  if (!scene.setup.get<BeamParameters>())
    throw InputError(scene.path + ": nothing is elastic; expected a section [beams]");
  const BeamParameters& beams = *scene.setup.get<BeamParameters>();
  const Specimen specimen = make_body(scene);
  const GrainAxes<double> axes =
      beams.anisotropy ? beams.anisotropy->axes : GrainAxes<double>{{1, 0, 0}, {0, 1, 0}};
  const auto fibres = std::count_if(specimen.bonds.begin(), specimen.bonds.end(),
                                    [&](Pair pair) { return is_fibre(specimen, pair); });
  const auto start = Clock::now();
  const EffectiveStiffness measured = effective_stiffness(beam_network(beams, specimen), axes);
  const OrthotropicConstants constants = orthotropic_constants(measured.stiffness);
  const double seconds = seconds_since(start);
  const NineConstants nine = nine_constants(constants);

  if (json) {
    Json figures = Json::object();
    for (std::size_t c = 0; c < 9; ++c) figures[constant_names[c]] = nine[c];
    print_json({{"scene", scene.title},
                {"elements", specimen.size()},
                {"bonds", specimen.bonds.size()},
                {"fibres", fibres},
                {"axes",
                 {{"L", json_of(axes.longitudinal)},
                  {"R", json_of(axes.radial)},
                  {"T", json_of(axes.tangential())}}},
                {"constants", figures},
                {"stiffness", measured.stiffness},
                {"compliance", inverse(measured.stiffness)},
                {"coupling", constants.coupling},
                {"asymmetry", measured.asymmetry},
                {"wall_seconds", seconds}});
    return;
  }
  say("{}: {} elements, {} bonds of which {} are fibres\n", scene.title, specimen.size(),
      specimen.bonds.size(), fibres);
  print_notes(notes_on(specimen, specimen.bonds));
  say("L {}  R {}  T {}\n", text_of(axes.longitudinal), text_of(axes.radial),
      text_of(axes.tangential()));
  for (std::size_t c = 0; c < 9; ++c)
    say("{:<6} {:.5g}{}\n", constant_names[c], c < 6 ? nine[c] / 1e9 : nine[c],
        c < 6 ? " GPa" : "");
  say("E_L/E_T {:.4g}, E_L/G_LT {:.4g}; from an orthotropic body {:.2g}  ({:.2g} s)\n",
      nine[0] / nine[2], nine[0] / nine[4], constants.coupling, seconds);
}

}  // namespace

void measure_constants(const SceneSource& source, bool json) {
  const Scene scene = read_scene(source);
  at_places_of(scene, [&] { measure(scene, json); });
}

}  // namespace solidem
