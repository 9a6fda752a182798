// SPDX-License-Identifier: GPL-2.0-or-later
#include <unistd.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>

#include "app/commands.hpp"
#include "app/standard_streams.hpp"
#include "keys/nearest_name.hpp"
#include "model/error.hpp"
#include "output/summary.hpp"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace {

/// Threads that wait for the next loop spin only shortly: long spinning takes the processor from
/// whatever else runs, and from the very thread that is waited for. OpenMP reads this before main
/// begins, so the program starts itself again.
void wait_patiently(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  setenv("GOMP_SPINCOUNT", "2000", 1);  // some microseconds: what a loop of a small body takes
  execv("/proc/self/exe", argv);        // where that cannot be, all goes on as it is
}

/// The flag of every command that writes: `overwrite` says that results of before may go.
CLI::Option* add_overwrite(CLI::App* command, bool& overwrite) {
  return command->add_flag("--overwrite", overwrite, "replace what an earlier call wrote");
}

}  // namespace

int main(int argc, char** argv) {
  wait_patiently(argv);
  solidem::secure_standard_streams();
#if defined(__GLIBC__)
  // Arrays larger than this get pages of their own, which go back to the system when they are
  // freed; left to itself glibc would soon keep them.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
  CLI::App app{"solidem: continuous solids as compact packings of spheres"};
  app.set_version_flag("--version", solidem::version());
  app.require_subcommand(1);
  std::function<int()> chosen;

  solidem::RunCommand run;
  auto* run_app = app.add_subcommand("run", "Run a scene");
  run_app->add_option("scene", run.scene, "scene file (TOML)")->required();
  run_app->add_option("-o,--output", run.output,
                      "folder for the results (default: the scene's name)");
  run_app->add_option("-t,--threads", run.threads, "number of threads (default: all processors)")
      ->check(CLI::Range(1, 4096));
  run_app->add_flag("--resume", run.resume, "go on from the folder's checkpoint")
      ->excludes(add_overwrite(run_app, run.overwrite));
  run_app->add_flag("--force", run.force, "accept a time step beyond the stable limit");
  run_app->add_flag("-q,--quiet", run.quiet, "no progress bar");
  run_app->callback([&] { chosen = [&] { return solidem::run_scene(run); }; });

  std::string scene, output, from, to;
  bool json = false, overwrite = false;
  solidem::ExplainCommand explain;
  auto* explain_app =
      app.add_subcommand("explain", "Say what a scene simulates, and foretell what it takes");
  explain_app->add_option("scene", explain.scene, "scene file (TOML)")->required();
  explain_app->add_flag("--json", explain.json, "for programs, all in SI units");
  explain_app->add_flag("--quick", explain.quick, "without the trial that foretells cost and flow");
  explain_app->add_flag("--force", explain.force, "accept a time step beyond the stable limit");
  explain_app->callback([&] { chosen = [&] { return solidem::explain_scene(explain), 0; }; });

  auto* prepare =
      app.add_subcommand("prepare", "Write a scene's specimen with all that another code needs");
  prepare->add_option("scene", scene, "scene file (TOML)")->required();
  prepare->add_option("-o,--output", output, "specimen file (.h5)")->required();
  add_overwrite(prepare, overwrite);
  prepare->callback(
      [&] { chosen = [&] { return solidem::prepare_scene(scene, output, overwrite), 0; }; });

  auto* specimen =
      app.add_subcommand("specimen", "Make the specimen of a scene and print its report");
  specimen->add_option("scene", scene, "scene file (TOML)")->required();
  specimen->add_option("-o,--output", output, "specimen file (.h5, .data, .txt, .csv)")->required();
  add_overwrite(specimen, overwrite);
  specimen->callback(
      [&] { chosen = [&] { return solidem::make_scene_specimen(scene, output, overwrite), 0; }; });

  solidem::CalibrateCommand calibrate;
  auto* calibrate_app = app.add_subcommand(
      "calibrate",
      "Find the parameters of the beams that give a body the properties of a material");
  calibrate_app->add_option("scene", calibrate.scene, "scene file (TOML)")->required();
  calibrate_app->add_option("-o,--output", calibrate.output,
                            "folder for the results (default: the scene's name)");
  calibrate_app->add_option("-t,--threads", calibrate.threads, "number of threads")
      ->check(CLI::Range(1, 4096));
  add_overwrite(calibrate_app, calibrate.overwrite);
  calibrate_app->callback([&] { chosen = [&] { return solidem::calibrate_scene(calibrate); }; });

  auto* constants =
      app.add_subcommand("constants", "Measure the elastic constants of a periodic body");
  constants->add_option("scene", scene, "scene file (TOML)")->required();
  constants->add_flag("--json", json, "for programs, all in SI units");
  constants->callback([&] { chosen = [&] { return solidem::measure_constants(scene, json), 0; }; });

  solidem::SolveCommand solve;
  auto* solve_app = app.add_subcommand(
      "solve", "Find the static equilibrium of a bonded scene at the end of its run");
  solve_app->add_option("scene", solve.scene, "scene file (TOML)")->required();
  solve_app->add_option("-o,--output", solve.output,
                        "folder for the results (default: the scene's name)");
  solve_app->add_option("--rotations", solve.rotations, "small (default) or finite")
      ->check(CLI::IsMember({"small", "finite"}));
  solve_app->add_option("--modes", solve.modes, "number of natural vibrations to find (default: 0)")
      ->check(CLI::Range(0, 1000));
  solve_app
      ->add_option("-t,--threads", solve.threads, "number of threads (default: all processors)")
      ->check(CLI::Range(1, 4096));
  add_overwrite(solve_app, solve.overwrite);
  solve_app->add_flag("-q,--quiet", solve.quiet, "print the result only");
  solve_app->callback([&] { chosen = [&] { return solidem::solve_scene(solve), 0; }; });

  auto* convert =
      app.add_subcommand("convert", "Convert a specimen: .h5, .data (LIGGGHTS), .txt (YADE), .csv");
  convert->footer(solidem::specimen_formats());
  convert->add_option("from", from, "file to read")->required();
  convert->add_option("to", to, "file to write")->required();
  add_overwrite(convert, overwrite);
  convert->callback(
      [&] { chosen = [&] { return solidem::convert_specimen(from, to, overwrite), 0; }; });

  auto* law = app.add_subcommand("law", "Laws of central force: what there is, how they look");
  law->require_subcommand(1);
  auto* law_list = law->add_subcommand("list", "The laws, their parameters, units and meanings");
  law_list->callback([&] { chosen = [&] { return solidem::list_laws(), 0; }; });
  solidem::LawPlotCommand plot;
  auto* law_plot =
      law->add_subcommand("plot", "Force, stiffness and potential of laws, as table and picture");
  law_plot
      ->add_option("laws", plot.words,
                   "names of laws, each with its parameters (mie \"energy=0.1 mJ\" ...), or scenes")
      ->required();
  law_plot->add_option("--equilibrium", plot.equilibrium,
                       "distance of equilibrium (default: 0.3 mm; of a scene, two mean radii)");
  law_plot->add_option("--range", plot.range, "range over that distance (default: 1.2)");
  law_plot->add_option("--interpenetration", plot.interpenetration,
                       "overlap below which a law goes on along its tangent (default: 0.1)");
  law_plot->add_option("--from", plot.from, "least distance shown, over that of equilibrium")
      ->check(CLI::NonNegativeNumber);
  law_plot->add_option("--to", plot.to, "largest distance shown, over that of equilibrium")
      ->check(CLI::NonNegativeNumber);
  law_plot->add_option("-o,--output", plot.output, "name of the files, without ending")->required();
  add_overwrite(law_plot, plot.overwrite);
  law_plot->callback([&] { chosen = [&] { return solidem::plot_laws(plot), 0; }; });

  std::string section;
  auto* keys = app.add_subcommand("keys", "The sections of effects, their keys and defaults");
  keys->add_option("section", section, "of this section only");
  keys->callback([&] { chosen = [&] { return solidem::list_keys(section), 0; }; });

  auto* info = app.add_subcommand("info", "Print the report of a specimen");
  info->add_option("file", from, "specimen file")->required();
  info->footer(solidem::specimen_formats());
  info->callback([&] { chosen = [&] { return solidem::describe_specimen(from), 0; }; });

  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' &&
      std::find(names.begin(), names.end(), argv[1]) == names.end()) {
    std::fprintf(stderr, "error: there is no command \"%s\"%s; expected one of %s\n", argv[1],
                 solidem::did_you_mean(argv[1], names).c_str(), solidem::join(names).c_str());
    return 2;
  }
  CLI11_PARSE(app, argc, argv);
  try {
    return solidem::status_with_output(chosen());
  } catch (const solidem::InputError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  } catch (const solidem::RunError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "error: out of memory; fewer elements, or a larger machine\n");
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "internal error: %s\n", error.what());
    return 3;
  }
}
