// SPDX-License-Identifier: GPL-2.0-or-later
//
// Conduction, gathered element by element: an explicit Euler step, or the power alone.
#ifndef SOLIDEM_EFFECTS_KERNELS_HEAT_FLOW_HPP
#define SOLIDEM_EFFECTS_KERNELS_HEAT_FLOW_HPP

#include "effects/kernels/kernels.hpp"
#include "effects/kernels/pack.hpp"
#include "laws/heat_exchange.hpp"
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

/// How the conductance of a pair is found.
enum class Conductance { stored, of_conductivities, with_contacts };

template <Conductance kind>
void conducted_power(const HeatPower& h, std::size_t first, std::size_t last) {
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const Pack own = Pack::load(h.temperature + element);
      Pack own_conductivity{};
      if constexpr (kind != Conductance::stored)
        own_conductivity = Pack::load(h.conductivity + element);
      Pack power{};
      for (std::size_t row = h.first_row[block]; row < h.first_row[block + 1]; ++row) {
        const std::size_t slot = row * lanes + static_cast<std::size_t>(lane);
        Pack conductance{};
        if constexpr (kind == Conductance::stored) {
          conductance = Pack::load(h.conductance + slot);
        } else {
          conductance =
              Pack::load(h.conduction_length + slot) *
              series_conductivity(own_conductivity, gather(h.conductivity, h.neighbour + slot));
          if constexpr (kind == Conductance::with_contacts)
            conductance =
                conductance / (Pack(1) + conductance * Pack::load(h.contact_resistance + slot));
        }
        power += conductance * (gather(h.temperature, h.neighbour + slot) - own);
      }
      power.store(h.power + element);
    }
}

inline void conducted_power_by_kind(const HeatPower& h, std::size_t first, std::size_t last) {
  if (h.conductance != nullptr)
    conducted_power<Conductance::stored>(h, first, last);
  else if (h.contact_resistance == nullptr)
    conducted_power<Conductance::of_conductivities>(h, first, last);
  else
    conducted_power<Conductance::with_contacts>(h, first, last);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
