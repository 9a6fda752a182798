// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_PYTHON_MODULE_HPP
#define SOLIDEM_PYTHON_MODULE_HPP

#include <pybind11/pybind11.h>

namespace solidem::python {

/// Scenes: read, run and recorded, calibrated, solved.
void add_scenes(pybind11::module_& module);

/// Specimens: made, read and written.
void add_specimens(pybind11::module_& module);

/// Simulations, step by step.
void add_simulations(pybind11::module_& module);

}  // namespace solidem::python

#endif
