// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/command_line.hpp"

#include <memory>

#include "app/build_details.hpp"
#include "app/commands.hpp"
#include "app/python_commands.hpp"
#include "app/say.hpp"
#include "keys/nearest_name.hpp"

namespace solidem {

namespace {

/// Adds a command whose words are kept in `Words` until it is called.
template <class Words, class Declare>
CLI::App* add(CLI::App& app, Action& chosen, const char* name, const char* description,
              const Declare& declare, const std::function<int(const Words&)>& call) {
  auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand(name, description);
  declare(*command, *words);
  command->callback([&chosen, words, call] { chosen = [words, call] { return call(*words); }; });
  return command;
}

void add_scene(CLI::App& command, SceneSource& scene) {
  command.add_option("scene", scene.path, "scene file (TOML)")->required();
  command
      .add_option(
          "--set", scene.set,
          "a value that holds instead of the file's, such as beams.young_modulus=\"3 TPa\" "
          "or grips.right.velocity.0=\"2 m/s\"; without a value the key goes; several times")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

void add_results(CLI::App& command, std::string& output) {
  command.add_option("-o,--output", output, "folder for the results (default: the scene's name)")
      ->type_name("FOLDER");
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("-t,--threads", threads, "number of threads (default: all processors)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
}

/// `overwrite` says that results of before may go.
CLI::Option* add_overwrite(CLI::App& command, bool& overwrite) {
  return command.add_flag("--overwrite", overwrite, "replace what an earlier call wrote");
}

void add_json(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "for programs, all in SI units");
}

void add_force(CLI::App& command, bool& force) {
  command.add_flag("--force", force, "accept a time step beyond the stable limit");
}

void declare_run(CLI::App& app, Action& chosen) {
  add<RunCommand>(
      app, chosen, "run", "Run a scene",
      [](CLI::App& command, RunCommand& run) {
        add_scene(command, run.scene);
        add_results(command, run.output);
        add_threads(command, run.threads);
        command.add_flag("--resume", run.resume, "go on from the folder's checkpoint")
            ->excludes(add_overwrite(command, run.overwrite));
        add_force(command, run.force);
        command.add_flag("-q,--quiet", run.quiet, "no progress bar");
      },
      run_scene);
}

void declare_explain(CLI::App& app, Action& chosen) {
  add<ExplainCommand>(
      app, chosen, "explain", "Say what a scene simulates, and foretell what it takes",
      [](CLI::App& command, ExplainCommand& explain) {
        add_scene(command, explain.scene);
        add_json(command, explain.json);
        command.add_flag("--quick", explain.quick,
                         "without the trial that foretells cost and flow");
        add_force(command, explain.force);
      },
      [](const ExplainCommand& explain) { return explain_scene(explain), 0; });
}

void declare_specimens(CLI::App& app, Action& chosen) {
  const auto scene_and_file = [](CLI::App& command, SpecimenCommand& words, const char* file) {
    add_scene(command, words.scene);
    command.add_option("-o,--output", words.output, file)->required()->type_name("FILE");
    add_overwrite(command, words.overwrite);
  };
  add<SpecimenCommand>(
      app, chosen, "prepare", "Write a scene's specimen with all that another code needs",
      [&](CLI::App& command, SpecimenCommand& words) {
        scene_and_file(command, words, "specimen file (.h5)");
      },
      [](const SpecimenCommand& words) { return prepare_scene(words), 0; });
  add<SpecimenCommand>(
      app, chosen, "specimen", "Make the specimen of a scene and print its report",
      [&](CLI::App& command, SpecimenCommand& words) {
        scene_and_file(command, words, "specimen file (.h5, .data, .txt, .csv)");
        add_json(command, words.json);
      },
      [](const SpecimenCommand& words) { return make_scene_specimen(words), 0; });
}

void declare_calibrate(CLI::App& app, Action& chosen) {
  add<CalibrateCommand>(
      app, chosen, "calibrate",
      "Find the parameters of the beams that give a body the properties of a material",
      [](CLI::App& command, CalibrateCommand& words) {
        add_scene(command, words.scene);
        add_results(command, words.output);
        add_threads(command, words.threads);
        add_overwrite(command, words.overwrite);
        command.add_flag("-q,--quiet", words.quiet, "print nothing; all is in the folder");
      },
      calibrate_scene);
}

void declare_constants(CLI::App& app, Action& chosen) {
  struct Words {
    SceneSource scene;
    bool json = false;
  };
  add<Words>(
      app, chosen, "constants", "Measure the elastic constants of a periodic body",
      [](CLI::App& command, Words& words) {
        add_scene(command, words.scene);
        add_json(command, words.json);
      },
      [](const Words& words) { return measure_constants(words.scene, words.json), 0; });
}

void declare_solve(CLI::App& app, Action& chosen) {
  add<SolveCommand>(
      app, chosen, "solve", "Find the static equilibrium of a bonded scene at the end of its run",
      [](CLI::App& command, SolveCommand& words) {
        add_scene(command, words.scene);
        add_results(command, words.output);
        command.add_option("--rotations", words.rotations, "small (default) or finite")
            ->check(CLI::IsMember({"small", "finite"}));
        command
            .add_option("--modes", words.modes, "number of natural vibrations to find (default: 0)")
            ->type_name("N")
            ->check(CLI::Range(0, 1000));
        add_threads(command, words.threads);
        add_overwrite(command, words.overwrite);
        command.add_flag("-q,--quiet", words.quiet, "print the result only");
        add_json(command, words.json);
      },
      [](const SolveCommand& words) { return solve_scene(words), 0; });
}

void declare_files(CLI::App& app, Action& chosen) {
  struct Convert {
    std::string from, to;
    bool overwrite = false;
  };
  add<Convert>(
      app, chosen, "convert", "Convert a specimen: .h5, .data (LIGGGHTS), .txt (YADE), .csv",
      [](CLI::App& command, Convert& words) {
        command.add_option("from", words.from, "file to read")->required();
        command.add_option("to", words.to, "file to write")->required();
        add_overwrite(command, words.overwrite);
      },
      [](const Convert& words) {
        return convert_specimen(words.from, words.to, words.overwrite), 0;
      })
      ->footer(specimen_formats());
  struct Info {
    std::string file;
    bool json = false;
  };
  add<Info>(
      app, chosen, "info", "Print the report of a specimen",
      [](CLI::App& command, Info& words) {
        command.add_option("file", words.file, "specimen file")->required();
        add_json(command, words.json);
      },
      [](const Info& words) { return describe_specimen(words.file, words.json), 0; })
      ->footer(specimen_formats());
}

void declare_law_plot(CLI::App& law, Action& chosen) {
  add<LawPlotCommand>(
      law, chosen, "plot", "Force, stiffness and potential of laws, as table and picture",
      [](CLI::App& command, LawPlotCommand& plot) {
        command
            .add_option("laws", plot.words,
                        "names of laws, each with its parameters (mie \"energy=0.1 mJ\" ...), or "
                        "scenes")
            ->required();
        command.add_option("--equilibrium", plot.equilibrium,
                           "distance of equilibrium (default: 0.3 mm; of a scene, two mean radii)");
        command.add_option("--range", plot.range, "range over that distance (default: 1.2)");
        command.add_option("--interpenetration", plot.interpenetration,
                           "overlap below which a law goes on along its tangent (default: 0.1)");
        command.add_option("--from", plot.from, "least distance shown, over that of equilibrium")
            ->check(CLI::NonNegativeNumber);
        command.add_option("--to", plot.to, "largest distance shown, over that of equilibrium")
            ->check(CLI::NonNegativeNumber);
        command.add_option("-o,--output", plot.output, "name of the files, without ending")
            ->required();
        add_overwrite(command, plot.overwrite);
        add_json(command, plot.json);
      },
      [](const LawPlotCommand& plot) { return plot_laws(plot), 0; });
}

void declare_laws(CLI::App& app, Action& chosen) {
  CLI::App* law = app.add_subcommand("law", "Laws of central force: what there is, how they look");
  law->require_subcommand(1);
  struct Words {
    bool json = false;
  };
  add<Words>(
      *law, chosen, "list", "The laws, their parameters, units and meanings",
      [](CLI::App& command, Words& words) { add_json(command, words.json); },
      [](const Words& words) { return list_laws(words.json), 0; });
  declare_law_plot(*law, chosen);
}

void declare_keys(CLI::App& app, Action& chosen) {
  struct Words {
    std::string section;
  };
  add<Words>(
      app, chosen, "keys", "The sections of effects, their keys and defaults",
      [](CLI::App& command, Words& words) {
        command.add_option("section", words.section,
                           "of this section only; 'fields': what [output] fields may name");
      },
      [](const Words& words) { return list_keys(words.section), 0; });
}

/// Their words, --help too, are read by Python.
void declare_python(CLI::App& app, Action& chosen) {
  for (const auto& [name, description] :
       {std::pair("view",
                  "Paint a picture or a film of a run, in Python; more by solidem view --help"),
        std::pair("converge",
                  "What a figure tends to as a scene gets finer, in Python; more by solidem "
                  "converge --help"),
        std::pair("advise",
                  "How fine a scene has to be for an error that is asked for, and what that takes, "
                  "in Python; more by solidem advise --help")}) {
    CLI::App* command = app.add_subcommand(name, description);
    command->prefix_command();
    command->set_help_flag();
    command->callback([&chosen, command] {
      chosen = [command]() -> int { call_python(command->get_name(), command->remaining()); };
    });
  }
}

void declare_help(CLI::App& app, Action& chosen) {
  struct None {};
  add<None>(
      app, chosen, "manual", "Print the manual, as a page for man: solidem manual | man -l -",
      [](CLI::App&, None&) {}, [&app](const None&) { return say("{}", manual_page(app)), 0; });
  add<None>(
      app, chosen, "completion",
      "Print what completes commands in bash: source <(solidem completion)",
      [](CLI::App&, None&) {}, [&app](const None&) { return say("{}", bash_completion(app)), 0; });
}

/// The command that was being read when a word did not fit.
const CLI::App& last_read(const CLI::App& app) {
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  return *at;
}

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  return names;
}

std::string path_of(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  if (parent == nullptr) return "";
  const std::string before = path_of(*parent);
  return (before.empty() ? "" : before + " ") + command.get_name();
}

std::string complaint_of_option(const CLI::App& command, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(command))
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return fmt::format("there is no option {}{}; expected one of {}", word,
                     did_you_mean(word.substr(0, word.find('=')), names), join(names));
}

}  // namespace

void declare_commands(CLI::App& app, Action& chosen) {
  app.set_version_flag(
      "--version", [] { return version_and_build(); }, "print version and build");
  app.require_subcommand(1);
  for (const auto& declare :
       {declare_run, declare_explain, declare_specimens, declare_calibrate, declare_constants,
        declare_solve, declare_files, declare_laws, declare_keys, declare_python, declare_help})
    declare(app, chosen);
}

std::string complaint_of(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = last_read(app);
  const std::string path = path_of(command);
  const std::string opening = path.empty() ? "" : path + ": ";
  const std::vector<std::string> commands = names_of_commands(command), words = app.remaining(true);
  if (!words.empty() && words.front().size() > 1 && words.front()[0] == '-')
    return opening + complaint_of_option(command, words.front());
  if (!commands.empty() && !words.empty())
    return fmt::format("{}there is no command \"{}\"{}; expected one of {}", opening, words.front(),
                       did_you_mean(words.front(), commands), join(commands));
  if (!commands.empty()) return opening + "no command is given; expected one of " + join(commands);
  return fmt::format("{}{}; see solidem {} --help", opening, error.what(), path);
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->nonpositional(); });
}

std::vector<const CLI::Option*> positionals_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

}  // namespace solidem
