// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compiled once for each instruction set.
//
// What central forces do to elements and what they store, for who looks:
// laws/central_interaction.hpp.
#include "effects/kernels/central_motion.hpp"
#include "effects/kernels/loose_kernels.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

namespace {

/// Potentials where some elements are nearer than the law is followed.
template <class Law>
[[gnu::noinline]] Pack continued_potential(const Law& law, double interpenetration, Pack range,
                                           Pack distance, Pack equilibrium) {
  Pack potential;
  for (int k = 0; k < width; ++k)
    potential.v[k] =
        central_potential(law, interpenetration, range.v[k], distance.v[k], equilibrium.v[k]);
  return potential;
}

/// Of a row of pairs, zero of those beyond the range.
template <class Law>
inline Pack potential_of(const Law& law, const CentralMotion& m, const Seen& seen,
                         const Pack& equilibrium) {
  const Separation<Pack> at{seen.distance, seen.inverse_distance, equilibrium};
  const Separation<Pack> end{seen.range, Pack(1.0) / seen.range, equilibrium};
  Pack potential = law.potential(at) - law.potential(end);
  const Mask deep =
      both(greater(at.compression_ratio(), Pack(1 / (1 - m.interpenetration))), seen.inside);
  if (any(deep))
    potential = select(
        deep, continued_potential(law, m.interpenetration, seen.range, seen.distance, equilibrium),
        potential);
  return select(seen.inside, potential, Pack(0.0));
}

template <class Law, bool dissipates, bool cracks>
void find_efforts_by(const Law& law, const CentralMotion& m, const CentralEfforts& efforts,
                     std::size_t first, std::size_t last) {
  const Pack half(0.5), none(0.0);
  Pull<Law, dissipates, cracks> pull{law, m, 0, none};
  const std::size_t first_row = m.first_row[first], end_row = m.first_row[last];
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const auto offset = static_cast<std::size_t>(lane);
      const std::size_t element = block * lanes + offset;
      pull.begin(element, offset);
      pull.compression_ratio = none;
      Pack potential{}, pairs{};
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        if (row + rows_ahead < end_row) pull.prefetch(row + rows_ahead);
        const PackVector force = pull.add(row);
        if (efforts.slot_force != nullptr)
          store_vector(force, efforts.slot_force + 3 * (row - first_row) * lanes + offset);
        if (efforts.force == nullptr) continue;
        const Seen seen = see<dissipates>(m, pull.own, row, offset);
        potential += potential_of(law, m, seen, pull.equilibrium_of(seen, row * lanes + offset));
        pairs += select(seen.inside, Pack(1.0), none);
      }
      if (efforts.force == nullptr) continue;
      store_vector(pull.force, efforts.force + 3 * block * lanes + offset);
      (half * potential).store(efforts.potential + element);
      (half * pairs).store(efforts.pairs + element);
      pull.compression_ratio.store(efforts.compression_ratio + element);
      if constexpr (dissipates)
        // (c n · ΔV)² / c of each pair, half of it on either side.
        (m.dissipation > 0 ? Pack(0.5 / m.dissipation) * pull.dissipated : none)
            .store(efforts.power + element);
    }
}

}  // namespace

void find_central_efforts(const CentralMotion& m, const CentralEfforts& efforts, std::size_t first,
                          std::size_t last) {
  std::visit(
      [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        const bool dissipates = m.dissipated_energy != nullptr;
        if (m.barycentre != nullptr)
          dissipates ? find_efforts_by<Law, true, true>(law, m, efforts, first, last)
                     : find_efforts_by<Law, false, true>(law, m, efforts, first, last);
        else
          dissipates ? find_efforts_by<Law, true, false>(law, m, efforts, first, last)
                     : find_efforts_by<Law, false, false>(law, m, efforts, first, last);
      },
      m.law);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET
