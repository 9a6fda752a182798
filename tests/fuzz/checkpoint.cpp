// SPDX-License-Identifier: GPL-2.0-or-later
#include <iterator>
#include <map>

#include "bytes.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "model/error.hpp"
#include "support/specimens.hpp"
#include "targets.hpp"

namespace solidem::fuzz {

namespace {

/// Beams that break, touch and conduct: most of what a checkpoint can hold.
Setup busy_setup() {
  Setup setup = elastic_setup();
  RuptureParameters rupture;
  rupture.minimal_bonds = 2;
  setup.get<RuptureParameters>() = rupture;
  setup.get<ContactParameters>() = ContactParameters{};
  setup.get<ConductionParameters>() = ConductionParameters{};
  setup.get<ConductionParameters>()->initial_temperature = 298;
  return setup;
}

struct Body {
  Setup setup;
  Specimen specimen;
  std::map<std::string, std::vector<double>> saved;
};

Body body_of(const Setup& setup, const Specimen& specimen) {
  Simulation simulation(setup, specimen);
  simulation.advance(3);
  return {setup, specimen, simulation.save()};
}

void spoil(std::map<std::string, std::vector<double>>& saved, Bytes& bytes) {
  while (!bytes.is_empty()) {
    auto& values = std::next(saved.begin(), static_cast<long>(bytes.below(saved.size())))->second;
    const std::size_t place = values.empty() ? 0 : bytes.below(values.size());
    switch (bytes.below(6)) {
      case 0:
        values.resize(bytes.below(2 * values.size() + 2));
        break;
      case 1:
        values.push_back(bytes.take<double>());
        break;
      case 2:
        if (!values.empty()) values[place] = bytes.take<std::int16_t>();
        break;
      default:
        if (!values.empty()) values[place] = bytes.take<double>();
    }
  }
}

}  // namespace

void checkpoint(std::string_view input) {
  static const Body bonded = body_of(busy_setup(), jittered("bcc", {3, 2, 2}));
  Bytes bytes(input);
  auto saved = bonded.saved;
  spoil(saved, bytes);
  Simulation simulation(bonded.setup, bonded.specimen);
  try {
    simulation.restore(3, saved);
    simulation.advance(3);
    simulation.observe();
  } catch (const InputError&) {
  } catch (const RunError&) {
  }
}

}  // namespace solidem::fuzz
