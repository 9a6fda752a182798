// SPDX-License-Identifier: GPL-2.0-or-later
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "module.hpp"
#include "scene/body.hpp"
#include "specimen/bonds.hpp"
#include "specimen/pieces.hpp"
#include "specimen/report.hpp"
#include "specimen/specimen_file.hpp"

namespace solidem::python {

namespace {

Specimen made(const Scene& scene) {
  const py::gil_scoped_release others_may_run;
  Specimen specimen = make_body(scene);
  measure_specimen(specimen);
  return specimen;
}

/// As `solidem info` does: spheres that come without bonds are joined where they touch.
Specimen read_with_bonds(const std::string& path) {
  const py::gil_scoped_release others_may_run;
  Specimen specimen = read_specimen(path);
  if (specimen.bonds.empty()) make_bonds(specimen, 0, BondImages::several);
  measure_specimen(specimen);
  return specimen;
}

const Specimen& specimen_of(const py::object& self) {
  return self.cast<const Specimen&>();
}

py::array positions(const py::object& self) {
  const Specimen& specimen = specimen_of(self);
  return rows_view(reinterpret_cast<const double*>(specimen.position.data()), specimen.size(), 3,
                   self);
}

py::array radii(const py::object& self) {
  const Specimen& specimen = specimen_of(self);
  return view(specimen.radius.data(), {static_cast<py::ssize_t>(specimen.size())},
              {py::ssize_t{sizeof(double)}}, self);
}

py::array bonds(const py::object& self) {
  const Specimen& specimen = specimen_of(self);
  return rows_view(reinterpret_cast<const std::int32_t*>(specimen.bonds.data()),
                   specimen.bonds.size(), 2, self);
}

py::tuple tuple_of(const Vector& v) {
  return py::make_tuple(v.x, v.y, v.z);
}

}  // namespace

void add_specimens(py::module_& module) {
  py::class_<Specimen>(module, "Specimen")
      .def(py::init(&made), py::arg("scene"))
      .def(py::init<const Specimen&>(), py::arg("specimen"))
      .def_static("read", read_with_bonds, py::arg("path"))
      .def("write", [](const Specimen& s, const std::string& path) { write_specimen(path, s); })
      .def("__len__", &Specimen::size)
      .def_property_readonly("positions", positions)
      .def_property_readonly("radii", radii)
      .def_property_readonly("bonds", bonds)
      .def_readonly("sets", &Specimen::sets)
      .def_readonly("report", &Specimen::report)
      .def_property_readonly("shape", [](const Specimen& s) { return s.domain.shape; })
      .def_property_readonly("volume", [](const Specimen& s) { return s.domain.volume; })
      .def_property_readonly("lower", [](const Specimen& s) { return tuple_of(s.domain.lower); })
      .def_property_readonly("upper", [](const Specimen& s) { return tuple_of(s.domain.upper); })
      .def_property_readonly("periodic", [](const Specimen& s) { return s.domain.periodic; })
      .def_property_readonly("notes", [](const Specimen& s) { return notes_on(s, s.bonds); })
      .def("report_text", format_report);
}

}  // namespace solidem::python
