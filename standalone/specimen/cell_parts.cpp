// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/cell_parts.hpp"

#include <utility>

namespace solidem {

namespace {

constexpr double on_plane = 1e-11;  // of a plane, within which corners lie on it

}  // namespace

bool clip(CellPart& part, const Vector& normal, double offset, const CellFace& cut) {
  std::vector<int> source;
  part.solid = clipped(part.solid, normal, offset, on_plane, source);
  std::vector<CellFace> faces;
  for (const int from : source)
    faces.push_back(from < 0 ? cut : part.faces[static_cast<std::size_t>(from)]);
  part.faces = std::move(faces);
  return !part.solid.empty();
}

CellPart multiple_of(const CellPart& part, double factor) {
  CellPart result = part;
  result.sign *= factor;
  for (CellFace& face : result.faces) face.weight *= factor;
  return result;
}

std::vector<FacePlane> planes_of(const Polyhedron& solid) {
  std::vector<FacePlane> planes;
  for (const std::vector<Vector>& face : solid.faces) {
    const Vector area = area_vector(face);
    const double size = norm(area);
    if (!(size > 0)) continue;
    const Vector normal = (1 / size) * area;
    planes.push_back({normal, dot(normal, face[0])});
  }
  return planes;
}

Vector area_vector(const std::vector<Vector>& face) {
  Vector sum{};
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    sum += cross(face[k] - face[0], face[k + 1] - face[0]);
  return 0.5 * sum;
}

}  // namespace solidem
