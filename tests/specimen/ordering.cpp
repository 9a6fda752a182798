// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/ordering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "specimen/bonds.hpp"

namespace solidem::ordering_test {

TEST(Ordering, HilbertCurveVisitsNeighbouringCellsOneAfterTheOther) {
  // The curve through the 16³ coarse cells of the 2^21 grid: successive cells share a face.
  constexpr std::uint32_t side = 16, cell = (1u << 21) / side;
  std::vector<std::pair<std::uint64_t, std::array<int, 3>>> visits;
  for (std::uint32_t x = 0; x < side; ++x)
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t z = 0; z < side; ++z)
        visits.push_back(
            {hilbert_index(x * cell, y * cell, z * cell) / (std::uint64_t{cell} * cell * cell),
             {int(x), int(y), int(z)}});
  std::sort(visits.begin(), visits.end());
  for (std::size_t k = 0; k < visits.size(); ++k) {
    ASSERT_EQ(visits[k].first, k);
    if (k == 0) continue;
    int steps = 0;
    for (int axis = 0; axis < 3; ++axis)
      steps += std::abs(visits[k].second[axis] - visits[k - 1].second[axis]);
    ASSERT_EQ(steps, 1) << "between cells " << k - 1 << " and " << k;
  }
}

TEST(Ordering, KeepsElementsBondsAndSetsTogether) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Specimen specimen;
  for (int i = 0; i < 600; ++i) {
    specimen.position.push_back({uniform(random), uniform(random), uniform(random)});
    specimen.radius.push_back(0.05 + 1e-5 * i);
  }
  specimen.domain.upper = {1, 1, 1};
  specimen.domain.volume = 1;
  make_bonds(specimen, 0.0);
  for (std::int32_t i = 0; i < 600; i += 7) specimen.sets["some"].push_back(i);
  const Specimen before = specimen;
  sort_elements(specimen);

  // The radius tells who is who.
  const auto was = [&](std::int32_t i) {
    return static_cast<std::int32_t>(std::lround((specimen.radius[i] - 0.05) * 1e5));
  };
  EXPECT_EQ(specimen.bonds, find_bonds(specimen, 0.0));
  EXPECT_EQ(specimen.bonds.size(), before.bonds.size());
  for (std::int32_t i = 0; i < 600; ++i)
    EXPECT_EQ(specimen.position[i].x, before.position[was(i)].x);
  EXPECT_EQ(specimen.sets["some"].size(), before.sets.at("some").size());
  for (const std::int32_t i : specimen.sets["some"]) EXPECT_EQ(was(i) % 7, 0);

  const std::vector<std::int32_t> degree = count_bonds(specimen);
  for (std::size_t i = 1; i < degree.size(); ++i)
    if (i % 128 != 0) {
      EXPECT_GE(degree[i - 1], degree[i]);
    }
}

}  // namespace solidem::ordering_test
