// SPDX-License-Identifier: GPL-2.0-or-later
//
// Memory of solidem as arrays of numpy, without a copy.
#ifndef SOLIDEM_PYTHON_ARRAYS_HPP
#define SOLIDEM_PYTHON_ARRAYS_HPP

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <utility>
#include <vector>

#include "model/specimen.hpp"

namespace solidem::python {

namespace py = pybind11;

/// A view of memory that `owner` holds and that lives as long as the view does. Nobody writes
/// through it. Strides in bytes.
template <class T>
py::array view(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
               const py::handle& owner) {
  py::array array(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The same of rows that follow each other.
template <class T>
py::array rows_view(const T* data, std::size_t rows, std::size_t columns, const py::handle& owner) {
  const auto size = static_cast<py::ssize_t>(sizeof(T));
  const auto width = static_cast<py::ssize_t>(columns);
  return view(data, {static_cast<py::ssize_t>(rows), width}, {width * size, size}, owner);
}

/// Vectors that nobody else needs, (N, 3): the array takes them over.
inline py::array taken(std::vector<Vector> values) {
  auto* const kept = new std::vector<Vector>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Vector>*>(p); });
  return py::array(
      py::dtype::of<double>(), {static_cast<py::ssize_t>(kept->size()), py::ssize_t{3}},
      {static_cast<py::ssize_t>(sizeof(Vector)), py::ssize_t{sizeof(double)}}, kept->data(), owner);
}

}  // namespace solidem::python

#endif
