// SPDX-License-Identifier: GPL-2.0-or-later
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>

#include "arrays.hpp"
#include "effects/central_forces.hpp"
#include "effects/kernels/kernels.hpp"
#include "engine/simulation.hpp"
#include "model/error.hpp"
#include "module.hpp"
#include "output/checkpoint.hpp"
#include "scene/body.hpp"
#include "scene/fingerprint.hpp"

namespace solidem::python {

namespace {

/// A simulation and what its checkpoints must agree with.
class PythonSimulation {
 public:
  PythonSimulation(const Scene& scene, const Specimen* specimen, bool force)
      : fingerprint_(fingerprint(scene)), simulation_(at_places_of(scene, [&] {
          return Simulation(scene.setup, specimen != nullptr ? *specimen : make_body(scene), force);
        })) {}

  Simulation& operator*() { return simulation_; }
  const Simulation& operator*() const { return simulation_; }
  Simulation* operator->() { return &simulation_; }
  const Simulation* operator->() const { return &simulation_; }

  void write_checkpoint(const std::string& path) const {
    simulation_.check();
    CheckpointHeader header;
    header.step = simulation_.step();
    header.time = simulation_.time();
    header.fingerprint = fingerprint_;
    const std::map<std::string, std::vector<double>> saved = simulation_.save();
    solidem::write_checkpoint(path, header, [&](const CheckpointContents& contents) {
      for (const auto& [name, values] : saved) contents.write(name, values);
    });
  }

  void read_checkpoint(const std::string& path) {
    const CheckpointReader checkpoint(path, fingerprint_);
    std::map<std::string, std::vector<double>> saved;
    for (const auto& [name, values] : simulation_.save())
      saved[name] = checkpoint.read<double>(name);
    simulation_.restore(checkpoint.header().step, saved);
  }

 private:
  std::string fingerprint_;
  Simulation simulation_;
};

std::unique_ptr<PythonSimulation> made(const Scene& scene, const Specimen* specimen, bool force) {
  kernels();  // an impossible choice of instruction set must fail before any work
  const py::gil_scoped_release others_may_run;
  return std::make_unique<PythonSimulation>(scene, specimen, force);
}

/// Steps in strides, so that Ctrl-C is answered: as long as those of `solidem run`.
void step(PythonSimulation& simulation, std::int64_t steps) {
  if (steps < 0) throw InputError("step(" + std::to_string(steps) + "): expected at least 0");
  using Clock = std::chrono::steady_clock;
  constexpr double longest = 0.3, most = 64;  // s, steps
  double seconds_per_step = 1;
  while (steps > 0) {
    const std::int64_t stride = std::min(
        steps, static_cast<std::int64_t>(std::clamp(longest / seconds_per_step, 1.0, most)));
    const auto start = Clock::now();
    {
      const py::gil_scoped_release others_may_run;
      simulation->advance(stride);
    }
    seconds_per_step =
        std::chrono::duration<double>(Clock::now() - start).count() / static_cast<double>(stride);
    steps -= stride;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

py::dict observe(const PythonSimulation& simulation) {
  const HistoryRow row = simulation->observe();
  py::dict values;
  values["step"] = row.step;
  values["time"] = row.time;
  for (const auto& [name, value] : row.values) values[py::str(name)] = value;
  return values;
}

/// What elements do now, which no column holds: forces and moments of neighbours, velocities at the
/// very time.
py::dict motion(const PythonSimulation& simulation) {
  if (!simulation->model().moves())
    throw InputError("nothing moves in this scene: it has no forces");
  Observation observation;
  {
    const py::gil_scoped_release others_may_run;
    simulation->observe(observation);
  }
  py::dict motion;
  motion["forces"] = taken(std::move(observation.motion.force));
  motion["velocities"] = taken(std::move(observation.motion.velocity));
  motion["moments"] = taken(std::move(observation.motion.moment));
  motion["angular_velocities"] = taken(std::move(observation.motion.angular_velocity));
  return motion;
}

/// Columns of one entry for each element.
std::vector<const Column*> columns_of(const Simulation& simulation) {
  std::vector<const Column*> columns = simulation.model().columns();
  columns.erase(std::remove_if(columns.begin(), columns.end(),
                               [](const Column* c) { return c->site != Site::element; }),
                columns.end());
  return columns;
}

/// A column of elements as it lies in memory: rows as (N, components); lanes as (blocks, 8,
/// components), or (N) where each element has one number.
py::array column(const py::object& self, const std::string& name) {
  const Simulation& simulation = **self.cast<const PythonSimulation*>();
  std::string names;
  for (const Column* candidate : columns_of(simulation)) {
    names += (names.empty() ? "" : ", ") + std::string(candidate->name);
    if (name != candidate->name) continue;
    const double* const data = simulation.model().data(*candidate);
    const std::size_t elements = simulation.model().elements();
    const auto components = static_cast<py::ssize_t>(candidate->components);
    constexpr py::ssize_t size = sizeof(double), width = lanes;
    if (candidate->layout == Column::Layout::rows)
      return rows_view(data, elements, static_cast<std::size_t>(components), self);
    if (components == 1) return view(data, {static_cast<py::ssize_t>(elements)}, {size}, self);
    const auto blocks = static_cast<py::ssize_t>((elements + lanes - 1) / lanes);
    return view(data, {blocks, width, components}, {components * width * size, size, width * size},
                self);
  }
  throw InputError("this scene has no column " + name + " of elements; it has " + names);
}

py::list effects_of(const PythonSimulation& simulation) {
  py::list names;
  for (const PlannedEffect& effect : simulation->plan().effects) names.append(effect.name);
  return names;
}

py::list names_of_columns(const PythonSimulation& simulation) {
  py::list names;
  for (const Column* column : columns_of(*simulation)) names.append(column->name);
  return names;
}

py::array pairs_of(const PythonSimulation& simulation) {
  const std::vector<Pair> pairs = simulation->pairs();
  py::array_t<std::int32_t> array({static_cast<py::ssize_t>(pairs.size()), py::ssize_t{2}});
  std::copy(pairs.begin(), pairs.end(), reinterpret_cast<Pair*>(array.mutable_data()));
  return std::move(array);
}

}  // namespace

void add_simulations(py::module_& module) {
  py::class_<PythonSimulation>(module, "Simulation")
      .def(py::init(&made), py::arg("scene"), py::arg("specimen") = nullptr,
           py::arg("force") = false)
      .def("step", step, py::arg("steps") = 1)
      .def("observe", observe)
      .def("_motion", motion)
      .def("check", [](const PythonSimulation& s) { s->check(); })
      .def("column", column, py::arg("name"))
      .def("write_checkpoint", &PythonSimulation::write_checkpoint, py::arg("path"))
      .def("read_checkpoint", &PythonSimulation::read_checkpoint, py::arg("path"))
      .def("__len__", [](const PythonSimulation& s) { return s->model().elements(); })
      .def_property_readonly("columns", names_of_columns)
      .def_property_readonly("effects", effects_of)
      .def_property_readonly("notes", [](const PythonSimulation& s) { return notes_of(*s); })
      .def_property_readonly("pairs", pairs_of)
      .def_property_readonly("bonds",
                             [](const PythonSimulation& s) { return s->model().slots().bonds(); })
      .def_property_readonly("steps_done", [](const PythonSimulation& s) { return s->step(); })
      .def_property_readonly("steps_to_run",
                             [](const PythonSimulation& s) { return s->steps_to_run(); })
      .def_property_readonly("time", [](const PythonSimulation& s) { return s->time(); })
      .def_property_readonly("time_step",
                             [](const PythonSimulation& s) { return s->time_step().value; })
      .def_property_readonly("time_step_limit",
                             [](const PythonSimulation& s) { return s->time_step().limit; })
      .def_property_readonly("moves", [](const PythonSimulation& s) { return s->model().moves(); });
}

}  // namespace solidem::python
