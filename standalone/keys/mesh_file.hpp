// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_KEYS_MESH_FILE_HPP
#define SOLIDEM_KEYS_MESH_FILE_HPP

#include <string>

#include "model/triangle_mesh.hpp"

namespace solidem {

/// Reads a surface of triangles from a file of the format STL (text or binary), OBJ or PLY, known
/// by its ending. `unit`: length of one unit of the file, m. Polygons with more corners are split
/// into triangles. Throws InputError that names the file when it cannot be read or is no surface
/// (model/triangle_mesh.hpp, fault_of); it may be open.
TriangleMesh read_mesh(const std::string& path, double unit);

/// The same; throws InputError also where the mesh is not closed.
TriangleMesh read_closed_mesh(const std::string& path, double unit);

}  // namespace solidem

#endif
