// SPDX-License-Identifier: GPL-2.0-or-later
//
// The commands of the program, one function each. They print to stdout, warn on stderr, and throw
// InputError and RunError. None replaces what an earlier call wrote unless told to overwrite it.
#ifndef SOLIDEM_APP_COMMANDS_HPP
#define SOLIDEM_APP_COMMANDS_HPP

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace solidem {

struct RunCommand {
  SceneSource scene;
  std::string output;
  int threads = 0;
  bool resume = false, overwrite = false, force = false, quiet = false;
};
/// `solidem run`; the exit status: 0, or 130 when interrupted.
int run_scene(const RunCommand& command);

struct ExplainCommand {
  SceneSource scene;
  bool json = false;
  bool force = false;  ///< accept a time step beyond the stable limit
  bool quick = false;  ///< try nothing, foretell nothing
};
/// `solidem explain`: what acts and why, columns and bytes, time step; from a trial of the run's
/// beginning what it will cost, and whether the grips will make the body flow or break.
void explain_scene(const ExplainCommand& command);

struct SpecimenCommand {
  SceneSource scene;
  std::string output;
  bool overwrite = false, json = false;
};
/// `solidem prepare`: the specimen with all that another code needs.
void prepare_scene(const SpecimenCommand& command);

/// `solidem specimen`: makes a scene's packing and prints its report.
void make_scene_specimen(const SpecimenCommand& command);

struct CalibrateCommand {
  SceneSource scene;
  std::string output;
  int threads = 0;
  bool overwrite = false, quiet = false;
};
/// `solidem calibrate`: the parameters of the beams with which a body has given properties. The
/// exit status.
int calibrate_scene(const CalibrateCommand& command);

/// `solidem constants`: the elastic constants of a periodic body along the axes of its grain.
void measure_constants(const SceneSource& scene, bool json);

struct SolveCommand {
  SceneSource scene;
  std::string output;
  std::string rotations = "small";  ///< or "finite"
  int modes = 0;                    ///< natural vibrations to find
  int threads = 0;
  bool overwrite = false;
  bool quiet = false;  ///< prints nothing of the way there
  bool json = false;   ///< prints the summary alone
};
/// The static equilibrium of a bonded scene at the end of its run; its summary.
nlohmann::ordered_json solve(const SolveCommand& command);
/// `solidem solve`.
void solve_scene(const SolveCommand& command);

/// `solidem law list`: laws of central force, their parameters, units and meanings.
void list_laws(bool json);

struct LawPlotCommand {
  std::vector<std::string> words;  ///< names of laws and their parameters, scene files
  std::string equilibrium, range, interpenetration;  ///< "": what the scene says, or the default
  double from = -1, to = -1;  ///< over the distance of equilibrium; below 0: what shows most
  std::string output;         ///< without its ending
  bool overwrite = false, json = false;
};
/// `solidem law plot`: force, stiffness and potential as CSV and SVG.
void plot_laws(const LawPlotCommand& command);

/// `solidem keys`: the sections of effects, their keys and defaults, and the fields of frames, as
/// Markdown; "": of all.
void list_keys(const std::string& section);

/// The formats of specimens, their columns and units, to print.
std::string specimen_formats();

/// `solidem convert`, `solidem info`.
void convert_specimen(const std::string& from, const std::string& to, bool overwrite);
void describe_specimen(const std::string& file, bool json);

}  // namespace solidem

#endif
