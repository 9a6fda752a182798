// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compiled once for each instruction set, without fusing products and sums: packings are the same
// bits on every machine.
//
// Soft spheres that push each other: specimen/quench.hpp.
#include "effects/kernels/loose_kernels.hpp"
#include "effects/kernels/pack_vector.hpp"
#include "model/slots.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

namespace {

/// A distance along one axis, to the nearest image.
inline Pack nearest(Pack d, Pack period) {
  const Pack half = Pack(0.5) * period, none(0.0);
  d = d - select(greater(d, half), period, none);
  return d + select(greater(-half, d), period, none);
}

template <bool periodic>
void find_forces_of_blocks(const SoftSphereColumns& s, std::size_t first, std::size_t last) {
  const PackVector period{s.period.x, s.period.y, s.period.z};
  const Pack none(0.0), one(1.0);
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t sphere = block * lanes + static_cast<std::size_t>(lane);
      const Quad own = Quad::load(s.ball + 4 * sphere);
      PackVector force{};
      Pack contact_force, contacts;
      for (std::uint32_t row = s.first_row[block]; row < s.first_row[block + 1]; ++row) {
        const Quad other = Quad::gather(s.ball, s.neighbour + std::size_t{row} * lanes + lane);
        PackVector chord = vector_of(own) - vector_of(other);
        if (periodic)
          chord = {nearest(chord.x, period.x), nearest(chord.y, period.y),
                   nearest(chord.z, period.z)};
        const Pack reach = own.component[3] + other.component[3];
        const Pack depth = reach * reach - dot(chord, chord);
        const Mask touch = greater(depth, none);
        const Pack push = select(touch, depth + depth, none);
        force += push * chord;
        contact_force += push;
        contacts += select(touch, one, none);
      }
      store_vector(Pack(0.0625) * force, s.force + 3 * block * lanes + lane);
      contact_force.store(s.contact_force + sphere);
      contacts.store(s.contacts + sphere);
    }
}

}  // namespace

void find_soft_forces(const SoftSphereColumns& s, std::size_t first, std::size_t last) {
  s.is_periodic ? find_forces_of_blocks<true>(s, first, last)
                : find_forces_of_blocks<false>(s, first, last);
}

void add_up_soft_spheres(const SoftSphereColumns& s, std::size_t first, std::size_t last,
                         SoftSphereSums& sums) {
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t at = 3 * block * lanes + static_cast<std::size_t>(lane);
      const PackVector force = load_vector(s.force + at), velocity = load_vector(s.velocity + at);
      const Pack power = dot(force, velocity), force2 = dot(force, force);
      const Pack velocity2 = dot(velocity, velocity);
      const std::size_t sphere = block * lanes + static_cast<std::size_t>(lane);
      for (int k = 0; k < width; ++k) {
        sums.power += power.v[k];
        sums.force2 += force2.v[k];
        sums.velocity2 += velocity2.v[k];
        sums.contact_force += 0.125 * s.contact_force[sphere + static_cast<std::size_t>(k)];
        sums.contacts += s.contacts[sphere + static_cast<std::size_t>(k)];
      }
    }
}

double move_soft_spheres(const SoftSphereColumns& s, std::size_t first, std::size_t last,
                         double time_step, double keep, double push) {
  Pack farthest2(0.0);
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t at = 3 * block * lanes + static_cast<std::size_t>(lane);
      const std::size_t sphere = block * lanes + static_cast<std::size_t>(lane);
      const PackVector velocity =
          Pack(keep) * load_vector(s.velocity + at) + Pack(push) * load_vector(s.force + at);
      store_vector(velocity, s.velocity + at);
      Quad ball = Quad::load(s.ball + 4 * sphere);
      const PackVector centre = vector_of(ball) + Pack(time_step) * velocity;
      const PackVector moved = centre - vector_of(Quad::load(s.listed + 4 * sphere));
      const Pack distance2 = dot(moved, moved);
      farthest2 = select(greater(distance2, farthest2), distance2, farthest2);
      ball.component[0] = centre.x;
      ball.component[1] = centre.y;
      ball.component[2] = centre.z;
      ball.store(s.ball + 4 * sphere);
    }
  double farthest = 0;
  for (int k = 0; k < width; ++k) farthest = farthest2.v[k] > farthest ? farthest2.v[k] : farthest;
  return farthest;
}

std::size_t pick_soft_spheres(const SortedSpheres& s, const SphereRange* ranges, std::size_t count,
                              const Vector& centre, double reach, std::uint32_t* near) {
  Pack number;
  for (int k = 0; k < width; ++k) number.v[k] = k;
  std::size_t found = 0;
  for (const SphereRange* range = ranges; range < ranges + count; ++range) {
    const Vector from = centre - range->shift;
    for (std::size_t k = range->first; k < range->last; k += width) {
      const Pack dx = Pack::load_anywhere(s.x + k) - Pack(from.x);
      const Pack dy = Pack::load_anywhere(s.y + k) - Pack(from.y);
      const Pack dz = Pack::load_anywhere(s.z + k) - Pack(from.z);
      const Pack limit = Pack::load_anywhere(s.reach + k) + Pack(reach);
      const Mask is_near = greater(limit * limit, dx * dx + dy * dy + dz * dz);
      const Mask is_inside = greater(Pack(static_cast<double>(range->last - k)), number);
      found += write_numbers(both(is_near, is_inside), k, near + found);
    }
  }
  return found;
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET
