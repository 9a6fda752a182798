// SPDX-License-Identifier: GPL-2.0-or-later
//
// Central forces gathered element by element, fused with the time step: force, kick and drift in
// one pass. Specialised at compile time on the law and on what a scene asks for.
#ifndef SOLIDEM_EFFECTS_KERNELS_CENTRAL_MOTION_HPP
#define SOLIDEM_EFFECTS_KERNELS_CENTRAL_MOTION_HPP

#include <variant>

#include "effects/kernels/kernels.hpp"
#include "effects/kernels/pack.hpp"
#include "effects/kernels/pack_vector.hpp"
#include "laws/central_interaction.hpp"
#include "laws/crack_lip.hpp"
#include "model/slots.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

using Place = Quad<8>;      // of a row of poses
using Companion = Quad<4>;  // velocity or barycentre beside it

template <int stride>
PackVector vector_of(const Quad<stride>& quad) {
  return {quad.component[0], quad.component[1], quad.component[2]};
}

/// A pack of neighbours seen from a pack of elements.
struct Seen {
  PackVector chord;
  Pack square;            ///< δ²
  Pack inverse_distance;  ///< 1/δ
  Pack distance;          ///< δ, m
  Pack radii;             ///< R_i + R_j
  Mask inside;            ///< within the range, and not the element itself
};

inline Seen see(const CentralMotion& m, const Place& own, std::size_t row, std::size_t lane) {
  const std::size_t slot = row * lanes + lane;
  const Place other = Place::gather(m.pose, m.neighbour + slot);
  Seen seen;
  seen.chord = vector_of(other) - vector_of(own);
  if (m.image_shift != nullptr) seen.chord += load_vector(m.image_shift + 3 * row * lanes + lane);
  seen.square = dot(seen.chord, seen.chord);
  // Of an empty slot, and of two elements at one place, nothing is used.
  seen.inverse_distance = inverse_sqrt(seen.square + Pack(tiny_square<double>));
  seen.distance = seen.square * seen.inverse_distance;
  seen.radii = own.component[3] + other.component[3];
  seen.inside = both(greater(Pack(m.range) * seen.radii, seen.distance),
                     greater(seen.square, Pack(tiny_square<double>)));
  return seen;
}

/// Forces where some elements are nearer than the law is followed.
template <class Law>
[[gnu::noinline]] Pack continued_force(const Law& law, double interpenetration, Pack distance,
                                       Pack equilibrium) {
  Pack force;
  for (int k = 0; k < width; ++k)
    force.v[k] = central_force(law, interpenetration, distance.v[k], equilibrium.v[k]).force;
  return force;
}

/// Forces on a pack of elements, summed row by row.
template <class Law, bool dissipates, bool cracks>
struct Pull {
  const Law& law;
  const CentralMotion& m;
  Pack closeness;
  std::size_t offset{};
  Place own{};
  PackVector own_velocity{}, own_barycentre{};
  PackVector force{};
  Pack dissipated{};

  void begin(std::size_t element, std::size_t lane) {
    offset = lane;
    own = Place::load(m.pose + 8 * element);
    if constexpr (dissipates)
      own_velocity = vector_of(Companion::load(m.carried_velocity + 4 * element));
    if constexpr (cracks) own_barycentre = vector_of(Companion::load(m.barycentre + 4 * element));
    force = {};
    dissipated = {};
  }

  /// Adds `count` rows. What a row needs is one long chain of operations that wait for each other;
  /// several rows side by side keep the machine busy (one alone takes more than twice as long).
  template <int count>
  void add(std::size_t row) {
    const Pack none(0.0), nearest(1 - m.interpenetration);
    Seen seen[count];
    Pack equilibrium[count], push[count];
    Mask deep[count];
    for (int k = 0; k < count; ++k)
      seen[k] = see(m, own, row + static_cast<std::size_t>(k), offset);
    for (int k = 0; k < count; ++k)
      equilibrium[k] =
          m.rest_length != nullptr
              ? Pack::load(m.rest_length + (row + static_cast<std::size_t>(k)) * lanes + offset)
              : seen[k].radii;
    for (int k = 0; k < count; ++k)
      push[k] =
          law.force(Separation<Pack>{seen[k].distance, seen[k].inverse_distance, equilibrium[k]});
    Mask some_deep = seen[0].inside;
    for (int k = 0; k < count; ++k) {
      deep[k] = both(greater(nearest * equilibrium[k], seen[k].distance), seen[k].inside);
      some_deep = k == 0 ? deep[0] : either(some_deep, deep[k]);
    }
    if (__builtin_expect(any(some_deep), 0))
      for (int k = 0; k < count; ++k)
        if (any(deep[k]))
          push[k] = select(
              deep[k], continued_force(law, m.interpenetration, seen[k].distance, equilibrium[k]),
              push[k]);
    for (int k = 0; k < count; ++k) {
      const std::int32_t* neighbour =
          m.neighbour + (row + static_cast<std::size_t>(k)) * lanes + offset;
      if constexpr (cracks) {
        const PackVector barycentre = vector_of(Companion::gather(m.barycentre, neighbour));
        const Mask apart = on_opposite_lips(own_barycentre, barycentre, seen[k].chord);
        push[k] = select(both(apart, greater(none, push[k])), none, push[k]);
      }
      if constexpr (dissipates) {
        const PackVector velocity = vector_of(Companion::gather(m.carried_velocity, neighbour));
        const Pack drag = dissipative_force(Pack(m.dissipation), seen[k].chord,
                                            seen[k].inverse_distance, own_velocity - velocity);
        push[k] += drag;
        dissipated += select(seen[k].inside, drag * drag, none);
      }
    }
    for (int k = 0; k < count; ++k) {
      force += select(seen[k].inside, push[k] * seen[k].inverse_distance, none) * (-seen[k].chord);
      closeness = larger(closeness,
                         select(seen[k].inside, equilibrium[k] * seen[k].inverse_distance, none));
    }
  }
};

template <class Law, bool dissipates, bool cracks>
void move_by(const Law& law, CentralMotion& m, std::size_t first, std::size_t last) {
  const Pack margin(m.listed_margin * m.listed_margin);
  const CentralMotion columns = m;
  Pull<Law, dissipates, cracks> pull{law, columns, Pack(m.closeness)};
  bool outran = m.outran;
  for (std::size_t block = first; block < last; ++block) {
    for (int lane = 0; lane < lanes; lane += width) {
      const auto offset = static_cast<std::size_t>(lane);
      const std::size_t element = block * lanes + offset;
      pull.begin(element, offset);
      std::size_t row = m.first_row[block];
      const std::size_t end = m.first_row[block + 1];
      for (; row + 4 <= end; row += 4) pull.template add<4>(row);
      if (row + 2 <= end) {
        pull.template add<2>(row);
        row += 2;
      }
      if (row < end) pull.template add<1>(row);
      const std::size_t at = 3 * block * lanes + offset;
      const PackVector velocity =
          load_vector(m.velocity + at) +
          (Pack(m.kick) * Pack::load(m.inverse_mass + element)) * pull.force;
      store_vector(velocity, m.velocity + at);
      const PackVector moved = vector_of(pull.own) + Pack(m.drift) * velocity;
      Place{{moved.x, moved.y, moved.z, pull.own.component[3]}}.store(m.next_pose + 8 * element);
      if constexpr (dissipates) {
        Companion{{velocity.x, velocity.y, velocity.z, Pack(0.0)}}.store(m.next_carried_velocity +
                                                                         4 * element);
        // c (n · ΔV)² of each pair, half of it on either side.
        (Pack::load(m.dissipated_energy + element) +
         Pack(0.5 * m.kick / m.dissipation) * pull.dissipated)
            .store(m.dissipated_energy + element);
      }
      if (m.listed_place != nullptr) {
        const PackVector away = moved - load_vector(m.listed_place + at);
        if (any(greater(dot(away, away), margin))) outran = true;
      }
    }
  }
  for (int k = 0; k < width; ++k)
    if (pull.closeness.v[k] > m.closeness) m.closeness = pull.closeness.v[k];
  m.outran = outran;
}

inline void move_by_central_forces(CentralMotion& m, std::size_t first, std::size_t last) {
  std::visit(
      [&](auto law) {
        using Law = decltype(law);
        const bool dissipates = m.carried_velocity != nullptr;
        if (m.barycentre != nullptr)
          dissipates ? move_by<Law, true, true>(law, m, first, last)
                     : move_by<Law, false, true>(law, m, first, last);
        else
          dissipates ? move_by<Law, true, false>(law, m, first, last)
                     : move_by<Law, false, false>(law, m, first, last);
      },
      m.law);
}

inline void find_crack_lips(const CentralMotion& m, std::size_t first, std::size_t last) {
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const auto offset = static_cast<std::size_t>(lane);
      const std::size_t element = block * lanes + offset;
      const Place own = Place::load(m.pose + 8 * element);
      PackVector sum{};
      Pack neighbours{};
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        const Seen seen = see(m, own, row, offset);
        const Pack counts = select(seen.inside, Pack(1.0), Pack(0.0));
        sum += counts * seen.chord;
        neighbours += counts;
      }
      const PackVector shown = lip_barycentre(sum, neighbours, Pack(m.lip) * own.component[3]);
      Companion{{shown.x, shown.y, shown.z, neighbours}}.store(m.barycentre + 4 * element);
    }
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
