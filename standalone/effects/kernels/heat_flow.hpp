// SPDX-License-Identifier: GPL-2.0-or-later
//
// Explicit Euler step of conduction, gathered element by element.
#ifndef SOLIDEM_EFFECTS_KERNELS_HEAT_FLOW_HPP
#define SOLIDEM_EFFECTS_KERNELS_HEAT_FLOW_HPP

#include "effects/kernels/kernels.hpp"
#include "effects/kernels/pack.hpp"
#include "model/slots.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

inline void conduct(const HeatFlow& h, std::size_t first, std::size_t last) {
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const Pack own = Pack::load(h.temperature + element);
      Pack power{};
      for (std::size_t row = h.first_row[block]; row < h.first_row[block + 1]; ++row) {
        const std::size_t slot = row * lanes + static_cast<std::size_t>(lane);
        power +=
            Pack::load(h.conductance + slot) * (gather(h.temperature, h.neighbour + slot) - own);
      }
      const Pack rate = Pack::load(h.inverse_heat_capacity + element) * power;
      (own + Pack(h.time_step) * rate).store(h.next_temperature + element);
    }
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
