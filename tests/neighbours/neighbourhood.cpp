// SPDX-License-Identifier: GPL-2.0-or-later
//
// Lists of neighbours against all pairs of elements and images.
#include "neighbours/neighbourhood.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>
#include <set>
#include <tuple>

namespace solidem::neighbourhood_test {

struct Cloud {
  Domain domain;
  std::vector<Vector> position;
  std::vector<double> radius;
};

/// Spheres thrown into a box whose corner is not the origin; radii between the two, as many small
/// as large.
Cloud cloud(int elements, const Vector& size, std::array<bool, 3> periodic, double smallest,
            double largest) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  Cloud result;
  result.domain.lower = {-1, 2, 0.5};
  result.domain.upper = result.domain.lower + size;
  result.domain.periodic = periodic;
  for (int i = 0; i < elements; ++i) {
    result.position.push_back(result.domain.lower + Vector{uniform(random) * size.x,
                                                           uniform(random) * size.y,
                                                           uniform(random) * size.z});
    result.radius.push_back(smallest * std::pow(largest / smallest, uniform(random)));
  }
  return result;
}

/// Element, neighbour, periods along x, y, z.
using Entry = std::tuple<std::size_t, std::int32_t, int, int, int>;

std::set<Entry> all_neighbours(const Cloud& c, double factor, double margin,
                               const std::vector<char>& absent = {}) {
  const double largest = *std::max_element(c.radius.begin(), c.radius.end());
  const Vector extent = c.domain.upper - c.domain.lower;
  std::set<Entry> found;
  for (std::size_t i = 0; i < c.position.size(); ++i)
    for (std::size_t j = 0; j < c.position.size(); ++j) {
      if (i == j || (!absent.empty() && (absent[i] != 0 || absent[j] != 0))) continue;
      const Vector chord = c.position[j] - c.position[i];
      const double limit = factor * (c.radius[i] + c.radius[j]) + margin;
      int low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
      bool near = true;
      for (int axis = 0; axis < 3; ++axis) {
        const double length = component(extent, axis), d = component(chord, axis);
        if (c.domain.periodic[static_cast<std::size_t>(axis)]) {
          low[axis] = static_cast<int>(std::floor((-limit - d) / length));
          high[axis] = static_cast<int>(std::ceil((limit - d) / length));
        } else if (std::fabs(d) > 2.1 * factor * largest + margin) {
          near = false;
        }
      }
      if (!near) continue;
      for (int x = low[0]; x <= high[0]; ++x)
        for (int y = low[1]; y <= high[1]; ++y)
          for (int z = low[2]; z <= high[2]; ++z)
            if (norm(chord + Vector{x * extent.x, y * extent.y, z * extent.z}) <= limit)
              found.insert({i, static_cast<std::int32_t>(j), x, y, z});
    }
  return found;
}

std::set<Entry> listed(const Cloud& c, const Neighbourhood& lists) {
  std::set<Entry> found;
  EXPECT_EQ(lists.first.size(), c.position.size() + 1);
  EXPECT_EQ(lists.image.size(), c.domain.is_periodic() ? lists.neighbour.size() : 0);
  for (std::size_t i = 0; i < c.position.size(); ++i)
    for (std::size_t k = lists.first[i]; k < lists.first[i + 1]; ++k) {
      const Image image = lists.image.empty() ? Image{} : lists.image[k];
      const Entry entry{i, lists.neighbour[k], image.periods(0), image.periods(1),
                        image.periods(2)};
      // In order, and each once.
      EXPECT_TRUE(k == lists.first[i] || *found.rbegin() < entry);
      found.insert(entry);
    }
  return found;
}

std::size_t expect_all(const Cloud& c, double factor, double margin,
                       const std::vector<char>& absent = {}) {
  const std::set<Entry> expected = all_neighbours(c, factor, margin, absent);
  const std::set<Entry> found =
      listed(c, find_neighbours(c.domain, c.position, c.radius, factor, margin, absent));
  EXPECT_EQ(found.size(), expected.size());
  EXPECT_TRUE(found == expected);
  return expected.size();
}

constexpr std::array<bool, 3> open = {false, false, false};
const std::array<bool, 3> periods[] = {open,
                                       {true, false, false},
                                       {false, true, false},
                                       {false, false, true},
                                       {true, false, true},
                                       {true, true, true}};

TEST(Neighbourhood, is_what_all_pairs_say) {
  for (const auto& periodic : periods)
    EXPECT_GT(expect_all(cloud(600, {1, 1.3, 0.8}, periodic, 0.03, 0.04), 1.2, 0.01), 1000u);
}

TEST(Neighbourhood, is_what_all_pairs_say_of_radii_one_to_twenty) {
  for (const auto& periodic : periods)
    EXPECT_GT(expect_all(cloud(500, {1, 1.3, 0.8}, periodic, 0.005, 0.1), 1.5, 0.004), 1000u);
}

TEST(Neighbourhood, counts_every_image_where_a_period_is_shorter_than_the_range) {
  // Half, a fifth and a twentieth of the range.
  for (const double length : {0.5, 0.2, 0.05}) {
    Cloud c = cloud(20, {length, 1.1, length}, {true, false, true}, 0.3, 0.35);
    EXPECT_GT(expect_all(c, 1.5, 0.01), 20u * 19u);
    c.domain.periodic = {true, true, true};
    EXPECT_GT(expect_all(c, 1.5, 0.01), 20u * 19u);
  }
}

TEST(Neighbourhood, finds_elements_that_have_left_the_box) {
  std::mt19937_64 random(23);
  std::uniform_int_distribution<int> whole(-9, 9);
  for (const auto& periodic : periods) {
    Cloud c = cloud(400, {1, 1.3, 0.8}, periodic, 0.03, 0.06);
    const std::size_t before = all_neighbours(c, 1.2, 0).size();
    for (Vector& place : c.position)
      for (int axis = 0; axis < 3; ++axis)
        if (periodic[static_cast<std::size_t>(axis)])
          component(place, axis) +=
              whole(random) * component(c.domain.upper - c.domain.lower, axis);
    // As many as before: whole periods change which image is meant, not who is near.
    EXPECT_EQ(expect_all(c, 1.2, 1e-9), before);
    for (std::size_t i = 0; i < c.position.size(); i += 7) c.position[i] += Vector{4.3, -2.2, 7.7};
    expect_all(c, 1.2, 0.01);
  }
}

TEST(Neighbourhood, of_faces_that_meet_exactly) {
  // Elements that stand on a face of the box or a round-off beside it are neighbours but once.
  Cloud c;
  c.domain.lower = {0, 0, 0};
  c.domain.upper = {1, 1, 1};
  c.domain.periodic = {true, true, true};
  for (const double x : {0.0, 1.0, -1e-17, std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0)})
    c.position.push_back({x, 0.5, 1.0});
  c.radius.assign(c.position.size(), 0.05);
  EXPECT_EQ(expect_all(c, 1.2, 0.01), 20u);
}

TEST(Neighbourhood, leaves_out_those_that_are_absent) {
  const Cloud c = cloud(500, {1, 1, 1}, {true, false, false}, 0.03, 0.05);
  std::vector<char> absent(c.position.size(), 0);
  for (std::size_t i = 0; i < absent.size(); i += 3) absent[i] = 1;
  EXPECT_LT(expect_all(c, 1.2, 0.01, absent), all_neighbours(c, 1.2, 0.01).size());
  absent.assign(absent.size(), 1);
  EXPECT_EQ(expect_all(c, 1.2, 0.01, absent), 0u);
}

TEST(Neighbourhood, finds_a_few_that_have_flown_far_away) {
  for (const double far : {10.0, 1e3, 1e9}) {
    Cloud c = cloud(900, {1, 1, 1}, open, 0.03, 0.04);
    for (std::size_t i = 0; i < 4; ++i)
      c.position[i * 200] += Vector{(i % 2 == 0 ? far : -far), 0.5 * far, 0};
    // Two that flew side by side.
    c.position[1] = c.position[0] + Vector{0.05, 0, 0};
    EXPECT_GT(expect_all(c, 1.2, 0.01), 1000u);
  }
}

TEST(Neighbourhood, finds_both_halves_of_a_body_that_stand_far_apart) {
  for (const double far : {10.0, 1e3, 1e9}) {
    Cloud c = cloud(900, {1, 1, 1}, open, 0.03, 0.04);
    for (std::size_t i = 0; i < c.position.size(); ++i)
      if (c.position[i].x > -0.5) c.position[i] += Vector{far, far, -far};
    EXPECT_GT(expect_all(c, 1.2, 0.01), 1000u);
  }
}

TEST(Neighbourhood, of_one_and_of_none) {
  Cloud c = cloud(1, {1, 1, 1}, {true, true, true}, 0.3, 0.4);
  // An element is no neighbour of its own images.
  EXPECT_EQ(expect_all(c, 3, 0), 0u);
  c = cloud(0, {1, 1, 1}, {true, true, true}, 0.3, 0.4);
  const Neighbourhood lists = find_neighbours(c.domain, c.position, c.radius, 1, 0);
  EXPECT_EQ(lists.first, std::vector<std::uint32_t>{0});
}

TEST(Neighbourhood, is_the_same_on_any_number_of_threads) {
  const int before = omp_get_max_threads();
  const Cloud c = cloud(8000, {1, 1, 1}, {true, true, false}, 0.01, 0.03);
  std::vector<Neighbourhood> lists;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    lists.push_back(find_neighbours(c.domain, c.position, c.radius, 1.2, 0.002));
  }
  omp_set_num_threads(before);
  for (const Neighbourhood& other : lists) {
    EXPECT_TRUE(other.first == lists[0].first);
    EXPECT_TRUE(other.neighbour == lists[0].neighbour);
    EXPECT_TRUE(other.image == lists[0].image);
  }
}

TEST(Image, keeps_its_periods) {
  for (const int x : {-127, -1, 0, 127})
    for (const int z : {-127, 0, 3, 127}) {
      const Image image(x, -z, z);
      EXPECT_EQ(image.periods(0), x);
      EXPECT_EQ(image.periods(1), -z);
      EXPECT_EQ(image.periods(2), z);
    }
}

}  // namespace solidem::neighbourhood_test
