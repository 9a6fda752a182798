// SPDX-License-Identifier: GPL-2.0-or-later
//
// solidem._core: a thin layer between the library and Python. What a user of Python sees, with its
// words of help, is in solidem/*.py.
#include "module.hpp"

#include <omp.h>

#include "app/build_details.hpp"
#include "effects/kernels/kernels.hpp"
#include "model/error.hpp"
#include "output/summary.hpp"

namespace py = pybind11;

namespace {

/// Exceptions of solidem are Python's, with the same words.
void add_errors(py::module_& module) {
  py::register_exception<solidem::InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<solidem::RunError>(module, "RunError", PyExc_RuntimeError);
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Continuous solids as compact packings of spheres: the compiled part.";
  add_errors(module);
  module.def("version", solidem::version);
  module.def("version_and_build", solidem::version_and_build);
  module.def("instruction_set", [] { return solidem::kernels().instruction_set; });
  module.def("threads", omp_get_max_threads);
  module.def("set_threads", omp_set_num_threads, py::arg("threads"));
  solidem::python::add_scenes(module);
  solidem::python::add_specimens(module);
  solidem::python::add_simulations(module);
}
