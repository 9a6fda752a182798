// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every instruction set's kernels of central forces against the laws in plain doubles, summed over
// all pairs of elements and images.
#include <gtest/gtest.h>
#include <omp.h>

#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/central_forces.hpp"
#include "effects/kernels/kernels.hpp"
#include "laws/central_interaction.hpp"
#include "laws/crack_face.hpp"
#include "model/lane_vectors.hpp"
#include "support/central_forces.hpp"

namespace solidem::central_kernels_test {

constexpr double range = 1.4;
constexpr double deepest = 0.05;  // some pairs are brought nearer
constexpr double drag = 0.08;     // N·s/m
constexpr double crack_threshold = 0.25;
constexpr double tolerance = 1e-12;

struct Variant {
  CentralLaw law;
  bool dissipates, cracks, periodic;
  CentralEquilibrium equilibrium;
};

void PrintTo(const Variant& v, std::ostream* out) {
  *out << name_of(v.law) << (v.dissipates ? ", dissipation" : "") << (v.cracks ? ", cracks" : "")
       << (v.periodic ? ", periodic" : "")
       << (v.equilibrium == CentralEquilibrium::radii ? ", radii" : "");
}

Setup setup_of(const Variant& variant) {
  auto setup = central_setup(variant.law, range);
  CentralForceParameters& forces = *setup.get<CentralForceParameters>();
  forces.bond_tolerance = 0.2;
  forces.equilibrium = variant.equilibrium;
  forces.interpenetration = deepest;
  forces.skin = 0.6;  // more than elements are displaced
  if (variant.dissipates) forces.dissipation = drag;
  if (variant.cracks) setup.get<DamageParameters>() = DamageParameters{crack_threshold, 1, 0, 100};
  return setup;
}

Specimen specimen_of(const Variant& variant) {
  Specimen specimen =
      crystal("fcc", {3, 3, 3}, {variant.periodic, variant.periodic, variant.periodic});
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    specimen.position[i] += 5e-6 * Vector{uniform(random), uniform(random), uniform(random)};
    specimen.radius[i] *= 1 + 0.05 * uniform(random);
  }
  return specimen;
}

/// A neighbour that acts, by the rules alone.
struct Neighbour {
  std::size_t element;
  Vector chord;
  double distance, equilibrium;
};

/// Every image of every other element within range of each.
std::vector<std::vector<Neighbour>> neighbours_of(const Simulation& simulation,
                                                  const CentralForceParameters& forces) {
  const Specimen& specimen = simulation.model().specimen();
  const Vector period = specimen.domain.upper - specimen.domain.lower;
  const int images = specimen.domain.is_periodic() ? 1 : 0;
  std::vector<std::vector<Neighbour>> all(specimen.size());
  for (std::size_t i = 0; i < specimen.size(); ++i)
    for (std::size_t j = 0; j < specimen.size(); ++j)
      for (int x = -images; x <= images; ++x)
        for (int y = -images; y <= images; ++y)
          for (int z = -images; z <= images; ++z) {
            if (i == j) continue;
            const Vector shift{x * period.x, y * period.y, z * period.z};
            const Vector now = place_of(simulation, j) - place_of(simulation, i) + shift;
            const double radii = specimen.radius[i] + specimen.radius[j];
            if (!(norm(now) < forces.range * radii)) continue;
            const double then = norm(specimen.position[j] - specimen.position[i] + shift);
            const bool known = then <= (1 + forces.bond_tolerance) * radii * (1 + 1e-12);
            const bool remembered = known && forces.equilibrium == CentralEquilibrium::initial;
            all[i].push_back({j, now, norm(now), remembered ? then : radii});
          }
  return all;
}

class CentralKernel : public testing::TestWithParam<Variant> {};

TEST_P(CentralKernel, pulls_drags_and_cracks_as_the_law_says) {
  const Variant variant = GetParam();
  const auto setup = setup_of(variant);
  const CentralForceParameters& forces = *setup.get<CentralForceParameters>();
  Simulation simulation(setup, specimen_of(variant), true);
  Model& model = simulation.model();
  const std::size_t count = model.elements();
  ASSERT_EQ(model.has(columns::image_shift), variant.periodic);
  ASSERT_EQ(model.has(columns::rest_length), variant.equilibrium == CentralEquilibrium::initial);
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) model.positions()[i][axis] += 8e-6 * uniform(random);
  shake(simulation, 20);
  const std::vector<std::vector<Neighbour>> neighbours = neighbours_of(simulation, forces);

  std::vector<Vector> barycentre(count);
  std::size_t crack_faces = 0;
  if (variant.cracks)
    for (std::size_t i = 0; i < count; ++i) {
      Vector sum{};
      for (const Neighbour& other : neighbours[i]) sum += other.chord;
      sum = (1.0 / static_cast<double>(neighbours[i].size())) * sum;
      if (norm(sum) <= crack_threshold * model.specimen().radius[i]) continue;
      barycentre[i] = sum;
      ++crack_faces;
    }
  std::vector<Vector> force(count);
  double power = 0, nearest = 1e300, scale = 0, potential = 0, pairs = 0;
  std::size_t deep = 0, cracked = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (const Neighbour& other : neighbours[i]) {
      const double of_law = std::visit(
          [&](const auto& law) {
            return central_force(law, deepest, other.distance, other.equilibrium).force;
          },
          variant.law);
      double push = of_law;
      if (variant.cracks && push < 0 && dot(barycentre[i], other.chord) < 0 &&
          dot(barycentre[other.element], other.chord) > 0) {
        push = 0;
        ++cracked;
      }
      if (variant.dissipates) {
        const double approach =
            dot(velocity_of(simulation, i) - velocity_of(simulation, other.element), other.chord) /
            other.distance;
        push += drag * approach;
        power += 0.5 * drag * approach * approach;
      }
      const double reach =
          range * (model.specimen().radius[i] + model.specimen().radius[other.element]);
      potential += 0.5 * std::visit(
                             [&](const auto& law) {
                               return central_potential(law, deepest, reach, other.distance,
                                                        other.equilibrium);
                             },
                             variant.law);
      pairs += 0.5;
      force[i] -= (push / other.distance) * other.chord;
      nearest = std::min(nearest, other.distance / other.equilibrium);
      scale = std::max(scale, std::fabs(push));
      if (other.distance < (1 - deepest) * other.equilibrium) ++deep;
    }
  ASSERT_GT(deep, 5u);
  if (variant.cracks && !variant.periodic) {
    ASSERT_GT(crack_faces, count / 10);
    ASSERT_LT(crack_faces, count);
    ASSERT_GT(cracked, 0u);
  }

  const std::vector<double> start(model.data(columns::velocity),
                                  model.data(columns::velocity) + model.size(columns::velocity));
  for (const Kernels* kernels : usable_kernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    std::copy(start.begin(), start.end(), model.data(columns::velocity));
    const auto where = [&](const Column& column) {
      return model.has(column) ? model.data(column) : nullptr;
    };
    CentralMotion motion{};
    motion.law = variant.law;
    motion.first_row = model.slots().first_row();
    motion.neighbour = model.slots().neighbours();
    motion.position = model.positions().first;
    motion.next_position = model.next_positions().first;
    motion.velocity = model.data(columns::velocity);
    motion.inverse_mass = model.data(columns::inverse_mass);
    motion.rest_length = where(columns::rest_length);
    motion.image_shift = where(columns::image_shift);
    motion.range = range;
    motion.interpenetration = deepest;
    motion.kick = 1e-7;
    motion.drift = 1e-7;
    if (variant.dissipates) {
      motion.dissipation = drag;
      motion.dissipated_energy = model.data(columns::dissipated_energy);
      std::fill_n(motion.dissipated_energy, model.size(columns::dissipated_energy), 0.0);
    }
    motion.barycentre = where(columns::barycentre);
    motion.crack_threshold = crack_threshold;
    if (variant.cracks) {
      kernels->find_crack_faces(motion, 0, model.slots().blocks());
      for (std::size_t i = 0; i < count; ++i) {
        const double* shown = motion.barycentre + 4 * i;
        EXPECT_LT(norm(Vector{shown[0], shown[1], shown[2]} - barycentre[i]), 1e-12 * hand_radius);
        EXPECT_EQ(shown[3], static_cast<double>(neighbours[i].size()));
      }
    }
    const std::size_t padded = model.slots().padded_elements();
    Buffer<double> loads(3 * padded), stored(padded), within(padded), drags(padded), ratio(padded);
    Buffer<double> slot_force(3 * lanes * model.slots().rows());
    kernels->find_central_efforts(
        motion,
        {loads.begin(), stored.begin(), within.begin(),
         variant.dissipates ? drags.begin() : nullptr, ratio.begin(), slot_force.begin()},
        0, model.slots().blocks());
    double all_stored = 0, all_within = 0, all_drags = 0, largest_ratio = 0;
    std::vector<Vector> of_slots(count);
    model.slots().for_each([&](std::int32_t i, std::int32_t, std::size_t row, int lane) {
      of_slots[static_cast<std::size_t>(i)] +=
          lanes_vector(slot_force.begin(), 3 * lanes * row + static_cast<std::size_t>(lane));
    });
    for (std::size_t i = 0; i < count; ++i) {
      const Vector load = lanes_vector(loads.begin(), Model::at(columns::velocity, i));
      EXPECT_LT(norm(load - force[i]), tolerance * scale);
      EXPECT_LT(norm(of_slots[i] - force[i]), tolerance * scale);
      all_stored += stored[i];
      all_within += within[i];
      all_drags += drags[i];
      largest_ratio = std::max(largest_ratio, ratio[i]);
    }
    EXPECT_NEAR(all_stored, potential, 1e-12 * std::fabs(potential));
    EXPECT_EQ(all_within, pairs);
    EXPECT_NEAR(all_drags, power, 1e-12 * power);
    EXPECT_NEAR(largest_ratio * nearest, 1, 1e-14);

    kernels->move_by_central_forces(motion, 0, model.slots().blocks());
    Vector sum{};
    double sizes = 0, dissipated = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = Model::at(columns::velocity, i);
      const Vector before{start[at], start[at + lanes], start[at + std::size_t{2} * lanes]};
      const Vector after = velocity_of(simulation, i);
      // Velocities carry the round-off of what they were before.
      const double kick = motion.kick * motion.inverse_mass[i];
      EXPECT_LT(norm(after - before - kick * force[i]),
                tolerance * kick * scale + 1e-15 * norm(before));
      const double* next = model.next_positions()[i];
      EXPECT_LT(
          norm(Vector{next[0], next[1], next[2]} - place_of(simulation, i) - motion.drift * after),
          1e-15 * 1e-3);
      const Vector momentum = (1 / motion.inverse_mass[i]) * (after - before);
      sum += momentum;
      sizes += norm(momentum);
      if (!variant.dissipates) continue;
      dissipated += motion.dissipated_energy[i];
      const double* carried = model.next_felt_velocities()[i];
      EXPECT_EQ(norm(Vector{carried[0], carried[1], carried[2]} - after), 0);
    }
    EXPECT_LT(norm(sum), 1e-14 * sizes);
    EXPECT_NEAR(motion.compression_ratio * nearest, 1, 1e-14);
    EXPECT_NEAR(dissipated, motion.kick * power, 1e-12 * dissipated);
  }
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const CentralLaw& law : usual_laws())
    for (const bool dissipates : {false, true})
      for (const bool cracks : {false, true})
        for (const bool periodic : {false, true})
          for (const CentralEquilibrium equilibrium :
               {CentralEquilibrium::initial, CentralEquilibrium::radii})
            all.push_back({law, dissipates, cracks, periodic, equilibrium});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Variants, CentralKernel, testing::ValuesIn(variants()));

TEST(CentralKernel, tells_when_an_element_has_left_its_listed_place) {
  Simulation simulation(central_setup(), elements_at(lattice({3, 3, 3})), true);
  Model& model = simulation.model();
  for (const Kernels* kernels : usable_kernels())
    for (const double fraction : {0.99, 1.01}) {
      SCOPED_TRACE(kernels->instruction_set);
      CentralMotion motion{};
      motion.law = usual<Mie>();
      motion.first_row = model.slots().first_row();
      motion.neighbour = model.slots().neighbours();
      motion.position = model.data(columns::position);
      motion.next_position = model.next(columns::position);
      motion.velocity = model.data(columns::velocity);
      motion.inverse_mass = model.data(columns::inverse_mass);
      motion.rest_length = model.data(columns::rest_length);
      motion.range = 1.5;
      motion.listed_position = model.data(columns::listed_position);
      std::fill_n(model.data(columns::listed_margin), model.elements(), 1e-5);
      motion.listed_margin = model.data(columns::listed_margin);
      motion.drift = 1e-7;
      // One that stands in the last block, beside lanes that hold no element.
      set_velocity(simulation, model.elements() - 1, {0, fraction * 100, 0});
      kernels->move_by_central_forces(motion, 0, model.slots().blocks());
      EXPECT_EQ(motion.outran, fraction > 1);
    }
}

TEST(CentralForces, give_the_same_bits_on_any_number_of_threads) {
  const int before = omp_get_max_threads();
  auto setup = central_setup(usual<Piecewise>(), 1.2);
  setup.get<CentralForceParameters>()->dissipation = drag;
  setup.get<DamageParameters>() = DamageParameters{0.4, 1, 3, 20};
  const Specimen body = elements_at(lattice({18, 18, 18}, 2, 0.2));  // blocks for threads to share
  std::map<std::string, std::vector<double>> first;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Simulation simulation(setup, body);
    shake(simulation, 300);  // the body falls apart
    simulation.advance(60);
    auto state = simulation.save();
    for (const auto& [name, value] : simulation.observe().values) state["seen"].push_back(value);
    if (threads == 1) {
      first = state;
      EXPECT_GT(simulation.find<CentralForces>()->searches(), 2u);
      EXPECT_GT(simulation.find<Damage>()->removed(), 0u);
    }
    ASSERT_EQ(state.size(), first.size());
    for (const auto& [name, values] : state)
      EXPECT_TRUE(values == first.at(name)) << name << " on " << threads << " threads";
  }
  omp_set_num_threads(before);
}

}  // namespace solidem::central_kernels_test
