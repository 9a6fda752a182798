// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compiled once for each instruction set.
//
// Elements that nothing joins: how they move on, and what loads change of it.
#include <algorithm>

#include "effects/kernels/loose_kernels.hpp"
#include "effects/kernels/pack_vector.hpp"
#include "laws/rigid_sphere.hpp"
#include "model/slots.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

namespace {

/// Vectors of elements in a column of lanes, of which `x` says where x stands.
inline PackVector gather_vector(const double* column, const std::int32_t* x) {
  return {gather(column, x), gather(column + lanes, x),
          gather(column + std::ptrdiff_t{2} * lanes, x)};
}

inline void scatter_vector(const PackVector& vector, double* column, const std::int32_t* x) {
  scatter(vector.x, column, x);
  scatter(vector.y, column + lanes, x);
  scatter(vector.z, column + std::ptrdiff_t{2} * lanes, x);
}

}  // namespace

void move_freely(const FreeMotionColumns& m, std::size_t first, std::size_t last) {
  const Pack time_step(m.time_step);
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const std::size_t at = 3 * block * lanes + static_cast<std::size_t>(lane);
      Row row = Row::load(m.pose + 8 * element);
      add_to_centre(row, time_step * load_vector(m.velocity + at));
      if (m.angular_velocity != nullptr)
        set_orientation(row,
                        turn(orientation(row), load_vector(m.angular_velocity + at), time_step));
      row.store(m.next_pose + 8 * element);
    }
}

void push(const PushedElements& p) {
  const Pack kick(p.kick), time_step(p.time_step);
  for (std::size_t n = 0; n < p.count; n += width) {
    // Lanes beyond the last do once more what it does.
    std::int32_t number[width], element[width], at[width];
    for (int k = 0; k < width; ++k) {
      const std::size_t which = std::min(n + static_cast<std::size_t>(k), p.count - 1);
      number[k] = static_cast<std::int32_t>(which);
      element[k] = p.element[which];
      at[k] = 3 * lanes * (element[k] / lanes) + element[k] % lanes;
    }
    const Row load = Row::gather(p.load, number);
    Row next = Row::gather(p.next_pose, element);
    const PackVector gain = (kick * gather(p.inverse_mass, element)) * centre(load);
    scatter_vector(gather_vector(p.velocity, at) + gain, p.velocity, at);
    add_to_centre(next, time_step * gain);
    if (p.angular_velocity != nullptr) {
      const PackVector moment{load.component[4], load.component[5], load.component[6]};
      const PackVector spin = gather_vector(p.angular_velocity, at) +
                              (kick * gather(p.inverse_inertia, element)) * moment;
      scatter_vector(spin, p.angular_velocity, at);
      set_orientation(next, turn(orientation(Row::gather(p.pose, element)), spin, time_step));
    }
    next.scatter(p.next_pose, element);
  }
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET
