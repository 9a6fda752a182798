// SPDX-License-Identifier: GPL-2.0-or-later
//
// CGAL reads coordinates as doubles where the file has that many digits; a floor that stands at
// 12.3 mm must not stand 1e-7 of that lower.
#include "keys/mesh_file.hpp"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

#include "model/error.hpp"

namespace solidem {

namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Polygon = std::vector<std::size_t>;

[[noreturn]] void refuse(const std::string& path, const std::string& problem) {
  throw InputError(path + ": " + problem);
}

std::string ending(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool read_polygons(const std::string& path, std::ifstream& file, std::vector<Point>& points,
                   std::vector<Polygon>& polygons) {
  const std::string format = ending(path);
  const auto quietly = CGAL::parameters::verbose(false);
  if (format == ".stl") return CGAL::IO::read_STL(file, points, polygons, quietly);
  if (format == ".obj") return CGAL::IO::read_OBJ(file, points, polygons, quietly);
  if (format == ".ply") return CGAL::IO::read_PLY(file, points, polygons, quietly);
  refuse(path, "unknown kind of mesh; expected a file that ends with .stl, .obj or .ply");
}

/// Triangles about the first corner of each polygon.
void add_facets(const std::string& path, const Polygon& polygon, std::size_t vertices,
                TriangleMesh& mesh) {
  for (const std::size_t corner : polygon)
    if (corner >= vertices)
      refuse(path, "facet " + std::to_string(mesh.facets.size() + 1) +
                       " has a corner that is none of its " + std::to_string(vertices) +
                       " vertices");
  for (std::size_t k = 2; k < polygon.size(); ++k)
    mesh.facets.push_back({static_cast<std::int32_t>(polygon[0]),
                           static_cast<std::int32_t>(polygon[k - 1]),
                           static_cast<std::int32_t>(polygon[k])});
}

}  // namespace

TriangleMesh read_mesh(const std::string& path, double unit) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse(path, "is a folder, not a mesh");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, std::string("cannot be read (") + std::strerror(errno) + ")");
  std::vector<Point> points;
  std::vector<Polygon> polygons;
  bool is_read = false;
  try {
    is_read = read_polygons(path, file, points, polygons);
  } catch (const std::bad_alloc&) {
    is_read = false;  // a count that no file can hold
  } catch (const std::length_error&) {
    is_read = false;
  }
  if (!is_read)
    refuse(path, "is no mesh, or is cut short: after " + std::to_string(polygons.size()) +
                     " facets nothing that belongs into a file " + ending(path) + " follows");
  if (points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    refuse(path, "has more vertices than can be counted");
  TriangleMesh mesh;
  for (const Point& p : points) mesh.vertices.push_back({unit * p.x(), unit * p.y(), unit * p.z()});
  for (const Polygon& polygon : polygons) add_facets(path, polygon, points.size(), mesh);
  mesh = welded(mesh);
  const std::string fault = fault_of(mesh);
  if (!fault.empty()) refuse(path, fault);
  return mesh;
}

TriangleMesh read_closed_mesh(const std::string& path, double unit) {
  TriangleMesh mesh = read_mesh(path, unit);
  const std::string gap = gap_of(mesh);
  if (!gap.empty()) refuse(path, gap + "; a body needs a closed surface");
  return mesh;
}

}  // namespace solidem
