// SPDX-License-Identifier: GPL-2.0-or-later
//
// What observers see of beams.
#include "effects/beams.hpp"
#include "effects/bond_slot.hpp"
#include "effects/kernels/kernels.hpp"
#include "model/blocks.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

namespace {

/// Blocks of elements below which one thread looks at all bonds.
constexpr std::size_t least_blocks_observed = 100;

}  // namespace

BondEffort Beams::effort(const BeamMotion& m, std::int32_t i, std::int32_t j, std::size_t row,
                         int lane) const {
  const SlotReader slot{row, lane};
  if (m.yield == nullptr || m.last_pose == nullptr)
    return elastic_effort(bond_in(m, slot, ends_in(m.pose, m, slot, i, j)));
  const Bond b = bond(m, i, j, row, lane);
  return {b.load(), b.energy(), b.response.plastic_work};
}

void Beams::for_each_pair(const Model& model, const PairVisit& visit) const {
  const BeamMotion m = columns_of(model);
  const Slots& slots = model.slots();
  Buffer<double> load;  // of the slots of a block
  std::vector<std::uint32_t> left;
  for (std::size_t block = 0; block < slots.blocks(); ++block) {
    const std::size_t first_row = m.first_row[block];
    load.assign(6 * lanes * (m.first_row[block + 1] - first_row));
    left.clear();
    kernels().find_beam_efforts(m, {nullptr, nullptr, nullptr, load.data(), &left}, block,
                                block + 1);
    const auto place_of = [&](std::size_t row, int lane) {
      return load.data() + 6 * lanes * (row - first_row) + static_cast<std::size_t>(lane);
    };
    for (const std::uint32_t slot : left) {
      const auto [row, lane] = Slots::place_of(slot);
      const auto i = static_cast<std::int32_t>(block * lanes) + lane;
      const BeamLoad<double> one = effort(m, i, m.neighbour[slot], row, lane).load;
      set_lanes_vector(place_of(row, lane), 0, one.force);
      set_lanes_vector(place_of(row, lane), std::size_t{3} * lanes, one.moment_i);
    }
    slots.for_each_in(block, [&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
      if (i > j) return;
      const double* at = place_of(row, lane);
      visit({i, j, rest_chord(model.specimen(), {i, j}), lanes_vector(at, 0),
             lanes_vector(at, std::size_t{3} * lanes)});
    });
  }
}

void Beams::observe(const Model& model, Observation& observation) const {
  const std::size_t count = model.slots().padded_elements(), blocks = model.slots().blocks();
  ObservedMotion& motion = observation.motion;
  motion.force.assign(count, {});
  motion.moment.assign(count, {});
  std::vector<double> energy(blocks, 0.0), work(blocks, 0.0);
  const BeamMotion columns_now = columns_of(model);
  Buffer<double> forces(3 * count), moments(3 * count), energies(count);
  for_blocks(blocks, least_blocks_observed, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> left;
    kernels().find_beam_efforts(columns_now,
                                {forces.begin(), moments.begin(), energies.begin(), nullptr, &left},
                                first, last);
    for (std::size_t i = first * lanes; i < last * lanes; ++i) {
      const std::size_t at = Model::at(columns::velocity, i);
      motion.force[i] = lanes_vector(forces.begin(), at);
      motion.moment[i] = lanes_vector(moments.begin(), at);
      energy[i / lanes] += energies[i];
    }
    for (const std::uint32_t slot : left) {
      const auto [row, lane] = Slots::place_of(slot);
      const std::int32_t i = model.slots().element_of({row, lane});
      const BondEffort b = effort(columns_now, i, columns_now.neighbour[slot], row, lane);
      const auto element = static_cast<std::size_t>(i);
      motion.force[element] += b.load.force;
      motion.moment[element] += b.load.moment_i;
      energy[element / lanes] += 0.5 * b.energy;
      work[element / lanes] += 0.5 * b.plastic_work;
    }
  });
  double elastic = 0;
  for (const double part : energy) elastic += part;
  observation.energies.add(EnergyLedger::Kind::stored, "elastic_energy", elastic);
  if (demands_.plasticity) {
    double plastic = 0;
    for (const double part : work) plastic += part;
    const double* kept = model.data(columns::plastic_work);
    for (std::size_t i = 0; i < model.elements(); ++i) plastic += kept[i];
    observation.energies.add(EnergyLedger::Kind::dissipated, "plastic_work", plastic);
  }

  const double* velocity = model.data(columns::velocity);
  const double* inverse_mass = model.data(columns::inverse_mass);
  const bool has_rotation = demands_.has_rotation();
  const double* spin = has_rotation ? model.data(columns::angular_velocity) : nullptr;
  const double* inverse_inertia = has_rotation ? model.data(columns::inverse_inertia) : nullptr;
  const std::size_t elements = model.elements();
  motion.force.resize(elements);
  motion.moment.resize(elements);
  motion.velocity.resize(elements);
  motion.angular_velocity.resize(has_rotation ? elements : 0);
  motion.kinetic_energy = motion.squared_impulse = 0;
  for (std::size_t i = 0; i < elements; ++i) {
    if (!(inverse_mass[i] > 0)) continue;  // removed
    const std::size_t at = Model::at(columns::velocity, i);
    Vector& v = motion.velocity[i];
    v = lanes_vector(velocity, at) + (observation.behind * inverse_mass[i]) * motion.force[i];
    motion.kinetic_energy += 0.5 * dot(v, v) / inverse_mass[i];
    motion.add_impulse({}, motion.force[i], inverse_mass[i]);
    if (!has_rotation) continue;
    Vector& w = motion.angular_velocity[i];
    w = lanes_vector(spin, at) + (observation.behind * inverse_inertia[i]) * motion.moment[i];
    motion.kinetic_energy += 0.5 * dot(w, w) / inverse_inertia[i];
    motion.add_impulse({}, motion.moment[i], inverse_inertia[i]);
  }
}

double Beams::spent(const Model& model) const {
  double work = 0;
  if (model.has(columns::plastic_work))
    for (std::size_t i = 0; i < model.elements(); ++i) work += model.data(columns::plastic_work)[i];
  return work;
}

void Beams::show(const Model& model, Frame& frame) const {
  if (model.has(columns::plastic_work)) {
    const double* work = model.data(columns::plastic_work);
    frame.add("plastic_work", {work, work + model.elements()});
  }
  if (!demands_.plasticity && !demands_.rupture) return;
  std::vector<double> had(model.elements(), 0), broken(model.elements(), 0);
  std::vector<double> stress, plastic_strain, intact;
  for (const Pair& pair : frame.bonds()) {
    const auto place = model.slots().find(pair.i, pair.j);
    for (const std::int32_t element : {pair.i, pair.j}) {
      had[static_cast<std::size_t>(element)] += 1;
      if (!place) broken[static_cast<std::size_t>(element)] += 1;
    }
    intact.push_back(place ? 1 : 0);
    stress.push_back(0);
    plastic_strain.push_back(0);
    if (!place) continue;
    const Bond b = bond(model, pair.i, pair.j, place->row, place->lane);
    stress.back() = b.rigidity().axial / b.section() * b.response.strain;
    plastic_strain.back() = b.response.history.strain;
  }
  for (std::size_t i = 0; i < had.size(); ++i)
    if (had[i] > 0) broken[i] /= had[i];
  frame.add("broken_bonds", broken);
  frame.add_of_bonds("stress", stress);
  frame.add_of_bonds("plastic_strain", plastic_strain);
  frame.add_of_bonds("intact", intact);
}

}  // namespace solidem
