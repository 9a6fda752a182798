// SPDX-License-Identifier: GPL-2.0-or-later
//
// What holds for every body at rest.
#include <gtest/gtest.h>

#include <omp.h>
#include <Eigen/Dense>

#include "effects/grip_parameters.hpp"
#include "solve/bonded_bodies.hpp"

namespace solidem::static_bodies_test {

Equilibrium solve(const Specimen& specimen, const std::vector<Constraint>& constraints,
                  const std::vector<ElementLoad>& loads = {},
                  LinearMethod method = LinearMethod::automatic) {
  EquilibriumOptions options;
  options.method = method;
  return small_equilibrium(beam_network(beam_parameters(), specimen), constraints, loads, options);
}

std::vector<Constraint> clamped_below(const Specimen& specimen) {
  std::vector<Constraint> constraints;
  for (const std::int32_t e : select(face(0, false), specimen))
    for (int degree = 0; degree < 6; ++degree) constraints.push_back({e, degree, 0.0});
  return constraints;
}

TEST(StaticBody, ReactionsBalanceLoads) {
  const Specimen body = jittered("bcc", {4, 3, 3});
  std::vector<Constraint> constraints = stretched(body, 1e-7);
  const std::int32_t loaded = static_cast<std::int32_t>(body.size() / 2);
  const std::vector<ElementLoad> loads = {{loaded, {1e-2, 2e-2, -1e-2}, {1e-7, -2e-7, 3e-7}}};
  const Equilibrium e = solve(body, constraints, loads);
  Vector force{}, moment{};
  double largest = 0;
  const auto act = [&](std::int32_t element, const Vector& f, const Vector& m) {
    force += f;
    moment += m + cross(at(body.position, element), f);
    largest = std::max(largest, norm(f));
  };
  for (std::size_t i = 0; i < body.size(); ++i)
    act(static_cast<std::int32_t>(i), e.reaction[i], e.reaction_moment[i]);
  act(loaded, loads[0].force, loads[0].moment);
  EXPECT_LT(norm(force), 1e-8 * largest);
  EXPECT_LT(norm(moment), 1e-8 * largest * body.domain.upper.x);
}

TEST(StaticBody, WorkIsReciprocalAndPositive) {
  // Betti: what the loads of one state do on the way of another is the same the other way round.
  const Specimen body = jittered("simple_cubic", {5, 3, 3});
  const auto held = clamped_below(body);
  const std::int32_t a = static_cast<std::int32_t>(body.size() / 2);
  const std::int32_t b = select(face(0, true), body).front();
  const ElementLoad first{a, {1e-2, -3e-2, 2e-2}, {1e-7, 2e-7, -1e-7}};
  const ElementLoad second{b, {-2e-2, 1e-2, 1e-2}, {-3e-7, 1e-7, 2e-7}};
  const auto work = [&](const ElementLoad& load, const Equilibrium& e) {
    return dot(load.force, at(e.displacement, load.element)) +
           dot(load.moment, at(e.rotation, load.element));
  };
  const Equilibrium one = solve(body, held, {first}), two = solve(body, held, {second});
  EXPECT_GT(work(first, one), 0);
  EXPECT_GT(work(second, two), 0);
  EXPECT_NEAR(work(first, two), work(second, one), 1e-8 * work(first, one));
  EXPECT_NEAR(one.energy, 0.5 * work(first, one), 1e-8 * one.energy);
}

TEST(StaticBody, EnergyIsHalfTheWorkOfTheGrips) {
  const Specimen body = jittered("fcc", {3, 2, 2});
  const auto constraints = stretched(body, 2e-7);
  const Equilibrium e = solve(body, constraints);
  double work = 0;
  for (const Constraint& c : constraints)
    if (c.degree < 3) work += c.value * component(at(e.reaction, c.element), c.degree);
  EXPECT_GT(e.energy, 0);
  EXPECT_NEAR(e.energy / (0.5 * work), 1, 1e-8);
}

TEST(StaticBody, RigidMotionStrainsNothing) {
  const Specimen body = jittered("bcc", {4, 3, 3});
  const Vector shift{1e-6, -2e-6, 3e-6}, turn{1e-3, 2e-3, -1e-3};
  std::vector<Constraint> moved = stretched(body, 0);
  for (Constraint& c : moved)
    c.value = c.degree < 3 ? component(shift + cross(turn, at(body.position, c.element)), c.degree)
                           : component(turn, c.degree - 3);
  const Equilibrium rigid = solve(body, moved);
  const Equilibrium strained = solve(body, stretched(body, 1e-6));
  EXPECT_LT(rigid.energy, 1e-16 * strained.energy);
  for (std::size_t i = 0; i < body.size(); ++i)
    EXPECT_LT(norm(rigid.displacement[i] - shift - cross(turn, body.position[i])), 1e-13);
}

TEST(StaticBody, BothWaysOfSolvingAgree) {
  const Specimen body = jittered("bcc", {5, 3, 3});
  const auto constraints = stretched(body, 1e-7);
  const Equilibrium a = solve(body, constraints, {}, LinearMethod::factorised);
  const Equilibrium b = solve(body, constraints, {}, LinearMethod::iterated);
  EXPECT_EQ(a.iterations, 1);
  EXPECT_GT(b.iterations, 10);
  EXPECT_LT(a.residual, 1e-12);
  EXPECT_LT(b.residual, 1e-10);
  for (std::size_t i = 0; i < body.size(); ++i)
    EXPECT_LT(norm(a.displacement[i] - b.displacement[i]), 1e-8 * 1e-7);
}

TEST(StaticBody, ElementsOutsideTheBodyStayWhereTheyAre) {
  Specimen body = jittered("simple_cubic", {5, 3, 3});
  const Equilibrium before = solve(body, stretched(body, 1e-7));
  const std::size_t count = body.size();
  for (const double x : {2e-4, 3.9e-4}) {  // two elements bonded to each other, and one alone
    body.position.push_back({x, 5e-3, 0});
    body.radius.push_back(1e-4);
  }
  body.position.push_back({0, -5e-3, 0});
  body.radius.push_back(1e-4);
  const auto first = static_cast<std::int32_t>(count);
  body.bonds.push_back({first, first + 1});
  const Equilibrium after = solve(body, [&] {
    Specimen without = body;
    without.position.resize(count);
    without.radius.resize(count);
    return stretched(without, 1e-7);
  }());
  // The mean radius, and so the beams', is the same to the jitter of the radii.
  for (std::size_t i = count; i < body.size(); ++i) EXPECT_EQ(norm(after.displacement[i]), 0);
  EXPECT_NEAR(after.energy / before.energy, 1, 0.05);
  EXPECT_LT(after.residual, 1e-9);
}

TEST(StaticBody, ThreadsChangeNothing) {
  const Specimen body = jittered("bcc", {16, 8, 8});
  const auto constraints = stretched(body, 1e-7);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Equilibrium one = solve(body, constraints, {}, LinearMethod::iterated);
  omp_set_num_threads(3);
  const Equilibrium three = solve(body, constraints, {}, LinearMethod::iterated);
  omp_set_num_threads(threads);
  EXPECT_EQ(one.iterations, three.iterations);
  for (std::size_t i = 0; i < body.size(); ++i) {
    EXPECT_EQ(one.displacement[i].x, three.displacement[i].x);
    EXPECT_EQ(one.rotation[i].z, three.rotation[i].z);
  }
}

TEST(StaticBody, CubicLatticeHasTheModulusOfItsBeams) {
  // A periodic simple cubic lattice: beams along x share the pull, those across do not feel it.
  const Specimen cell = crystal("simple_cubic", {4, 4, 4}, {true, true, true});
  const BeamNetwork network = beam_network(beam_parameters(), cell);
  EquilibriumOptions options;
  options.periodic_gradient[0].x = 1e-4;
  const Equilibrium e =
      small_equilibrium(network, {{0, 0, 0.0}, {0, 1, 0.0}, {0, 2, 0.0}}, {}, options);
  const Matrix3 stress = mean_stress(network, e);
  const double modulus = 3.5e12 * pi * 0.27 * 0.27 / 4;
  EXPECT_NEAR(stress[0].x / (modulus * 1e-4), 1, 1e-9);
  for (const double other : {stress[0].y, stress[0].z, stress[1].y, stress[2].z, stress[1].x})
    EXPECT_LT(std::abs(other), 1e-9 * stress[0].x);
}

TEST(StaticBody, PeriodicShearIsSymmetric) {
  const Specimen cell = crystal("fcc", {3, 3, 3}, {true, true, true});
  const BeamNetwork network = beam_network(beam_parameters(), cell);
  EquilibriumOptions options;
  options.periodic_gradient[0].y = 1e-4;  // not a strain alone, but a turn as well
  const Equilibrium e =
      small_equilibrium(network, {{0, 0, 0.0}, {0, 1, 0.0}, {0, 2, 0.0}}, {}, options);
  const Matrix3 stress = mean_stress(network, e);
  EXPECT_GT(stress[0].y, 0);
  EXPECT_NEAR(stress[0].y / stress[1].x, 1, 1e-8);
}

TEST(StaticBody, RandomPackingsAreAsStiffAsKnown) {
  // Periodic cells of random packings at a radius ratio of 0.27: E / E_beam 0.019, Poisson ratio
  // 0.33 (measured independently, with scatter of a few per cent between cells of 1000).
  double modulus = 0, ratio = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SpecimenRecipe recipe;
    recipe.shape = "box";
    recipe.size = {1e-3, 1e-3, 1e-3};
    recipe.elements = 1000;
    recipe.seed = seed;
    recipe.periodic = {true, true, true};
    const Specimen cell = make_specimen(recipe);
    const BeamNetwork network = beam_network(beam_parameters(), cell);
    const std::int32_t pinned = network.bonds.front().i;
    Eigen::Matrix3d stiffness;  // between the normal strains, one column for each
    for (int axis = 0; axis < 3; ++axis) {
      EquilibriumOptions options;
      component(options.periodic_gradient[static_cast<std::size_t>(axis)], axis) = 1e-6;
      const Equilibrium e = small_equilibrium(
          network, {{pinned, 0, 0.0}, {pinned, 1, 0.0}, {pinned, 2, 0.0}}, {}, options);
      const Matrix3 stress = mean_stress(network, e);
      stiffness.col(axis) << stress[0].x, stress[1].y, stress[2].z;
    }
    const Eigen::Matrix3d compliance = (stiffness / (1e-6 * 3.5e12)).inverse();
    const double young = 3 / compliance.trace();
    modulus += young / 3;
    ratio -= young * (compliance.sum() - compliance.trace()) / 6 / 3;
  }
  EXPECT_NEAR(modulus / 0.0190, 1, 0.05);
  EXPECT_NEAR(ratio, 0.3305, 0.01);
}

TEST(StaticBody, SlowRunSettlesOnTheEquilibrium) {
  const Specimen body = jittered("bcc", {6, 3, 3});
  auto setup = elastic_setup();
  const double displacement = 1e-7, ramp = 6e-5;
  GripParameters left, right;
  left.name = "left";
  left.region = face(0, false);
  right.name = "right";
  right.region = face(0, true);
  for (GripParameters* grip : {&left, &right})
    for (AxisControl& axis : grip->axis)
      axis = {AxisControl::Kind::displacement, TimeFunction::constant(0)};
  right.axis[0].function = {{0, ramp}, {0, displacement}};
  setup.all<GripParameters>() = {left, right};
  setup.run.duration = 2 * ramp;
  setup.run.steps.reset();
  Simulation simulation(setup, body);
  const std::int64_t half = simulation.steps_to_run() / 2;
  simulation.advance(half);
  double sum = 0, low = 1e300, high = -1e300;
  int count = 0;
  for (std::int64_t step = half; step + 5 <= 2 * half; step += 5, ++count) {
    simulation.advance(5);
    const double force = value_of(simulation.observe(), "grip.right.force_x");
    sum += force;
    low = std::min(low, force);
    high = std::max(high, force);
  }
  const Equilibrium e = solve(body, stretched(body, displacement));
  double force = 0;
  for (const std::int32_t i : select(face(0, true), body)) force += at(e.reaction, i).x;
  EXPECT_LT((high - low) / force, 0.05);  // it still swings a little about rest
  EXPECT_NEAR(sum / count / force, 1, 0.1 * (high - low) / force);
}

}  // namespace solidem::static_bodies_test
