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
#include "laws/crack_face.hpp"
#include "model/slots.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

/// A pack of neighbours seen from a pack of elements. Of an empty slot, and of two elements at one
/// place, the distance is no number, so that nothing is inside.
struct Seen {
  PackVector chord;
  Pack inverse_distance;  ///< 1/δ
  Pack distance;          ///< δ, m
  Pack range;             ///< δ_lim, m
  Mask inside;
};

/// Doubles in the row of an element.
template <bool dissipates>
constexpr int row_length = dissipates ? 8 : 4;

template <bool dissipates>
inline Seen see(const CentralMotion& m, const Quad& own, std::size_t row, std::size_t lane) {
  const Quad other =
      Quad::gather<row_length<dissipates>>(m.position, m.neighbour + row * lanes + lane);
  Seen seen;
  seen.chord = vector_of(other) - vector_of(own);
  if (m.image_shift != nullptr) seen.chord += load_vector(m.image_shift + 3 * row * lanes + lane);
  const Pack square = dot(seen.chord, seen.chord);
  seen.inverse_distance = inverse_sqrt(square);
  seen.distance = square * seen.inverse_distance;
  seen.range = own.component[3] + other.component[3];
  seen.inside = greater(seen.range, seen.distance);
  return seen;
}

/// Forces where some elements are nearer than the law is followed. Said to be pure, so that the hot
/// loop need not fear for what it has in registers.
template <class Law>
[[gnu::noinline, gnu::pure]] Pack continued_force(const Law& law, double interpenetration,
                                                  Pack distance, Pack equilibrium) {
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
  std::size_t offset;
  Pack compression_ratio;
  Quad own{};  ///< centre, and α R
  PackVector own_velocity{}, own_barycentre{};
  PackVector force{};
  Pack dissipated{};

  void begin(std::size_t element, std::size_t lane) {
    offset = lane;
    const double* row = m.position + row_length<dissipates> * element;
    own = Quad::load<row_length<dissipates>>(row);
    if constexpr (dissipates) own_velocity = vector_of(Quad::load<8>(row + 4));
    if constexpr (cracks) own_barycentre = vector_of(Quad::load(m.barycentre + 4 * element));
    force = {};
    dissipated = {};
  }

  /// Asks for what add() will gather.
  void prefetch(std::size_t row) const {
    const std::int32_t* neighbours = m.neighbour + row * lanes + offset;
    prefetch_rows<row_length<dissipates>>(m.position, neighbours);
    if constexpr (cracks) prefetch_rows<4>(m.barycentre, neighbours);
  }

  /// Distance at which pairs neither attract nor repel each other.
  Pack equilibrium_of(const Seen& seen, std::size_t slot) const {
    return m.rest_length != nullptr ? Pack::load(m.rest_length + slot)
                                    : Pack(1 / m.range) * seen.range;
  }

  /// Returns what a row adds.
  PackVector add(std::size_t row) {
    const Pack none(0.0);
    const std::size_t slot = row * lanes + offset;
    const Seen seen = see<dissipates>(m, own, row, offset);
    const Pack equilibrium = equilibrium_of(seen, slot);
    const Separation<Pack> at{seen.distance, seen.inverse_distance, equilibrium};
    Pack push = law.force(at);
    const Pack near = at.compression_ratio();
    compression_ratio = raise(compression_ratio, seen.inside, near);
    const Mask deep = both(greater(near, Pack(1 / (1 - m.interpenetration))), seen.inside);
    if (__builtin_expect(any(deep), 0))
      push =
          select(deep, continued_force(law, m.interpenetration, seen.distance, equilibrium), push);
    if constexpr (cracks) {
      const PackVector barycentre = vector_of(Quad::gather(m.barycentre, m.neighbour + slot));
      const Mask apart = on_opposite_faces(own_barycentre, barycentre, seen.chord);
      push = select(both(apart, greater(none, push)), none, push);
    }
    if constexpr (dissipates) {
      const PackVector velocity = vector_of(Quad::gather<8>(m.position + 4, m.neighbour + slot));
      const Pack drag = dissipative_force(Pack(m.dissipation), seen.chord, seen.inverse_distance,
                                          own_velocity - velocity);
      push += drag;
      dissipated += select(seen.inside, drag * drag, none);
    }
    PackVector pulled = -select(seen.inside, push * seen.inverse_distance, none) * seen.chord;
    force += pulled;
    return pulled;
  }
};

template <class Law, bool dissipates, bool cracks>
void move_by(const Law& law_of_all, CentralMotion& m, std::size_t first, std::size_t last) {
  const Law law = law_of_all;  // which no store may change
  const CentralMotion columns = m;
  Pull<Law, dissipates, cracks> pull{law, columns, 0, Pack(m.compression_ratio)};
  const std::size_t end_row = m.first_row[last];
  const double energy_of_drag = m.dissipation > 0 ? 0.5 * m.kick / m.dissipation : 0;
  bool outran = m.outran;
  for (std::size_t block = first; block < last; ++block) {
    for (int lane = 0; lane < lanes; lane += width) {
      const auto offset = static_cast<std::size_t>(lane);
      const std::size_t element = block * lanes + offset;
      pull.begin(element, offset);
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        if (row + rows_ahead < end_row) pull.prefetch(row + rows_ahead);
        pull.add(row);
      }
      const std::size_t at = 3 * block * lanes + offset;
      const PackVector velocity =
          load_vector(m.velocity + at) +
          (Pack(m.kick) * Pack::load(m.inverse_mass + element)) * pull.force;
      store_vector(velocity, m.velocity + at);
      const PackVector moved = vector_of(pull.own) + Pack(m.drift) * velocity;
      const Pack range_share = pull.own.component[3];
      if constexpr (dissipates) {
        Row{{moved.x, moved.y, moved.z, range_share, velocity.x, velocity.y, velocity.z, Pack(0.0)}}
            .store(m.next_position + 8 * element);
        // c (n · ΔV)² of each pair, half of it on either side.
        (Pack::load(m.dissipated_energy + element) + Pack(energy_of_drag) * pull.dissipated)
            .store(m.dissipated_energy + element);
      } else {
        Quad{{moved.x, moved.y, moved.z, range_share}}.store(m.next_position + 4 * element);
      }
      if (m.listed_position != nullptr) {
        const PackVector away = moved - load_vector(m.listed_position + at);
        const Pack margin = Pack::load(m.listed_margin + element);
        if (any(greater(dot(away, away), margin * margin))) outran = true;
      }
    }
  }
  for (int k = 0; k < width; ++k)
    if (pull.compression_ratio.v[k] > m.compression_ratio)
      m.compression_ratio = pull.compression_ratio.v[k];
  m.outran = outran;
}

inline void move_by_central_forces(CentralMotion& m, std::size_t first, std::size_t last) {
  std::visit(
      [&](auto law) {
        using Law = decltype(law);
        const bool dissipates = m.dissipated_energy != nullptr;
        if (m.barycentre != nullptr)
          dissipates ? move_by<Law, true, true>(law, m, first, last)
                     : move_by<Law, false, true>(law, m, first, last);
        else
          dissipates ? move_by<Law, true, false>(law, m, first, last)
                     : move_by<Law, false, false>(law, m, first, last);
      },
      m.law);
}

template <bool dissipates>
void find_crack_faces_by(const CentralMotion& m, std::size_t first, std::size_t last) {
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const auto offset = static_cast<std::size_t>(lane);
      const std::size_t element = block * lanes + offset;
      const Quad own =
          Quad::load<row_length<dissipates>>(m.position + row_length<dissipates> * element);
      PackVector sum{};
      Pack neighbours{};
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        const Seen seen = see<dissipates>(m, own, row, offset);
        const Pack counts = select(seen.inside, Pack(1.0), Pack(0.0));
        sum += counts * seen.chord;
        neighbours += counts;
      }
      const Pack bound = Pack(m.crack_threshold / m.range) * own.component[3];
      const PackVector shown =
          m.neighbours_at_start == nullptr
              ? crack_face_barycentre(sum, neighbours, bound)
              : crack_face_barycentre(sum, neighbours, bound,
                                      Pack::load(m.neighbours_at_start + element));
      Quad{{shown.x, shown.y, shown.z, neighbours}}.store(m.barycentre + 4 * element);
    }
}

inline void find_crack_faces(const CentralMotion& m, std::size_t first, std::size_t last) {
  m.dissipated_energy != nullptr ? find_crack_faces_by<true>(m, first, last)
                                 : find_crack_faces_by<false>(m, first, last);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
