// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compiled once for each instruction set.
//
// Damping of motion and of bonds: laws/damping.hpp, laws/bond_damping.hpp.
#include "laws/damping.hpp"
#include "effects/kernels/beam_slots.hpp"
#include "effects/kernels/loose_kernels.hpp"
#include "laws/bond_damping.hpp"
#include "laws/rigid_sphere.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

namespace {

/// What local damping changes of velocities that went from `before` to `after`.
inline PackVector changed_by_local_damping(double coefficient, const PackVector& before,
                                           const PackVector& after) {
  const Pack alpha(coefficient);
  return {local_damping(alpha, before.x, after.x), local_damping(alpha, before.y, after.y),
          local_damping(alpha, before.z, after.z)};
}

inline Mask differ(Pack a, Pack b) {
  return either(greater(a, b), greater(b, a));
}
inline Mask differ(const PackVector& a, const PackVector& b) {
  return either(either(differ(a.x, b.x), differ(a.y, b.y)), differ(a.z, b.z));
}

/// Adds to a column in some lanes.
inline void add(Mask lanes_that_do, Pack what, double* column) {
  const Pack now = Pack::load(column);
  select(lanes_that_do, now + what, now).store(column);
}

/// Moves centres, and the velocities that neighbours feel, by what velocities have gained.
inline void move_on(const DampedElements& d, std::size_t element, const PackVector& gain) {
  alignas(64) double gains[3][width];
  gain.x.store(gains[0]);
  gain.y.store(gains[1]);
  gain.z.store(gains[2]);
  for (int k = 0; k < width; ++k) {
    double* const row = d.next_position + d.row_length * (element + static_cast<std::size_t>(k));
    for (int axis = 0; axis < 3; ++axis) {
      row[axis] += d.time_step * gains[axis][k];
      if (d.velocity_is_felt) row[4 + axis] += gains[axis][k];
    }
  }
}

/// Turns elements anew in some lanes, from the orientation that held.
inline void turn_anew(const DampedElements& d, std::size_t element, Mask which,
                      const PackVector& spin) {
  Row next = Row::load(d.next_position + 8 * element);
  const Quaternion<Pack> turned =
      turn(orientation(Row::load(d.pose + 8 * element)), spin, Pack(d.time_step));
  const Quaternion<Pack> was = orientation(next);
  set_orientation(next, {select(which, turned.w, was.w), select(which, turned.v, was.v)});
  next.store(d.next_position + 8 * element);
}

inline void damp_pack(const DampedElements& d, const DampedMotion& motion, bool turns,
                      std::size_t element, std::size_t at) {
  const Pack none(0.0), half(0.5), left(d.left);
  const Mask free = greater(Pack::load(d.inverse_mass + element), none);
  if (!any(free)) return;
  const Pack inertia = Pack(1.0) / Pack::load(motion.inverse_inertia + element);
  const PackVector given = load_vector(motion.velocity + at);
  PackVector moves = given;
  if (motion.before != nullptr) {
    const PackVector before = load_vector(motion.before + at);
    moves += changed_by_local_damping(d.local, before, given);
    // The work of the damping force in the middle of the kick.
    add(free, -(half * inertia * dot(moves - given, before + moves)), motion.local + element);
  }
  const Pack taken = half * inertia * (Pack(1.0) - left * left);
  if (motion.viscous != nullptr) {
    add(free, taken * dot(moves, moves), motion.viscous + element);
    moves = left * moves;
  }
  const Mask moved = both(free, differ(moves, given));
  if (any(moved)) {
    if (turns)
      turn_anew(d, element, moved, moves);
    else
      move_on(d, element, select(moved, moves - given, {}));
  }
  // The second half of viscous damping belongs to the time after the move.
  PackVector stays = moves;
  if (motion.viscous != nullptr) {
    add(free, taken * dot(moves, moves), motion.viscous + element);
    stays = left * moves;
  }
  store_vector(select(free, stays, given), motion.velocity + at);
  if (motion.before != nullptr)
    store_vector(select(free, stays, load_vector(motion.before + at)), motion.before + at);
}

/// Both ends of bonds, by their rows of motion.
inline BondMotion<Pack> motion_of(const Row& own, const Row& other) {
  return {centre(other) - centre(own),
          {own.component[4], own.component[5], own.component[6]},
          {other.component[4], other.component[5], other.component[6]}};
}

/// A spring has no dashpot against turning, whatever turns.
inline BondInertia<Pack> inertia_of(bool has_rotation, const Row& own, const Row& other) {
  return {own.component[3] + other.component[3],
          has_rotation ? own.component[7] + other.component[7] : Pack(1.0)};
}

/// What loads change of the motion of a pack of elements.
inline void push_pack(const BeamMotion& m, std::size_t element, std::size_t at,
                      const PackVector& force, const PackVector& moment) {
  const Pack kick(m.kick), time_step(m.drift);
  Row next = Row::load(m.next_pose + 8 * element);
  const PackVector gain = (kick * Pack::load(m.inverse_mass + element)) * force;
  store_vector(load_vector(m.velocity + at) + gain, m.velocity + at);
  add_to_centre(next, time_step * gain);
  if (m.has_rotation) {
    const PackVector spin = load_vector(m.angular_velocity + at) +
                            (kick * Pack::load(m.inverse_inertia + element)) * moment;
    store_vector(spin, m.angular_velocity + at);
    set_orientation(next, turn(orientation(Row::load(m.pose + 8 * element)), spin, time_step));
  }
  next.store(m.next_pose + 8 * element);
}

}  // namespace

void damp(const DampedElements& d, std::size_t first, std::size_t last) {
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const std::size_t at = 3 * block * lanes + static_cast<std::size_t>(lane);
      damp_pack(d, d.translation, false, element, at);
      if (d.rotation.velocity != nullptr) damp_pack(d, d.rotation, true, element, at);
    }
}

void damp_bonds(const BeamMotion& m, const DampedBonds& d, std::size_t first, std::size_t last) {
  const std::size_t end_row = m.first_row[last];
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const Row own = Row::load(m.pose + 8 * element);
      const Row own_motion = Row::load(d.motion + 8 * element);
      PackVector force{}, moment{};
      Pack power{};
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        const SlotPlace slot{row, static_cast<std::size_t>(lane)};
        const std::int32_t* neighbours = m.neighbour + slot.of(1);
        if (row + rows_ahead < end_row) {
          prefetch_rows<8>(m.pose, neighbours + rows_ahead * lanes);
          prefetch_rows<8>(d.motion, neighbours + rows_ahead * lanes);
        }
        PackVector chord = vector_of(Quad::gather<8>(m.pose, neighbours)) - centre(own);
        if (m.image_shift != nullptr) chord += load_vector(m.image_shift + slot.of(3));
        const Row motion = Row::gather(d.motion, neighbours);
        const DashpotAction<Pack> action =
            bond_damping(bond_dashpots(Pack(d.critical_ratio), rigidity_in<Pack>(m, slot),
                                       slot.number(m.rest_length),
                                       inertia_of(m.has_rotation, own_motion, motion)),
                         chord, motion_of(own_motion, motion));
        const Mask is_bond = greater(dot(chord, chord), Pack(0.0));
        force += select(is_bond, action.load.force, {});
        moment += select(is_bond, action.load.moment_i, {});
        power += select(is_bond, action.power, Pack(0.0));
      }
      (Pack::load(d.energy + element) + Pack(0.5 * m.kick) * power).store(d.energy + element);
      push_pack(m, element, 3 * block * lanes + static_cast<std::size_t>(lane), force, moment);
    }
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET
