// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/outline_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "model/error.hpp"
#include "output/hdf5.hpp"
#include "specimen/domain_file.hpp"

namespace solidem {

namespace {

const std::array<std::pair<const char*, Shape::Kind>, 3> cut_kinds{
    {{"sphere", Shape::Kind::sphere},
     {"cylinder", Shape::Kind::cylinder},
     {"box", Shape::Kind::box}}};

std::vector<double> row_of(const Quaternion<double>& q) {
  return {q.w, q.v.x, q.v.y, q.v.z};
}

Quaternion<double> read_turn(const Hdf5Group& group) {
  const std::vector<double> q = group.numbers_attribute("turned", 4);
  return {q[0], {q[1], q[2], q[3]}};
}

bool is_rotation(const Quaternion<double>& turned) {
  return std::abs(turned.w * turned.w + dot(turned.v, turned.v) - 1) < 1e-9;
}

void write_facets(const Hdf5Group& group, const TriangleMesh& mesh) {
  group.write("vertices", &mesh.vertices[0].x, {mesh.vertices.size(), 3});
  group.write("facets", &mesh.facets[0][0], {mesh.facets.size(), 3});
}

std::shared_ptr<const FacetTree> read_facets(const Hdf5Group& group) {
  TriangleMesh mesh;
  const std::vector<double> vertices = group.read<double>("vertices", Hdf5Group::any_rows, 3);
  for (std::size_t k = 0; k + 2 < vertices.size(); k += 3)
    mesh.vertices.push_back({vertices[k], vertices[k + 1], vertices[k + 2]});
  const std::vector<std::int32_t> facets =
      group.read<std::int32_t>("facets", Hdf5Group::any_rows, 3);
  for (std::size_t k = 0; k + 2 < facets.size(); k += 3)
    mesh.facets.push_back({facets[k], facets[k + 1], facets[k + 2]});
  std::string fault = mesh.facets.empty() ? "it has no facets" : fault_of(mesh);
  if (fault.empty()) fault = gap_of(mesh);
  if (!fault.empty()) throw InputError(group.where() + ": " + fault + "; expected a closed mesh");
  return std::make_shared<const FacetTree>(std::move(mesh));
}

void write_cut(const Hdf5Group& group, const Cut& cut) {
  group.set_attribute("takes_touched", cut.takes_touched ? 1 : 0);
  if (cut.mesh != nullptr) {
    group.set_attribute("kind", "mesh");
    write_facets(group, cut.mesh->mesh());
    return;
  }
  for (const auto& [name, kind] : cut_kinds)
    if (kind == cut.part.kind) group.set_attribute("kind", name);
  group.set_attribute("radius", cut.part.radius);
  group.set_attribute("axis", cut.part.axis);
  group.set_attribute("length", cut.part.length);
  group.set_attribute("size", row_of(cut.part.size));
  group.set_attribute("centre", row_of(cut.part.offset));
  group.set_attribute("turned", row_of(cut.turned));
}

bool bounds_a_solid(const Cut& cut) {
  const auto is_length = [](double length) { return length > 0 && std::isfinite(length); };
  const Shape::Part& part = cut.part;
  if (!is_rotation(cut.turned) || !std::isfinite(norm(part.offset))) return false;
  if (part.kind == Shape::Kind::box)
    return is_length(part.size.x) && is_length(part.size.y) && is_length(part.size.z);
  return is_length(part.radius) && part.length > 0;
}

Cut read_cut(const Hdf5Group& group) {
  Cut cut;
  cut.takes_touched = group.integer_attribute("takes_touched") != 0;
  const std::string named = group.text_attribute("kind");
  if (named == "mesh") {
    cut.mesh = read_facets(group);
    return cut;
  }
  bool is_known = false;
  for (const auto& [name, kind] : cut_kinds)
    if (named == name) {
      cut.part.kind = kind;
      is_known = true;
    }
  cut.part.radius = group.number_attribute("radius");
  cut.part.axis = static_cast<int>(group.integer_attribute("axis"));
  cut.part.length = group.number_attribute("length");
  cut.part.size = read_vector(group, "size");
  cut.part.offset = read_vector(group, "centre");
  cut.turned = read_turn(group);
  if (!is_known || cut.part.axis < 0 || cut.part.axis > 2 || !bounds_a_solid(cut))
    throw InputError(fmt::format(
        "{}: a cut of kind \"{}\" that is no solid; expected a sphere, cylinder or box with "
        "measures above zero and a rotation, or a mesh",
        group.where(), named));
  return cut;
}

void write_body(const Hdf5Group& group, const PlacedOutline& body) {
  group.set_attribute("turned", row_of(body.turned));
  group.set_attribute("shift", row_of(body.shift));
  write_domain(group.make_group("domain"), body.domain);
  if (body.outline != nullptr) write_outline(group, *body.outline);
}

PlacedOutline read_body(const Hdf5Group& group) {
  PlacedOutline body;
  body.turned = read_turn(group);
  body.shift = read_vector(group, "shift");
  body.domain = read_domain(group.group("domain"));
  body.outline = read_outline(group, body.domain);
  if (!is_rotation(body.turned) || !std::isfinite(norm(body.shift)))
    throw InputError(group.where() + ": a place that is none; expected a rotation and a shift");
  return body;
}

}  // namespace

void write_outline(const Hdf5Group& file, const Outline& outline) {
  const Hdf5Group group = file.make_group("outline");
  if (outline.surface != nullptr)
    write_facets(group.make_group("surface"), outline.surface->mesh());
  for (std::size_t k = 0; k < outline.cuts.size(); ++k)
    write_cut(group.make_group(fmt::format("cuts/{:06}", k)), outline.cuts[k]);
  for (std::size_t b = 0; b < outline.bodies.size(); ++b)
    write_body(group.make_group(fmt::format("bodies/{:06}", b)), outline.bodies[b]);
}

std::shared_ptr<const Outline> read_outline(const Hdf5Group& file, const Domain& body) {
  if (!file.has("outline")) return nullptr;
  const Hdf5Group group = file.group("outline");
  Outline outline;
  if (group.has("surface")) outline.surface = read_facets(group.group("surface"));
  if (group.has("cuts")) {
    const Hdf5Group cuts = group.group("cuts");
    for (const std::string& name : cuts.names()) outline.cuts.push_back(read_cut(cuts.group(name)));
  }
  if (group.has("bodies")) {
    const Hdf5Group bodies = group.group("bodies");
    for (const std::string& name : bodies.names())
      outline.bodies.push_back(read_body(bodies.group(name)));
  }
  const bool is_mesh = outline.surface != nullptr;
  if (is_mesh != (body.shape == "mesh") ||
      outline.cuts.size() != static_cast<std::size_t>(body.cuts))
    throw InputError(fmt::format(
        "{}: has {} cuts and {} mesh, but the body is a {} with {} cuts: expected the "
        "outline of the body",
        group.where(), outline.cuts.size(), is_mesh ? "a" : "no", body.shape, body.cuts));
  return std::make_shared<const Outline>(std::move(outline));
}

}  // namespace solidem
