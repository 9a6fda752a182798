// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every instruction set's kernels against the laws in plain doubles.
#include "effects/kernels/kernels.hpp"
#include "effects/beam_parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "effects/beams.hpp"
#include "laws/rigid_sphere.hpp"
#include "support/beams.hpp"

namespace solidem::kernels_test {

/// Moves and turns every element by a little, the same in every run.
void disturb(Model& model, double size) {
  double* pose = model.data(columns::pose);
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const auto k = static_cast<double>(i);
    for (int axis = 0; axis < 3; ++axis)
      pose[8 * i + static_cast<std::size_t>(axis)] += size * 1e-4 * std::sin(3.7 * k + axis);
    const Quaternion<double> q =
        turn(Quaternion<double>{}, {size * std::sin(k), size * std::cos(2 * k), size}, 1.0);
    pose[8 * i + 4] = q.w;
    pose[8 * i + 5] = q.v.x;
    pose[8 * i + 6] = q.v.y;
    pose[8 * i + 7] = q.v.z;
  }
}

using Law = BeamParameters::Law;
using RadiusFrom = BeamParameters::RadiusFrom;

/// What bonds do besides being elastic.
struct Inelastic {
  std::optional<PlasticityParameters> plasticity;
  std::optional<RuptureParameters> rupture;
};

struct Variant {
  Law law;
  RadiusFrom radius_from;
  bool periodic;
  Inelastic inelastic;
};

// Of the order of the strains that the elements are given: some bonds flow and some break.
constexpr double break_strain = 0.012;

Setup setup_of(const Variant& variant) {
  auto setup = elastic_setup();
  setup.get<BeamParameters>()->law = variant.law;
  if (variant.law == Law::spring) setup.get<BeamParameters>()->shear_modulus = 0;
  setup.get<BeamParameters>()->radius_from = variant.radius_from;
  setup.get<PlasticityParameters>() = variant.inelastic.plasticity;
  setup.get<RuptureParameters>() = variant.inelastic.rupture;
  return setup;
}

/// All columns of a model, to begin anew from.
std::vector<std::vector<double>> contents(const Model& model) {
  std::vector<std::vector<double>> all;
  for (const Column* column : model.columns())
    all.emplace_back(model.data(*column), model.data(*column) + model.size(*column));
  return all;
}

void put_back(Model& model, const std::vector<std::vector<double>>& all) {
  for (std::size_t k = 0; k < all.size(); ++k)
    std::copy(all[k].begin(), all[k].end(), model.data(*model.columns()[k]));
}

void expect_vector(const double* column, std::size_t at, const Vector& expected, double tolerance) {
  EXPECT_NEAR(column[at], expected.x, tolerance);
  EXPECT_NEAR(column[at + lanes], expected.y, tolerance);
  EXPECT_NEAR(column[at + 2 * lanes], expected.z, tolerance);
}

/// What bonds do to elements, and energies, by the law in plain doubles.
struct Efforts {
  std::vector<Vector> force, moment;
  double energy = 0, work = 0;
  explicit Efforts(std::size_t elements) : force(elements), moment(elements) {}
  void add(std::size_t element, const Beams::Bond& bond) {
    force[element] += bond.load().force;
    moment[element] += bond.load().moment_i;
    energy += 0.5 * bond.energy();
    work += 0.5 * bond.response.plastic_work;
  }
};

/// What a kernel finds of all bonds, and what it leaves: those that flow, and no others of a body
/// that has not flowed before.
void expect_efforts(const Kernels& kernels, const BeamMotion& motion, const Model& model,
                    const std::map<std::uint32_t, Beams::Bond>& bonds, const Efforts& expected) {
  const std::size_t padded = model.slots().padded_elements();
  Buffer<double> force(3 * padded), moment(3 * padded), energy(padded);
  Buffer<double> slot_load(6 * lanes * model.slots().rows());
  std::vector<std::uint32_t> left;
  kernels.find_beam_efforts(
      motion, {force.begin(), moment.begin(), energy.begin(), slot_load.begin(), &left}, 0,
      model.slots().blocks());
  Efforts rest(model.elements());
  for (const std::uint32_t slot : left)
    rest.add(static_cast<std::size_t>(model.slots().element_of(Slots::place_of(slot))),
             bonds.at(slot));
  double largest = 0, largest_moment = 0, sum = rest.energy;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    largest = std::max(largest, norm(expected.force[i]));
    largest_moment = std::max(largest_moment, norm(expected.moment[i]));
    sum += energy[i];
  }
  EXPECT_NEAR(sum, expected.energy, 1e-12 * expected.energy);
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const std::size_t at = Model::at(columns::velocity, i);
    expect_vector(force.begin(), at, expected.force[i] - rest.force[i], 1e-12 * largest);
    expect_vector(moment.begin(), at, expected.moment[i] - rest.moment[i], 1e-12 * largest_moment);
  }
  const std::set<std::uint32_t> those_left(left.begin(), left.end());
  EXPECT_EQ(those_left.size(), left.size());
  if (motion.yield == nullptr) {
    EXPECT_TRUE(left.empty());
  }
  for (const auto& [slot, bond] : bonds) {
    if (those_left.count(slot) > 0) continue;
    EXPECT_EQ(bond.response.plastic_work, 0);
    const double* load = slot_load.begin() + 6 * lanes * (slot / lanes) + std::size_t{slot} % lanes;
    expect_vector(load, 0, bond.load().force, 1e-12 * largest);
    expect_vector(load, std::size_t{3} * lanes, bond.load().moment_i, 1e-12 * largest_moment);
  }
}

class BeamKernel : public testing::TestWithParam<Variant> {};

TEST_P(BeamKernel, pulls_flows_and_breaks_as_the_law_says) {
  const Variant variant = GetParam();
  Specimen specimen =
      variant.periodic ? crystal("fcc", {3, 3, 3}, {true, true, true}) : jittered("bcc", {4, 3, 3});
  const Simulation simulation(setup_of(variant), std::move(specimen), true);
  Model& model = const_cast<Simulation&>(simulation).model();
  const Beams& beams = *simulation.find<Beams>();
  disturb(model, 0.02);
  const bool has_rotation = model.has(columns::angular_velocity);
  ASSERT_EQ(has_rotation, variant.law != Law::spring);
  ASSERT_EQ(model.has(columns::image_shift), variant.periodic);
  const bool flows = variant.inelastic.plasticity.has_value();
  const bool may_break = variant.inelastic.rupture.has_value();

  // What the law says of every slot.
  std::map<std::uint32_t, Beams::Bond> bonds;
  std::vector<std::uint32_t> expected_breaking;
  std::size_t flowing = 0;
  Efforts expected(model.elements());
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const auto at = static_cast<std::uint32_t>(row * lanes) + static_cast<std::uint32_t>(lane);
    const Beams::Bond bond = beams.bond(model, i, j, row, lane);
    bonds.emplace(at, bond);
    expected.add(static_cast<std::size_t>(i), bond);
    if (bond.response.plastic_work > 0) ++flowing;
    if (may_break && breaks(variant.inelastic.rupture->law, bond.response.strains))
      expected_breaking.push_back(at);
  });
  if (flows) {
    EXPECT_GT(flowing, bonds.size() / 10);
    EXPECT_LT(flowing, bonds.size());
  }
  if (may_break) {
    EXPECT_GT(expected_breaking.size(), 0u);
    EXPECT_LT(expected_breaking.size(), bonds.size());
  }

  double largest = 0, largest_spin = 0, largest_force = 0, largest_moment = 0;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    largest_force = std::max(largest_force, norm(expected.force[i]));
    largest_moment = std::max(largest_moment, norm(expected.moment[i]));
    largest = std::max(largest, norm(expected.force[i]) * model.data(columns::inverse_mass)[i]);
    if (has_rotation)
      largest_spin = std::max(largest_spin,
                              norm(expected.moment[i]) * model.data(columns::inverse_inertia)[i]);
  }
  ASSERT_GT(largest, 0);
  Observation seen;
  simulation.observe(seen);
  for (std::size_t i = 0; i < model.elements(); ++i) {
    EXPECT_LT(norm(seen.motion.force[i] - expected.force[i]), 1e-12 * largest_force);
    EXPECT_LE(norm(seen.motion.moment[i] - expected.moment[i]), 1e-12 * largest_moment);
  }
  EXPECT_NEAR(seen.energies.of("elastic_energy"), expected.energy, 1e-12 * expected.energy);

  const auto before = contents(model);
  for (const Kernels* kernels : usable_kernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    put_back(model, before);
    expect_efforts(*kernels, beams.motion(model), model, bonds, expected);
    std::vector<std::uint32_t> breaking;
    BeamMotion motion = beams.motion(model);
    motion.kick = 1;
    motion.breaking = &breaking;
    kernels->move_beams(motion, 0, model.slots().blocks());
    std::sort(breaking.begin(), breaking.end());
    EXPECT_EQ(breaking, expected_breaking);
    double work = 0;
    for (std::size_t i = 0; i < model.elements(); ++i) {
      const std::size_t at = Model::at(columns::velocity, i);
      expect_vector(model.data(columns::velocity), at,
                    model.data(columns::inverse_mass)[i] * expected.force[i], 1e-12 * largest);
      if (has_rotation)
        expect_vector(model.data(columns::angular_velocity), at,
                      model.data(columns::inverse_inertia)[i] * expected.moment[i],
                      1e-12 * largest_spin);
      // No drift: every pose is handed on as it is.
      for (std::size_t k = 0; k < 8; ++k)
        EXPECT_NEAR(model.next(columns::pose)[8 * i + k], model.data(columns::pose)[8 * i + k],
                    1e-15);
      if (flows) work += model.data(columns::plastic_work)[i];
    }
    EXPECT_NEAR(work, expected.work, 1e-12 * expected.energy);
    EXPECT_NEAR(seen.energies.of("plastic_work"), expected.work, 1e-12 * expected.energy);
    if (!flows) continue;
    for (const auto& [index, bond] : bonds) {
      const Slots::Place place = Slots::place_of(index);
      const BeamHistory<double>& history = bond.response.history;
      EXPECT_NEAR(model.data(columns::plastic_strain)[index], history.strain, 1e-13);
      // Negative of a bond that has flowed.
      EXPECT_EQ(model.data(columns::limit_strain)[index] > 0, !(history.strain > 0));
      EXPECT_NEAR(
          std::fabs(model.data(columns::limit_strain)[index]),
          limit_strain(&variant.inelastic.plasticity->hardening, variant.inelastic.plasticity->law,
                       &variant.inelastic.rupture->law, history.strain),
          1e-13);
      EXPECT_NEAR(model.data(columns::plastic_extension)[index], history.extension,
                  1e-13 * bond.rest_length());
      if (!has_rotation) continue;
      EXPECT_NEAR(model.data(columns::plastic_twist)[index], history.twist, 1e-13);
      const auto at = Model::at_slot(columns::section_normal, place.row, place.lane);
      expect_vector(model.data(columns::section_normal), at, history.normal_i, 1e-13);
      expect_vector(model.data(columns::far_section_normal), at, history.normal_j, 1e-13);
    }
  }
}

/// Every yield law by either rule, and every rupture law.
std::vector<Inelastic> inelastic_kinds() {
  VoceHardening voce;
  voce.yield_strain = 0.005;
  voce.saturation_strain = 0.003;
  voce.plastic_scale = 0.004;
  MohrCoulombRupture mohr_coulomb;
  mohr_coulomb.tensile_strain = 0.012;
  mohr_coulomb.cohesion_strain = 0.008;
  mohr_coulomb.friction_coefficient = 0.5;
  MohrCoulombRupture mohr_coulomb_of_flowing = mohr_coulomb;
  mohr_coulomb_of_flowing.tensile_strain = 0.0055;
  const RuptureParameters at_strain = breaking_at_strain(break_strain);
  std::vector<Inelastic> all{{{}, {}}, {{}, at_strain}, {{}, RuptureParameters{mohr_coulomb}}};
  for (const FlowRule rule : {FlowRule::radial_return, FlowRule::scaled_offset})
    for (const YieldLaw& law : {YieldLaw{LinearHardening{0.005, 0.1}}, YieldLaw{voce}})
      for (const RuptureParameters& rupture :
           {at_strain, RuptureParameters{mohr_coulomb_of_flowing}})
        all.push_back({PlasticityParameters{rule, law}, rupture});
  return all;
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const Law law : {Law::euler_bernoulli, Law::timoshenko, Law::spring})
    for (const RadiusFrom radius_from : {RadiusFrom::mean, RadiusFrom::pair})
      for (const bool periodic : {false, true})
        for (const Inelastic& inelastic : inelastic_kinds())
          all.push_back({law, radius_from, periodic, inelastic});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Variants, BeamKernel, testing::ValuesIn(variants()));

TEST(HeatKernel, gives_the_rates_of_the_law) {
  Simulation simulation(thermal_setup(), jittered("bcc", {4, 3, 3}));
  Model& model = simulation.model();
  double* temperature = model.data(columns::temperature);
  for (std::size_t i = 0; i < model.elements(); ++i)
    temperature[i] = 300 + 100 * std::sin(static_cast<double>(i));
  std::vector<double> rate(model.elements(), 0.0);
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    rate[static_cast<std::size_t>(i)] +=
        model.data(columns::conductance)[Model::at_slot(columns::conductance, row, lane)] *
        (temperature[j] - temperature[i]) * model.data(columns::inverse_heat_capacity)[i];
  });
  const double dt = 1e-6;
  for (const Kernels* kernels : usable_kernels()) {
    kernels->conduct({model.slots().first_row(), model.slots().neighbours(), temperature,
                      model.next(columns::temperature), model.data(columns::inverse_heat_capacity),
                      model.data(columns::conductance), dt},
                     0, model.slots().blocks());
    for (std::size_t i = 0; i < model.elements(); ++i)
      EXPECT_NEAR(model.next(columns::temperature)[i], temperature[i] + dt * rate[i], 3e-13)
          << kernels->instruction_set;
  }
}

}  // namespace solidem::kernels_test
