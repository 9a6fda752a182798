// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a simulation saves, and what it refuses to go on from.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "effects/beam_parameters.hpp"
#include "model/error.hpp"
#include "support/refusal.hpp"
#include "support/specimens.hpp"

namespace solidem::checkpoints_test {

using Saved = std::map<std::string, std::vector<double>>;

Setup breaking_setup() {
  auto setup = elastic_setup();
  setup.get<RuptureParameters>() = RuptureParameters{};
  return setup;
}

std::string refusal(const Setup& setup, const Specimen& specimen, const Saved& saved) {
  Simulation simulation(setup, specimen);
  return test::refusal_of([&] { simulation.restore(10, saved); });
}

TEST(Checkpoints, know_the_whole_specimen_and_not_its_sums_alone) {
  const Specimen specimen = jittered("bcc", {4, 3, 3});
  const Saved saved = Simulation(elastic_setup(), specimen).save();
  EXPECT_EQ(refusal(elastic_setup(), specimen, saved), "");
  Specimen other = specimen;
  other.radius[3] *= 1.01;
  other.radius[8] -= other.radius[3] - specimen.radius[3];
  EXPECT_NE(refusal(elastic_setup(), other, saved), "") << "radii";
  other = specimen;
  std::swap(other.position[3], other.position[8]);
  EXPECT_NE(refusal(elastic_setup(), other, saved), "") << "positions";
  other = specimen;
  other.bonds.front() = {0, static_cast<std::int32_t>(specimen.size()) - 1};
  std::sort(other.bonds.begin(), other.bonds.end());
  EXPECT_NE(refusal(elastic_setup(), other, saved), "") << "bonds";
}

TEST(Checkpoints, are_not_made_of_what_is_not_a_number) {
  Simulation simulation(elastic_setup(), jittered("bcc", {4, 3, 3}));
  EXPECT_NO_THROW(simulation.save());
  simulation.model().data(columns::velocity)[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(simulation.save(), RunError);
}

TEST(Checkpoints, with_numbers_that_mean_nothing_are_refused_and_none_crashes) {
  const auto setup = breaking_setup();
  const Specimen specimen = jittered("bcc", {3, 2, 2});
  const Saved saved = Simulation(setup, specimen).save();
  ASSERT_EQ(refusal(setup, specimen, saved), "");
  const auto spoilt = [&](const std::string& name, auto spoil) {
    Saved wrong = saved;
    spoil(wrong.at(name));
    return refusal(setup, specimen, wrong);
  };
  // fracture_energy, no last acts, first_time, no broken bonds, no removed elements; then all
  // neighbours.
  const std::string rupture = "effect.rupture";
  ASSERT_EQ(saved.count(rupture), 1u);
  const std::size_t broken = 3, first_neighbour = 5;
  for (const double wrong : {-1.0, 1e6, 0.5, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(spoilt(rupture, [&](auto& values) { values[first_neighbour] = wrong; }), "") << wrong;
    EXPECT_NE(spoilt(rupture, [&](auto& values) { values[broken] = wrong; }), "") << wrong;
  }
  EXPECT_NE(spoilt(rupture, [&](auto& values) { values[first_neighbour] = 0; }), "")
      << "a bond of one side only";
  EXPECT_NE(spoilt(rupture, [](auto& values) { values.pop_back(); }), "");
  EXPECT_NE(spoilt(rupture, [](auto& values) { values.push_back(0); }), "");
  EXPECT_NE(spoilt("column.pose", [](auto& values) { values.pop_back(); }), "");
  EXPECT_NE(spoilt("column.velocity",
                   [](auto& values) { values[0] = std::numeric_limits<double>::quiet_NaN(); }),
            "");
  EXPECT_NE(spoilt("time_step", [](auto& values) { values.clear(); }), "");
  constexpr std::size_t counted_from = 2;  // time, length of the last step, step and time of origin
  for (const double wrong : {-1.0, 0.5, 11.0, 6e180})
    EXPECT_NE(spoilt("clock", [&](auto& values) { values[counted_from] = wrong; }), "") << wrong;
  Saved less = saved;
  less.erase("column.pose");
  EXPECT_NE(refusal(setup, specimen, less), "");
}

}  // namespace solidem::checkpoints_test
