// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "effects/kernels/kernels.hpp"
#include "effects/pseudo_random.hpp"
#include "model/buffer.hpp"
#include "model/slots.hpp"
#include "specimen/listed_spheres.hpp"

namespace solidem::soft_sphere_lists_test {

/// Spheres of radii about 1 at random in a box, a few of them outside where it is not periodic.
struct Spheres {
  CellBox box;
  std::size_t size;
  Buffer<double> ball;
  std::vector<Vector> position;
  double skin = 0.3, largest = 0;

  Spheres(const Vector& extent, std::array<bool, 3> periodic, std::size_t count)
      : box{{}, extent, periodic}, size(count), ball(4 * (count / lanes + 1) * lanes) {
    for (std::size_t k = size; k < ball.size() / 4; ++k)
      ball[4 * k] = ball[4 * k + 1] = ball[4 * k + 2] = 1e30;
    for (std::size_t k = 0; k < size; ++k) {
      const auto along = [&](int axis) {
        const double part = 0.5 + 0.5 * pseudo_random(4 * k + static_cast<std::size_t>(axis));
        const double length = component(extent, axis);
        return periodic[static_cast<std::size_t>(axis)] ? part * length
                                                        : part * (length + 0.4) - 0.2;
      };
      position.push_back({along(0), along(1), along(2)});
      ball[4 * k] = position[k].x;
      ball[4 * k + 1] = position[k].y;
      ball[4 * k + 2] = position[k].z;
      ball[4 * k + 3] = 1 + 0.25 * pseudo_random(4 * k + 3);
      largest = std::max(largest, ball[4 * k + 3]);
    }
  }
  double radius(std::int32_t k) const { return ball[4 * static_cast<std::size_t>(k) + 3]; }
};

/// The neighbours in the order in which the pairs of linked cells come.
std::vector<std::vector<std::int32_t>> expected_lists(const Spheres& spheres) {
  LinkedCells cells(spheres.box, 2 * spheres.largest + spheres.skin, spheres.size);
  cells.sort(spheres.position);
  std::vector<std::vector<std::int32_t>> lists(spheres.size);
  cells.for_each_pair(0, cells.cell_count(),
                      [&](std::int32_t i, std::int32_t j, const Vector& chord) {
                        const double reach = spheres.radius(i) + spheres.radius(j) + spheres.skin;
                        if (!(dot(chord, chord) < reach * reach)) return;
                        lists[static_cast<std::size_t>(i)].push_back(j);
                        lists[static_cast<std::size_t>(j)].push_back(i);
                      });
  return lists;
}

class SoftSphereLists : public testing::TestWithParam<std::pair<Vector, std::array<bool, 3>>> {};

TEST_P(SoftSphereLists, hold_neighbours_in_the_order_of_the_pairs_of_linked_cells) {
  const Spheres spheres(GetParam().first, GetParam().second, 700);
  std::vector<std::uint32_t> first_row;
  std::vector<std::int32_t> neighbour;
  list_spheres({spheres.box, spheres.ball.data(), spheres.size, spheres.largest, spheres.skin},
               first_row, neighbour);
  ASSERT_EQ(first_row.size(), spheres.size / lanes + 2);
  const auto expected = expected_lists(spheres);
  for (std::size_t k = 0; k < spheres.size; ++k) {
    std::vector<std::int32_t> list;
    for (std::size_t row = first_row[k / lanes]; row < first_row[k / lanes + 1]; ++row) {
      const std::int32_t other = neighbour[row * lanes + k % lanes];
      if (other < static_cast<std::int32_t>(spheres.size)) list.push_back(other);
    }
    EXPECT_EQ(list, expected[k]) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(
    of_boxes, SoftSphereLists,
    testing::Values(std::pair{Vector{18, 17, 16}, std::array<bool, 3>{false, false, false}},
                    std::pair{Vector{18, 17, 16}, std::array<bool, 3>{true, true, true}},
                    std::pair{Vector{18, 9.5, 25}, std::array<bool, 3>{false, true, false}},
                    std::pair{Vector{30, 7, 7}, std::array<bool, 3>{true, true, false}},
                    std::pair{Vector{6, 7, 5.5}, std::array<bool, 3>{true, true, true}}));

/// What a kernel makes of the same spheres: forces, sums, and where they stand after a step.
std::vector<double> answer_of(const SoftSphereKernels& kernels, bool is_periodic) {
  Spheres spheres({18, 17, 16}, {is_periodic, false, false}, 700);
  std::vector<std::uint32_t> first_row;
  std::vector<std::int32_t> neighbour;
  list_spheres({spheres.box, spheres.ball.data(), spheres.size, spheres.largest, spheres.skin},
               first_row, neighbour);
  const std::size_t blocks = first_row.size() - 1, padded = blocks * lanes;
  Buffer<double> listed(4 * padded), velocity(3 * padded), force(3 * padded);
  Buffer<double> contact_force(padded), contacts(padded);
  std::copy(spheres.ball.begin(), spheres.ball.end(), listed.begin());
  for (std::size_t k = 0; k < velocity.size() - 3 * lanes; ++k) velocity[k] = pseudo_random(k);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const SoftSphereColumns columns{
      first_row.data(),     neighbour.data(), spheres.ball.data(),
      listed.data(),        velocity.data(),  force.data(),
      contact_force.data(), contacts.data(),  {is_periodic ? 18 : infinity, infinity, infinity},
      is_periodic};
  kernels.find_forces(columns, 0, blocks);
  SoftSphereSums sums;
  kernels.add_up(columns, 0, blocks, sums);
  const double farthest2 = kernels.move(columns, 0, blocks, 0.1, 0.9, 0.2);
  std::vector<double> all{sums.power,         sums.force2,   sums.velocity2,
                          sums.contact_force, sums.contacts, farthest2};
  for (const Buffer<double>* column : {&force, &velocity, &spheres.ball, &contact_force})
    all.insert(all.end(), column->begin(), column->end());
  return all;
}

TEST(SoftSphereKernels, of_all_instruction_sets_give_the_same_bits) {
  for (const bool is_periodic : {false, true}) {
    const std::vector<double> plain = answer_of(usable_kernels().back()->soft_spheres, is_periodic);
    EXPECT_GT(plain[4], 1000);  // contacts
    for (const Kernels* kernels : usable_kernels())
      EXPECT_EQ(answer_of(kernels->soft_spheres, is_periodic), plain) << kernels->instruction_set;
  }
}

TEST(SoftSphereKernels, push_two_spheres_apart_by_the_law) {
  Buffer<double> ball(4 * 8), listed(4 * 8), velocity(3 * 8), force(3 * 8), sum(8), count(8);
  const double rows[] = {0, 0, 0, 1, 1.8, 0, 0, 1.1};
  std::copy(std::begin(rows), std::end(rows), ball.begin());
  for (std::size_t k = 8; k < ball.size(); ++k) ball[k] = k % 4 == 3 ? 0 : 1e30;
  const std::vector<std::uint32_t> first_row{0, 1};
  const std::vector<std::int32_t> neighbour{1, 0, 2, 2, 2, 2, 2, 2};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Kernels* kernels : usable_kernels()) {
    kernels->soft_spheres.find_forces({first_row.data(),
                                       neighbour.data(),
                                       ball.data(),
                                       listed.data(),
                                       velocity.data(),
                                       force.data(),
                                       sum.data(),
                                       count.data(),
                                       {infinity, infinity, infinity},
                                       false},
                                      0, 1);
    const double expected = (2.1 * 2.1 - 1.8 * 1.8) * 1.8 / 8;
    EXPECT_NEAR(force[0], -expected, 1e-15);
    EXPECT_NEAR(force[1], expected, 1e-15);
    EXPECT_EQ(force[2], 0);
    EXPECT_EQ(count[0], 1);
    EXPECT_EQ(count[2], 0);
  }
}

}  // namespace solidem::soft_sphere_lists_test
