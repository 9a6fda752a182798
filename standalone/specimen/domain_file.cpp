// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/domain_file.hpp"

#include "output/hdf5.hpp"

namespace solidem {

std::vector<double> row_of(const Vector& v) {
  return {v.x, v.y, v.z};
}

Vector read_vector(const Hdf5Group& group, const std::string& name) {
  const std::vector<double> v = group.numbers_attribute(name, 3);
  return {v[0], v[1], v[2]};
}

void write_domain(const Hdf5Group& group, const Domain& body) {
  group.set_attribute("shape", body.shape);
  group.set_attribute("lower", row_of(body.lower));
  group.set_attribute("upper", row_of(body.upper));
  group.set_attribute(
      "periodic", std::vector<std::uint8_t>{body.periodic[0], body.periodic[1], body.periodic[2]});
  group.set_attribute("volume", body.volume);
  group.set_attribute("axis", body.axis);
  group.set_attribute("radius", body.radius);
  group.set_attribute("inner_radius", body.inner_radius);
  group.set_attribute("angle", body.angle);
  if (body.cuts > 0) group.set_attribute("cuts", body.cuts);
}

Domain read_domain(const Hdf5Group& group) {
  Domain body;
  body.shape = group.text_attribute("shape");
  body.lower = read_vector(group, "lower");
  body.upper = read_vector(group, "upper");
  const std::vector<double> periodic = group.numbers_attribute("periodic", 3);
  for (int axis = 0; axis < 3; ++axis) body.periodic[axis] = periodic[axis] != 0;
  body.volume = group.number_attribute("volume");
  body.axis = static_cast<int>(group.integer_attribute("axis"));
  body.radius = group.number_attribute("radius");
  if (group.has_attribute("inner_radius"))
    body.inner_radius = group.number_attribute("inner_radius");
  if (group.has_attribute("cuts")) body.cuts = static_cast<int>(group.integer_attribute("cuts"));
  if (group.has_attribute("angle")) body.angle = group.number_attribute("angle");
  return body;
}

}  // namespace solidem
