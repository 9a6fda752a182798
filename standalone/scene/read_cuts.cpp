// SPDX-License-Identifier: GPL-2.0-or-later
//
// [[specimen.cut]].
#include "effects/moving_shape.hpp"
#include "keys/mesh_file.hpp"
#include "keys/rules.hpp"
#include "keys/turn.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

struct ReadCut {
  std::optional<Shape> shape;
  std::string mesh;
  double mesh_unit = 0;
  Vector centre{};
  Quaternion<double> turned{};
  bool takes_touched = false;
};

std::vector<Key> cut_keys(const Section& section, ReadCut& cut, const std::string& scene_file) {
  std::vector<Key> keys{
      may_have("orientation", turn(cut.turned)),
      may_have("takes", choice<bool>(cut.takes_touched, {{"centres", false}, {"touched", true}}))};
  const Rule centre = vector(cut.centre, dimension::length);
  if (section.has("mesh")) {
    keys.push_back(must_have("mesh", path(cut.mesh, scene_file)));
    keys.push_back(must_have("mesh_unit", quantity(cut.mesh_unit, dimension::length, positive)));
    keys.push_back(may_have("centre", centre));
  } else {
    keys.push_back(must_have("shape", shape(cut.shape), "or mesh"));
    keys.push_back(must_have("centre", centre));
  }
  return keys;
}

Cut cut_by_mesh(const ReadCut& read) {
  TriangleMesh mesh = read_closed_mesh(read.mesh, read.mesh_unit);
  for (Vector& vertex : mesh.vertices) vertex = read.centre + rotate(read.turned, vertex);
  Cut cut;
  cut.mesh = std::make_shared<const FacetTree>(std::move(mesh));
  cut.takes_touched = read.takes_touched;
  return cut;
}

}  // namespace

Rule cuts_section(std::vector<Cut>& cuts, const std::string& scene_file) {
  return tables([&cuts, scene_file](const Section& section) {
    ReadCut read;
    section.at_most_one_of({"shape", "mesh"});
    section.read(cut_keys(section, read, scene_file), "a cut");
    if (section.has("mesh")) {
      cuts.push_back(cut_by_mesh(read));
      return;
    }
    for (const Shape::Part& part : read.shape->parts) {
      if (part.is_cut_out)
        section.refuse("shape", "a part of it is cut out",
                       "parts that are all taken out of the body");
      Cut cut{part, read.turned, read.takes_touched};
      cut.part.offset = read.centre + rotate(read.turned, part.offset);
      cuts.push_back(cut);
    }
  });
}

}  // namespace solidem
