// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every instruction set's kernels of contacts and of loose elements against the laws in plain
// doubles.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "effects/kernels/kernels.hpp"
#include "laws/linear_contact.hpp"
#include "laws/rigid_sphere.hpp"
#include "model/buffer.hpp"
#include "model/lane_vectors.hpp"
#include "model/slots.hpp"

namespace solidem::contact_kernels_test {

constexpr std::size_t elements = 203, pairs = 1101;  // neither is a multiple of a pack or a block
constexpr double tolerance = 1e-12;
constexpr double stiffness = 1e6, tangential_ratio = 0.6, friction = 0.3, time_step = 1e-4;
constexpr double heat_of_friction = 0.7, heat_of_damping = 0.2;

Vector vector_at(const double* x) {
  return {x[0], x[1], x[2]};
}

/// Columns of pairs of spheres of 1 m at random, of which about half touch, and some did.
struct Pairs {
  Buffer<double> pose{8 * elements}, motion{8 * elements};
  std::vector<std::int32_t> i, j;
  std::vector<double> distance, stiff, damping, shift[3], heat;
  Buffer<double> history{8 * pairs}, load{8 * pairs};
  std::vector<char> acts;
  std::vector<std::uint32_t> picked;
  std::vector<std::size_t> picks;
  std::vector<ContactSums> sums;

  explicit Pairs(bool periodic) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (double& x : pose) x = 1.2 * uniform(random);
    for (double& x : motion) x = uniform(random);
    for (std::size_t e = 0; e < elements; ++e) {
      motion[8 * e + 3] = 0.5 + 0.2 * uniform(random);  // 1/m
      motion[8 * e + 7] = 1 + 0.1 * uniform(random);    // R
    }
    for (auto* column : {&distance, &stiff, &damping, &heat}) column->resize(pairs + lanes);
    for (auto* column : {&i, &j}) column->resize(pairs + lanes);
    acts.resize(pairs + lanes);
    if (periodic)
      for (auto& column : shift) column.resize(pairs + lanes);
    for (std::size_t k = 0; k < pairs; ++k) {
      i[k] = static_cast<std::int32_t>(random() % (elements - 1));
      j[k] = i[k] + 1 +
             static_cast<std::int32_t>(random() % (elements - 1 - static_cast<std::size_t>(i[k])));
      distance[k] = 1.7 + 0.2 * uniform(random);
      stiff[k] = stiffness * (1 + 0.1 * uniform(random));
      damping[k] = 10 * (1 + uniform(random));
      if (periodic)
        for (auto& column : shift) column[k] = 0.3 * std::round(2 * uniform(random));
      remember(k, random, uniform);
    }
    picked.resize(pairs);
    const std::size_t blocks = pairs / ContactColumns::pairs_a_block + 1;
    picks.resize(blocks);
    sums.resize(blocks);
  }

  /// Some have touched before: a spring across a normal near to the one of now.
  template <class Random, class Uniform>
  void remember(std::size_t k, Random& random, Uniform& uniform) {
    if (random() % 3 == 0) return;
    const Vector towards = chord(k) + 0.05 * Vector{uniform(random), uniform(random), 0};
    const Vector n = (1 / norm(towards)) * towards;
    const Vector across = 1e-4 * cross(n, {uniform(random), uniform(random), uniform(random)});
    const double row[] = {n.x, n.y, n.z, across.x, across.y, across.z, 3 * uniform(random), 0};
    std::copy_n(row, 8, history.data() + 8 * k);
    acts[k] = 1;
  }

  Vector chord(std::size_t k) const {
    const Vector apart = vector_at(pose.data() + 8 * j[k]) - vector_at(pose.data() + 8 * i[k]);
    return shift[0].empty() ? apart : apart + Vector{shift[0][k], shift[1][k], shift[2][k]};
  }

  ContactColumns columns() {
    const auto of = [](const std::vector<double>& column) {
      return column.empty() ? nullptr : column.data();
    };
    return {pairs,          i.data(),         j.data(),     distance.data(),  stiff.data(),
            damping.data(), of(shift[0]),     of(shift[1]), of(shift[2]),     pose.data(),
            motion.data(),  tangential_ratio, friction,     time_step,        history.data(),
            load.data(),    acts.data(),      heat.data(),  heat_of_friction, heat_of_damping,
            picked.data(),  picks.data(),     sums.data()};
  }
};

/// What the law says of a pair, and where its force acts.
struct Expected {
  bool is_looked_at, touches;
  ContactResponse<double> response;
  Vector normal;
  double arm_i, arm_j;
};

Expected expected(const Pairs& p, std::size_t k) {
  const Vector to = p.chord(k);
  const double length = norm(to);
  const double *a = p.motion.data() + 8 * p.i[k], *b = p.motion.data() + 8 * p.j[k];
  Expected e{};
  e.touches = length < p.distance[k];
  e.is_looked_at = e.touches || p.acts[k] != 0;
  e.normal = (1 / length) * to;
  e.arm_i = 0.5 * (length + a[7] - b[7]);
  e.arm_j = 0.5 * (length + b[7] - a[7]);
  const Vector v_i = vector_at(a) + e.arm_i * cross(vector_at(a + 4), e.normal);
  const Vector v_j = vector_at(b) - e.arm_j * cross(vector_at(b + 4), e.normal);
  const double* past = p.history.data() + 8 * k;
  e.response = linear_contact<double>(
      {p.stiff[k], tangential_ratio * p.stiff[k], friction, p.damping[k], a[3] + b[3]},
      {e.normal, p.distance[k] - length, v_j - v_i,
       0.5 * dot(vector_at(a + 4) + vector_at(b + 4), e.normal), time_step},
      {vector_at(past), vector_at(past + 3), past[6]});
  return e;
}

void expect_near(const Vector& found, const Vector& expected, double scale) {
  EXPECT_LE(norm(found - expected), tolerance * scale);
}

class ContactKernels : public testing::TestWithParam<bool> {};

TEST_P(ContactKernels, say_what_the_law_says) {
  for (const Kernels* kernels : usable_kernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    const Pairs before(GetParam());
    Pairs p(GetParam());
    const ContactColumns columns = p.columns();
    kernels->pick_contacts(columns, 0, p.picks.size());
    kernels->find_contact_loads(columns, 0, p.picks.size());
    ContactSums sums;
    double friction_work = 0, damping_work = 0;
    std::size_t acting = 0, looked_at = 0;
    for (const ContactSums& part : p.sums) {
      sums.friction += part.friction;
      sums.damped += part.damped;
      sums.acting += part.acting;
    }
    for (std::size_t k = 0; k < pairs; ++k) {
      const Expected e = expected(before, k);
      const double *load = p.load.data() + 8 * k, *history = p.history.data() + 8 * k;
      EXPECT_EQ(p.acts[k] != 0, e.touches) << k;
      if (!e.is_looked_at) {
        EXPECT_EQ(norm(vector_at(load)), 0);
        continue;
      }
      ++looked_at;
      acting += e.touches ? 1 : 0;
      const double force = stiffness * p.distance[k];  // forces are differences of such
      expect_near(vector_at(load), e.response.force, force);
      expect_near(vector_at(load + 4), cross(e.normal, e.response.force), force);
      EXPECT_NEAR(load[3], e.arm_i, tolerance);
      EXPECT_NEAR(load[7], e.arm_j, tolerance);
      expect_near(vector_at(history), e.normal, 1);
      expect_near(vector_at(history + 3), e.response.history.spring, 1);
      EXPECT_NEAR(history[6], e.response.history.dashpot, tolerance * force);
      EXPECT_NEAR(
          p.heat[k],
          heat_of_friction * e.response.friction_work + heat_of_damping * e.response.damping_work,
          tolerance * force * time_step);
      friction_work += e.response.friction_work;
      damping_work += e.response.damping_work;
    }
    EXPECT_GT(looked_at, acting);  // some have just parted
    EXPECT_GT(acting, pairs / 4);
    EXPECT_EQ(sums.acting, acting);
    EXPECT_NEAR(sums.friction, friction_work, 1e-10 * friction_work);
    EXPECT_NEAR(sums.damped, damping_work, 1e-10 * std::fabs(damping_work));
  }
}

TEST_P(ContactKernels, add_up_to_no_force_and_no_moment) {
  for (const Kernels* kernels : usable_kernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    Pairs p(GetParam());
    const ContactColumns columns = p.columns();
    kernels->pick_contacts(columns, 0, p.picks.size());
    kernels->find_contact_loads(columns, 0, p.picks.size());
    std::vector<std::int32_t> all(elements);
    std::vector<std::uint32_t> first{0};
    std::vector<ContactSide> sides;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(elements); ++e) {
      all[static_cast<std::size_t>(e)] = e;
      for (std::uint32_t k = 0; k < pairs; ++k)
        if (p.i[k] == e || p.j[k] == e) sides.push_back({k, p.i[k] == e});
      first.push_back(static_cast<std::uint32_t>(sides.size()));
    }
    std::vector<std::int32_t> pushed(elements);
    std::vector<double> rows(8 * elements);
    const std::size_t count = kernels->sum_contact_loads(
        {all.data(), first.data(), sides.data(), p.load.data(), p.acts.data()}, 0, elements,
        pushed.data(), rows.data());
    ASSERT_GT(count, elements / 2);
    Vector force{}, moment{}, shifted{};
    double largest = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const Vector f = vector_at(rows.data() + 8 * n);
      force += f;
      moment +=
          vector_at(rows.data() + 8 * n + 4) + cross(vector_at(p.pose.data() + 8 * pushed[n]), f);
      largest = std::max(largest, norm(f));
    }
    // An image pulls where it is, not where its element is.
    for (std::size_t k = 0; k < pairs; ++k)
      if (p.acts[k] != 0 && GetParam())
        shifted -=
            cross({p.shift[0][k], p.shift[1][k], p.shift[2][k]}, vector_at(p.load.data() + 8 * k));
    EXPECT_LE(norm(force), 1e-12 * largest * elements);
    EXPECT_LE(norm(moment + shifted), 1e-12 * largest * elements);
  }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, ContactKernels, testing::Values(false, true),
                         [](const auto& periodic) { return periodic.param ? "periodic" : "free"; });

/// Loose elements in columns of lanes.
struct Loose {
  static constexpr std::size_t padded = (elements + lanes - 1) / lanes * lanes;
  Buffer<double> pose{8 * padded}, next{8 * padded}, velocity{3 * padded}, spin{3 * padded},
      inverse_mass{padded}, inverse_inertia{padded};

  Loose() {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (Buffer<double>* column : {&velocity, &spin, &inverse_mass, &inverse_inertia})
      for (double& x : *column) x = uniform(random);
    for (std::size_t e = 0; e < padded; ++e) {
      for (std::size_t axis = 0; axis < 3; ++axis) pose[8 * e + axis] = uniform(random);
      const Quaternion<double> q =
          turn(Quaternion<double>{}, {uniform(random), uniform(random), uniform(random)}, 1.0);
      set_orientation(pose.data() + 8 * e, q);
    }
  }
  static void set_orientation(double* row, const Quaternion<double>& q) {
    row[4] = q.w;
    row[5] = q.v.x;
    row[6] = q.v.y;
    row[7] = q.v.z;
  }
  static std::size_t at(std::size_t e) { return 3 * lanes * (e / lanes) + e % lanes; }

  /// Where an element of these velocities gets to.
  void expect_moved(std::size_t e, const Vector& v, const Vector& w, double step) const {
    const double *from = pose.data() + 8 * e, *to = next.data() + 8 * e;
    expect_near(vector_at(to), vector_at(from) + step * v, 10);
    const Quaternion<double> q = turn(Quaternion<double>{from[4], vector_at(from + 5)}, w, step);
    EXPECT_NEAR(to[4], q.w, tolerance);
    expect_near(vector_at(to + 5), q.v, 1);
  }
};

TEST(LooseKernels, lay_out_what_contacts_read_of_whole_blocks_and_of_parts) {
  // Two whole blocks, parts of two, and the last one, which is none.
  std::vector<std::int32_t> some{3, 7, 8, 9, 10, 11, 12, 13, 14, 15, 20};
  for (std::int32_t e = 64; e < 72; ++e) some.push_back(e);
  for (std::int32_t e = 200; e < static_cast<std::int32_t>(elements); ++e) some.push_back(e);
  const Loose from;
  std::vector<double> radius(elements);
  for (std::size_t e = 0; e < elements; ++e) radius[e] = 1 + std::sin(static_cast<double>(e));
  for (const Kernels* kernels : usable_kernels())
    for (const double* spin : {from.spin.data(), static_cast<const double*>(nullptr)}) {
      SCOPED_TRACE(kernels->instruction_set);
      Buffer<double> rows(8 * elements);
      kernels->lay_out_motion(
          {from.velocity.data(), spin, from.inverse_mass.data(), radius.data(), rows.data()},
          some.data(), some.size());
      std::size_t next = 0;
      for (std::size_t e = 0; e < elements; ++e) {
        const bool is_one = next < some.size() && some[next] == static_cast<std::int32_t>(e);
        next += is_one ? 1 : 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(rows[8 * e + axis], is_one ? from.velocity[Loose::at(e) + axis * lanes] : 0);
          EXPECT_EQ(rows[8 * e + 4 + axis],
                    is_one && spin != nullptr ? spin[Loose::at(e) + axis * lanes] : 0);
        }
        EXPECT_EQ(rows[8 * e + 3], is_one ? from.inverse_mass[e] : 0);
        EXPECT_EQ(rows[8 * e + 7], is_one ? radius[e] : 0);
      }
    }
}

TEST(LooseKernels, move_and_turn_elements_and_what_pushes_some_of_them_adds) {
  constexpr double step = 0.3, kick = 0.2;
  const std::vector<std::int32_t> some{0, 3, 4, 9, 17, 18, 40, 41, 42, 100, 202};
  for (const Kernels* kernels : usable_kernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    const Loose before;
    Loose now;
    kernels->move_freely(
        {now.pose.data(), now.next.data(), now.velocity.data(), now.spin.data(), step}, 0,
        Loose::padded / lanes);
    for (std::size_t e = 0; e < elements; ++e)
      now.expect_moved(e, lanes_vector(before.velocity.data(), Loose::at(e)),
                       lanes_vector(before.spin.data(), Loose::at(e)), step);
    Buffer<double> loads(8 * some.size());
    for (std::size_t n = 0; n < loads.size(); ++n) loads[n] = std::sin(static_cast<double>(n * n));
    kernels->push({some.data(), loads.data(), some.size(), now.pose.data(), now.next.data(),
                   now.velocity.data(), now.spin.data(), now.inverse_mass.data(),
                   now.inverse_inertia.data(), kick, step});
    std::vector<Vector> gain(elements), turned(elements);
    for (std::size_t n = 0; n < some.size(); ++n) {
      const auto e = static_cast<std::size_t>(some[n]);
      gain[e] = kick * before.inverse_mass[e] * vector_at(loads.data() + 8 * n);
      turned[e] = kick * before.inverse_inertia[e] * vector_at(loads.data() + 8 * n + 4);
    }
    for (std::size_t e = 0; e < elements; ++e) {
      const Vector v = lanes_vector(before.velocity.data(), Loose::at(e)) + gain[e],
                   w = lanes_vector(before.spin.data(), Loose::at(e)) + turned[e];
      expect_near(lanes_vector(now.velocity.data(), Loose::at(e)), v, 1);
      expect_near(lanes_vector(now.spin.data(), Loose::at(e)), w, 1);
      now.expect_moved(e, v, w, step);
    }
  }
}

}  // namespace solidem::contact_kernels_test
