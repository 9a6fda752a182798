// SPDX-License-Identifier: GPL-2.0-or-later
#include <pybind11/stl.h>

#include <atomic>
#include <csignal>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "effects/kernels/kernels.hpp"
#include "engine/run.hpp"
#include "model/error.hpp"
#include "module.hpp"
#include "output/results_folder.hpp"
#include "scene/body.hpp"
#include "scene/fingerprint.hpp"
#include "scene/scene.hpp"

namespace solidem::python {

namespace {

namespace py = pybind11;

std::atomic<bool> interrupted{false};

/// While it lives, Ctrl-C ends a run in order, which then tells Python.
class InterruptsRun {
 public:
  InterruptsRun() : before_(std::signal(SIGINT, [](int) { interrupted = true; })) {
    interrupted = false;
  }
  ~InterruptsRun() { std::signal(SIGINT, before_); }
  InterruptsRun(const InterruptsRun&) = delete;
  InterruptsRun& operator=(const InterruptsRun&) = delete;

 private:
  void (*before_)(int);
};

/// What `solidem run` does, without its words. False: interrupted.
bool record(const Scene& scene, const std::string& folder_path, bool overwrite, bool resume,
            bool force, bool quiet) {
  kernels();
  if (!scene.setup.run.duration && !scene.setup.run.steps)
    throw InputError(scene.path +
                     ": nothing says how long to run; expected a section [run] with duration or "
                     "steps");
  RunOptions options;
  options.directory = folder_path;
  options.scene = scene.path;
  options.set = scene.set;
  options.fingerprint = fingerprint(scene);
  options.resume = resume;
  options.quiet = quiet;
  options.interrupted = &interrupted;
  options.ends_program = false;
  const ResultsFolder folder(folder_path, run_results(),
                             resume      ? Earlier::keep
                             : overwrite ? Earlier::replace
                                         : Earlier::refuse);
  Simulation simulation(scene.setup, make_body(scene), force);
  folder.begin();
  return run(simulation, options).completed;
}

void record_in_python(const Scene& scene, const std::string& folder, bool overwrite, bool resume,
                      bool force, bool quiet) {
  bool completed = false;
  {
    const py::gil_scoped_release others_may_run;
    const InterruptsRun interrupts;
    completed =
        at_places_of(scene, [&] { return record(scene, folder, overwrite, resume, force, quiet); });
  }
  if (completed) return;
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

SceneSource source_of(const std::string& path, const std::optional<std::string>& text,
                      const std::vector<std::string>& set) {
  SceneSource source(path);
  source.text = text;
  source.set = set;
  return source;
}

/// The summary as JSON.
std::string solve_silently(const SceneSource& source, const std::string& folder,
                           const std::string& rotations, int modes, bool overwrite) {
  const py::gil_scoped_release others_may_run;
  SolveCommand command;
  command.scene = source;
  command.output = folder;
  command.rotations = rotations;
  command.modes = modes;
  command.overwrite = overwrite;
  command.json = true;
  return solve(command).dump();
}

void calibrate_silently(const SceneSource& source, const std::string& folder, bool overwrite) {
  const py::gil_scoped_release others_may_run;
  CalibrateCommand command;
  command.scene = source;
  command.output = folder;
  command.overwrite = overwrite;
  command.quiet = true;
  calibrate_scene(command);
}

}  // namespace

void add_scenes(py::module_& module) {
  py::class_<SceneSource>(module, "SceneSource")
      .def(py::init(&source_of), py::arg("path"), py::arg("text"), py::arg("set"))
      .def("solve", solve_silently)
      .def("calibrate", calibrate_silently);
  py::class_<Scene>(module, "Scene")
      .def(py::init([](const SceneSource& source) { return read_scene(source); }))
      .def_readonly("title", &Scene::title)
      .def_readonly("path", &Scene::path)
      .def_readonly("set", &Scene::set)
      .def_readonly("record", &Scene::record)
      .def("run", record_in_python);
}

}  // namespace solidem::python
