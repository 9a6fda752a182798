// SPDX-License-Identifier: GPL-2.0-or-later
//
// Vectors of packs, and their columns of lanes.
#ifndef SOLIDEM_EFFECTS_KERNELS_PACK_VECTOR_HPP
#define SOLIDEM_EFFECTS_KERNELS_PACK_VECTOR_HPP

#include "effects/kernels/pack.hpp"
#include "model/slots.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

using PackVector = Vector3<Pack>;

inline PackVector load_vector(const double* lanes_of_x) {
  return {Pack::load(lanes_of_x), Pack::load(lanes_of_x + lanes),
          Pack::load(lanes_of_x + std::ptrdiff_t{2} * lanes)};
}

inline void store_vector(const PackVector& vector, double* lanes_of_x) {
  vector.x.store(lanes_of_x);
  vector.y.store(lanes_of_x + lanes);
  vector.z.store(lanes_of_x + std::ptrdiff_t{2} * lanes);
}

inline PackVector vector_of(const Quad& quad) {
  return {quad.component[0], quad.component[1], quad.component[2]};
}

/// Of a row of a pose.
inline PackVector centre(const Row& row) {
  return {row.component[0], row.component[1], row.component[2]};
}

inline Quaternion<Pack> orientation(const Row& row) {
  return {row.component[4], {row.component[5], row.component[6], row.component[7]}};
}

inline void set_orientation(Row& row, const Quaternion<Pack>& q) {
  row.component[4] = q.w;
  row.component[5] = q.v.x;
  row.component[6] = q.v.y;
  row.component[7] = q.v.z;
}

inline void add_to_centre(Row& row, const PackVector& way) {
  row.component[0] += way.x;
  row.component[1] += way.y;
  row.component[2] += way.z;
}

inline PackVector select(Mask condition, const PackVector& a, const PackVector& b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
