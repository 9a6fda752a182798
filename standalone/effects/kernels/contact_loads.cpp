// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compiled once for each instruction set.
//
// Contacts of elements that no bond joins: of a block of pairs those that touch are picked out,
// then the law is evaluated for a pack of them at a time. Each pair is looked at once; elements
// sum afterwards what acts on them.
#include <algorithm>

#include "effects/kernels/loose_kernels.hpp"
#include "effects/kernels/pack_vector.hpp"
#include "laws/linear_contact.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

namespace {

inline PackVector centres(const double* pose, const std::int32_t* element) {
  return vector_of(Quad::gather<8>(pose, element));
}

/// Numbers of the pairs from first to last that touch, or did when they were last looked at.
inline std::size_t pick_touching(const ContactColumns& c, std::size_t first, std::size_t last,
                                 std::uint32_t* picked) {
  std::size_t count = 0;
  for (std::size_t k = first; k < last; k += width) {
    PackVector to = centres(c.pose, c.element_j + k) - centres(c.pose, c.element_i + k);
    if (c.shift_x != nullptr)
      to += PackVector{Pack::load_anywhere(c.shift_x + k), Pack::load_anywhere(c.shift_y + k),
                       Pack::load_anywhere(c.shift_z + k)};
    const Pack distance = Pack::load_anywhere(c.distance + k);
    const Mask touches = greater(distance * distance, dot(to, to));
    count += write_numbers(either(touches, is_set(c.acts + k)), k, picked + count);
  }
  return count;
}

/// A pack of pairs and their elements.
struct PickedPairs {
  std::int32_t number[width], i[width], j[width];

  /// Lanes beyond those used do once more what the last of these does.
  PickedPairs(const ContactColumns& c, const std::uint32_t* picked, std::size_t used) {
    for (std::size_t k = 0; k < width; ++k) {
      const std::uint32_t pair = picked[std::min(k, used - 1)];
      number[k] = static_cast<std::int32_t>(pair);
      i[k] = c.element_i[pair];
      j[k] = c.element_j[pair];
    }
  }
};

/// A pack of elements as contacts see them.
struct MovingElement {
  PackVector velocity, spin;
  Pack inverse_mass, radius;

  explicit MovingElement(const Row& row)
      : velocity{row.component[0], row.component[1], row.component[2]},
        spin{row.component[4], row.component[5], row.component[6]},
        inverse_mass(row.component[3]),
        radius(row.component[7]) {}
};

/// A pack of contacts: what the law says, and where its forces act.
struct ContactPack {
  ContactResponse<Pack> response;
  PackVector moment;  ///< of the force, for an arm of 1 m
  Pack arm_i, arm_j;  ///< m
  Mask touches;
};

inline ContactPack contact_pack(const ContactColumns& c, const PickedPairs& at) {
  PackVector to = centres(c.pose, at.j) - centres(c.pose, at.i);
  if (c.shift_x != nullptr)
    to += PackVector{gather(c.shift_x, at.number), gather(c.shift_y, at.number),
                     gather(c.shift_z, at.number)};
  const Pack half(0.5), length = sqrt(dot(to, to) + Pack(tiny_square));
  const PackVector normal = (Pack(1.0) / length) * to;
  const Pack overlap = gather(c.distance, at.number) - length;
  const MovingElement i(Row::gather(c.motion, at.i)), j(Row::gather(c.motion, at.j));
  const Pack arm_i = half * (length + i.radius - j.radius),
             arm_j = half * (length + j.radius - i.radius);
  const PackVector velocity_i = i.velocity + arm_i * cross(i.spin, normal);
  const PackVector velocity_j = j.velocity - arm_j * cross(j.spin, normal);
  const Pack stiffness = gather(c.stiffness, at.number);
  const Row past = Row::gather(c.history, at.number);
  const ContactResponse<Pack> response = linear_contact<Pack>(
      {stiffness, Pack(c.tangential_stiffness_ratio) * stiffness, Pack(c.friction),
       gather(c.damping, at.number), i.inverse_mass + j.inverse_mass},
      {normal, overlap, velocity_j - velocity_i, half * dot(i.spin + j.spin, normal),
       Pack(c.time_step)},
      {{past.component[0], past.component[1], past.component[2]},
       {past.component[3], past.component[4], past.component[5]},
       past.component[6]});
  return {response, cross(normal, response.force), arm_i, arm_j, greater(overlap, Pack(0.0))};
}

/// Keeps what contacts do and remember.
inline void keep(const ContactColumns& c, const PickedPairs& at, const ContactPack& pack) {
  const ContactHistory<Pack>& now = pack.response.history;
  const PackVector &n = now.normal, &s = now.spring, &f = pack.response.force, &m = pack.moment;
  Row{{n.x, n.y, n.z, s.x, s.y, s.z, now.dashpot, Pack(0.0)}}.scatter(c.history, at.number);
  Row{{f.x, f.y, f.z, pack.arm_i, m.x, m.y, m.z, pack.arm_j}}.scatter(c.load, at.number);
  for (int k = 0; k < width; ++k) c.acts[at.number[k]] = pack.touches[k] ? 1 : 0;
  if (c.heat != nullptr)
    scatter(Pack(c.heat_of_friction) * pack.response.friction_work +
                Pack(c.heat_of_damping) * pack.response.damping_work,
            c.heat, at.number);
}

alignas(64) constexpr double lane_numbers[] = {0, 1, 2, 3, 4, 5, 6, 7};

inline std::size_t count_of(Mask mask) {
  std::size_t count = 0;
  for (int k = 0; k < width; ++k) count += mask[k] ? 1 : 0;
  return count;
}

/// Asks for the memory of pairs that are next.
inline void prefetch(const ContactColumns& c, const PickedPairs& at) {
  for (int k = 0; k < width; ++k) {
    const std::ptrdiff_t pair = 8 * std::ptrdiff_t{at.number[k]}, j = 8 * std::ptrdiff_t{at.j[k]};
    __builtin_prefetch(c.pose + j);
    __builtin_prefetch(c.motion + j);
    __builtin_prefetch(c.history + pair, 1);
    __builtin_prefetch(c.load + pair, 1);
  }
}

[[gnu::flatten]] ContactSums contact_loads_of(const ContactColumns& c, const std::uint32_t* picked,
                                              std::size_t count) {
  Pack friction{}, damped{};
  ContactSums sums;
  if (count == 0) return sums;
  const auto pack_at = [&](std::size_t n) {
    return PickedPairs(c, picked + n, std::min<std::size_t>(width, count - n));
  };
  PickedPairs next = pack_at(0);
  for (std::size_t n = 0; n < count; n += width) {
    const PickedPairs at = next;
    if (n + width < count) {
      next = pack_at(n + width);
      prefetch(c, next);
    }
    const ContactPack pack = contact_pack(c, at);
    keep(c, at, pack);
    const Mask used = greater(Pack(static_cast<double>(count - n)), Pack::load(lane_numbers));
    friction += select(used, pack.response.friction_work, Pack(0.0));
    damped += select(used, pack.response.damping_work, Pack(0.0));
    sums.acting += count_of(both(used, pack.touches));
  }
  for (int k = 0; k < width; ++k) {
    sums.friction += friction.v[k];
    sums.damped += damped.v[k];
  }
  return sums;
}

/// The rows of a block of lanes.
inline void lay_out_block(const MotionRows& m, std::size_t block) {
  for (int part = 0; part < lanes; part += width) {
    const std::size_t first = lanes * block + static_cast<std::size_t>(part);
    const double* velocity = m.velocity + 3 * lanes * block + part;
    Row row{{Pack::load(velocity), Pack::load(velocity + lanes), Pack::load(velocity + 2 * lanes),
             Pack::load(m.inverse_mass + first), Pack(0.0), Pack(0.0), Pack(0.0),
             Pack::load_anywhere(m.radius + first)}};
    if (m.spin != nullptr)
      for (int axis = 0; axis < 3; ++axis)
        row.component[4 + axis] =
            Pack::load(m.spin + (3 * block + static_cast<std::size_t>(axis)) * lanes + part);
    row.store(m.rows + 8 * first);
  }
}

inline void lay_out_row(const MotionRows& m, std::size_t element) {
  const std::size_t lane = 3 * lanes * (element / lanes) + element % lanes;
  double* row = m.rows + 8 * element;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row[axis] = m.velocity[lane + axis * lanes];
    row[4 + axis] = m.spin != nullptr ? m.spin[lane + axis * lanes] : 0;
  }
  row[3] = m.inverse_mass[element];
  row[7] = m.radius[element];
}

}  // namespace

void lay_out_motion(const MotionRows& motion, const std::int32_t* element, std::size_t count) {
  for (std::size_t n = 0; n < count;) {
    const auto i = static_cast<std::size_t>(element[n]);
    const bool is_whole_block =
        i % lanes == 0 && n + lanes <= count && element[n + lanes - 1] == element[n] + lanes - 1;
    if (is_whole_block)
      lay_out_block(motion, i / lanes);
    else
      lay_out_row(motion, i);
    n += is_whole_block ? lanes : 1;
  }
}

void pick_contacts(const ContactColumns& c, std::size_t first, std::size_t last) {
  constexpr std::size_t size = ContactColumns::pairs_a_block;
  for (std::size_t block = first; block < last; ++block) {
    // Kernels write beyond what they pick: not into the next block, which may be another thread's.
    std::uint32_t picked[size + width];
    c.picks[block] = pick_touching(c, block * size, std::min(c.pairs, (block + 1) * size), picked);
    std::copy_n(picked, c.picks[block], c.picked + block * size);
  }
}

void find_contact_loads(const ContactColumns& c, std::size_t first, std::size_t last) {
  for (std::size_t block = first; block < last; ++block)
    c.sums[block] =
        contact_loads_of(c, c.picked + block * ContactColumns::pairs_a_block, c.picks[block]);
}

std::size_t sum_contact_loads(const ContactSides& s, std::size_t first, std::size_t last,
                              std::int32_t* element, double* sums) {
  constexpr std::ptrdiff_t sides_ahead = 16;
  const ContactSide* last_side = s.side + s.first[last];
  std::size_t count = 0;
  for (std::size_t n = first; n < last; ++n) {
    const ContactSide *begin = s.side + s.first[n], *end = s.side + s.first[n + 1];
    const bool is_pushed =
        std::any_of(begin, end, [&](const ContactSide& side) { return s.acts[side.pair] != 0; });
    if (!is_pushed) continue;
    // Without a branch for those that do not act: their loads are zero.
    double sum[8] = {};
    for (const ContactSide* side = begin; side < end; ++side) {
      if (side + sides_ahead < last_side)
        __builtin_prefetch(s.load + std::ptrdiff_t{8} * side[sides_ahead].pair);
      const double* load = s.load + std::ptrdiff_t{8} * side->pair;
      const double sign = side->is_first ? 1 : -1, arm = load[side->is_first ? 3 : 7];
      for (int c = 0; c < 4; ++c) sum[c] += sign * load[c];
      for (int c = 4; c < 8; ++c) sum[c] += arm * load[c];
    }
    sum[3] = sum[7] = 0;
    element[count] = s.element[n];
    std::copy_n(sum, 8, sums + 8 * count++);
  }
  return count;
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET
