// SPDX-License-Identifier: GPL-2.0-or-later
//
// What contacts and tools do to elements is in their stress: of what is pressed between platens,
// the mean over all is force over area.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/frame_fields.hpp"
#include "scene/scene_text.hpp"
#include "support/beams.hpp"
#include "support/specimens.hpp"

namespace solidem::test::stress_of_contacts_test {

constexpr double diameter = 2e-4;  // of the elements, m

/// A plane that moves along an axis, by its name such as "z_low", towards the body for 20 µs.
std::string plane(const std::string& name, double place, double velocity) {
  const int axis = name[0] - 'x';
  const auto triple = [&](const std::string& zero, const std::string& value) {
    std::string text = "[";
    for (int k = 0; k < 3; ++k) text += (k == axis ? value : zero) + (k < 2 ? ", " : "]");
    return text;
  };
  const std::string normal = velocity > 0 ? "1" : "-1", speed = std::to_string(velocity);
  return "[[tools]]\nname = \"" + name + "\"\nshape = \"plane\"\nstiffness = \"100 kN/m\"\n" +
         "restitution = 0.3\norigin = " +
         triple("\"0 m\"", "\"" + std::to_string(1e3 * place) + " mm\"") +
         "\nnormal = " + triple("0", normal) + "\nvelocity = " +
         triple("\"0 m/s\"", "{ time = [\"0 s\", \"19 us\", \"20 us\"], value = [\"" + speed +
                                 " m/s\", \"" + speed + " m/s\", \"0 m/s\"] }") +
         "\n";
}

Setup setup_with(const std::string& sections) {
  return read_text_scene(
             "[specimen]\nshape = \"crystal\"\nlattice = \"simple_cubic\"\ncells = [1, 1, 1]\n"
             "element_radius = \"0.1 mm\"\n[material]\ndensity = \"2790 kg/m^3\"\n"
             "[damping]\nlocal = 0.7\n" +
             sections + "[run]\nsteps = 1\ntime_step_ratio = 0.2\n")
      .setup;
}

/// Means of the stress over all elements, by the volumes that they stand for.
std::array<double, 6> mean_stress(const Simulation& simulation) {
  const std::vector<Pair> pairs = simulation.model().slots().pairs();
  Frame frame(pairs);
  for (const auto& effect : simulation.effects()) effect->show(simulation.model(), frame);
  const std::vector<double> stress = FrameFields(simulation, {"stress"}).of_now(frame).at(0).values;
  const Specimen& specimen = simulation.model().specimen();
  const std::vector<double> volume = represented_mass(specimen, {1.0});
  std::array<double, 6> mean{};
  for (std::size_t i = 0; i < volume.size(); ++i)
    for (std::size_t k = 0; k < 6; ++k)
      mean[k] += stress[6 * i + k] * volume[i] / specimen.domain.volume;
  return mean;
}

/// Force on a plane along its axis, over the section of the body at rest, times how far the planes
/// of that axis are apart now over how far they were.
double pressure(const Simulation& simulation, int axis) {
  const std::string name(1, "xyz"[axis]);
  const auto at_end = [&](const std::string& side, const std::string& what) {
    return seen(simulation, "tool." + name + side + "." + what + name);
  };
  const Domain& domain = simulation.model().specimen().domain;
  const double length = component(domain.upper - domain.lower, axis);
  const double now = length + at_end("_high", "displacement_") - at_end("_low", "displacement_");
  EXPECT_NEAR(at_end("_high", "force_") / at_end("_low", "force_"), -1, 1e-7);
  return at_end("_high", "force_") / domain.cross_section(axis) * now / length;
}

TEST(StressOfContacts, OfLooseGrainsBetweenPlatensIsForceOverArea) {
  std::string planes;
  const std::array<int, 3> cells{3, 3, 5};
  const double speed[] = {0.03, 0.02, 0.06};
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    planes += plane(name + "_low", 0, speed[axis]) +
              plane(name + "_high", cells[static_cast<std::size_t>(axis)] * diameter, -speed[axis]);
  }
  const auto setup = setup_with(
      "[contact]\nnormal_stiffness = \"100 kN/m\"\nfriction = 0.4\nrestitution = 0.3\n" + planes);
  Simulation simulation(setup, crystal("simple_cubic", cells));
  simulation.advance(6000);
  ASSERT_EQ(seen(simulation, "contacts"), 2 * 3 * 5 + 3 * 2 * 5 + 3 * 3 * 4);
  const std::array<double, 6> stress = mean_stress(simulation);
  for (int axis = 0; axis < 3; ++axis) {
    const double expected = pressure(simulation, axis);
    EXPECT_GT(expected, 1e4);
    EXPECT_NEAR(-stress[static_cast<std::size_t>(axis)] / expected, 1, 1e-6) << axis;
  }
}

TEST(StressOfContacts, GoesThroughABodyThatIsPartedAcrossAsIfItWereWhole) {
  Specimen body = crystal("simple_cubic", {3, 3, 8});
  make_bonds(body, 0);
  const double middle = 4 * diameter;
  const auto is_above = [&](std::int32_t element) {
    return body.position[static_cast<std::size_t>(element)].z > middle;
  };
  body.bonds.erase(
      std::remove_if(body.bonds.begin(), body.bonds.end(),
                     [&](const Pair& bond) { return is_above(bond.i) != is_above(bond.j); }),
      body.bonds.end());
  auto setup = setup_with(
      "[beams]\nyoung_modulus = \"1 GPa\"\npoisson_ratio = 0.3\nradius_ratio = 0.5\n"
      "[contact]\nfriction = 0.4\nrestitution = 0.3\n" +
      plane("z_low", 0, 0.06) + plane("z_high", 8 * diameter, -0.06));
  setup.gauge = Gauge{2, middle - 1.6 * diameter, middle + 1.6 * diameter};
  Simulation simulation(setup, body);
  simulation.advance(8000);
  EXPECT_EQ(seen(simulation, "contacts"), 9);
  const double expected = pressure(simulation, 2);
  EXPECT_GT(expected, 1e4);
  EXPECT_NEAR(-mean_stress(simulation)[2] / expected, 1, 1e-6);
  const double force = seen(simulation, "tool.z_high.force_z");
  EXPECT_NEAR(-seen(simulation, "gauge.stress") * body.domain.cross_section(2) / force, 1, 1e-6);
}

}  // namespace solidem::test::stress_of_contacts_test
