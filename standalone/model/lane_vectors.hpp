// SPDX-License-Identifier: GPL-2.0-or-later
//
// Vectors in columns: of lanes, whose x, y and z stand `lanes` doubles apart, and of rows, where
// they follow one another.
#ifndef SOLIDEM_MODEL_LANE_VECTORS_HPP
#define SOLIDEM_MODEL_LANE_VECTORS_HPP

#include "model/slots.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// The vector whose x stands at a place of a column.
inline Vector lanes_vector(const double* column, std::size_t at) {
  return {column[at], column[at + lanes], column[at + std::size_t{2} * lanes]};
}

inline void set_lanes_vector(double* column, std::size_t at, const Vector& v) {
  column[at] = v.x;
  column[at + lanes] = v.y;
  column[at + std::size_t{2} * lanes] = v.z;
}

/// The vector at the start of a row.
inline Vector row_vector(const double* row) {
  return {row[0], row[1], row[2]};
}

}  // namespace solidem

#endif
