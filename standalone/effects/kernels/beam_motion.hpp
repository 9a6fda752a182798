// SPDX-License-Identifier: GPL-2.0-or-later
//
// Beam loads gathered element by element, fused with the time step: force, kick and drift in one
// pass.
#ifndef SOLIDEM_EFFECTS_KERNELS_BEAM_MOTION_HPP
#define SOLIDEM_EFFECTS_KERNELS_BEAM_MOTION_HPP

#include "effects/kernels/kernels.hpp"
#include "effects/kernels/pack.hpp"
#include "laws/rigid_sphere.hpp"
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

inline PackVector centre(const Row& row) {
  return {row.component[0], row.component[1], row.component[2]};
}

inline Quaternion<Pack> orientation(const Row& row) {
  return {row.component[4], {row.component[5], row.component[6], row.component[7]}};
}

template <bool radius_from_pair, bool periodic>
void move_beams(const BeamMotion& m, std::size_t first, std::size_t last) {
  // Far enough ahead for a neighbour's line to arrive, near enough to be still there.
  constexpr std::size_t rows_ahead = 2;
  const BeamRigidity<Pack> common{m.rigidity.axial, m.rigidity.bending, m.rigidity.torsion};
  const std::size_t end_row = m.first_row[last];
  for (std::size_t block = first; block < last; ++block) {
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const Row own = Row::load(m.pose + 8 * element);
      const PackVector position = centre(own);
      const Quaternion<Pack> turned = orientation(own);
      const Quaternion<Pack> turned_back = conjugate(turned);
      const Rotation<Pack> rotation(turned);
      PackVector force{}, moment{};
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        const std::size_t slot = row * lanes + static_cast<std::size_t>(lane);
        if (row + rows_ahead < end_row)
          for (int k = 0; k < width; ++k)
            __builtin_prefetch(
                m.pose + std::ptrdiff_t{8} *
                             m.neighbour[slot + rows_ahead * lanes + static_cast<std::size_t>(k)]);
        const std::size_t slot3 = 3 * row * lanes + static_cast<std::size_t>(lane);
        const Row other = Row::gather(m.pose, m.neighbour + slot);
        const PackVector rest_direction = load_vector(m.rest_direction + slot3);
        const Pack rest_length = Pack::load(m.rest_length + slot);
        PackVector chord = centre(other) - position;
        if constexpr (periodic) chord += load_vector(m.image_shift + slot3);
        const Quaternion<Pack> other_turned = orientation(other);
        const BeamPose<Pack> pose{chord, rotate(rotation, rest_direction),
                                  rotate(other_turned, rest_direction), other_turned * turned_back};
        BeamRigidity<Pack> rigidity = common;
        if constexpr (radius_from_pair)
          rigidity = beam_rigidity_of_radius(common, Pack::load(m.bond_radius + slot));
        const BeamLoad<Pack> load = beam_load(rigidity, rest_length, pose);
        force += load.force;
        moment += load.moment_i;
      }
      const std::size_t at = 3 * block * lanes + static_cast<std::size_t>(lane);
      const PackVector velocity = load_vector(m.velocity + at) +
                                  (Pack(m.kick) * Pack::load(m.inverse_mass + element)) * force;
      const PackVector spin = load_vector(m.angular_velocity + at) +
                              (Pack(m.kick) * Pack::load(m.inverse_inertia + element)) * moment;
      store_vector(velocity, m.velocity + at);
      store_vector(spin, m.angular_velocity + at);
      const PackVector moved = position + Pack(m.drift) * velocity;
      const Quaternion<Pack> now = turn(turned, spin, Pack(m.drift));
      const Row next{
          {moved.x, moved.y, moved.z, own.component[3], now.w, now.v.x, now.v.y, now.v.z}};
      next.store(m.next_pose + 8 * element);
    }
  }
}

inline void move_beams_by_kind(const BeamMotion& m, std::size_t first, std::size_t last) {
  const bool pair = m.bond_radius != nullptr, periodic = m.image_shift != nullptr;
  if (pair)
    periodic ? move_beams<true, true>(m, first, last) : move_beams<true, false>(m, first, last);
  else
    periodic ? move_beams<false, true>(m, first, last) : move_beams<false, false>(m, first, last);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
