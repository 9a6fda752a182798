// SPDX-License-Identifier: GPL-2.0-or-later
//
// Tools that cannot be, and what is said of them.
#include <gtest/gtest.h>

#include "engine/simulation.hpp"
#include "scene/body.hpp"
#include "scene/scene_text.hpp"
#include "support/refusal.hpp"

namespace solidem::test::bad_tools_test {

const std::string body = R"toml([specimen]
shape = "crystal"
lattice = "bcc"
cells = [3, 3, 3]
element_radius = "0.1 mm"
[material]
density = "2700 kg/m^3"
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
[run]
steps = 1
)toml";

/// What a scene with such a tool is refused for, in reading or in building.
std::string refusal(const std::string& tool, const std::string& scene = body) {
  return test::refusal_of([&] {
    const Scene read = read_text_scene(scene + "[[tools]]\nname = \"one\"\n" + tool + "\n");
    const Simulation simulation(read.setup, make_body(read));
  });
}

void expect_refusal(const std::string& tool, const std::string& words,
                    const std::string& scene = body) {
  const std::string said = refusal(tool, scene);
  EXPECT_NE(said.find(words), std::string::npos) << tool << "\nis refused with: " << said;
}

const std::string apart = "origin = [\"0 mm\", \"0 mm\", \"-1 mm\"]\n";

TEST(BadTools, KeysThatAShapeHasNotOrLacksAreTold) {
  EXPECT_EQ(refusal("shape = \"plane\"\n" + apart), "");
  expect_refusal("shape = \"cone\"", "unknown; expected one of \"plane\", \"box\", \"sphere\"");
  expect_refusal("shape = \"box\"", "\"size\" is missing");
  expect_refusal("shape = \"sphere\"", "\"radius\" is missing");
  expect_refusal("shape = \"cylinder\"\nradius = \"1 mm\"", "\"length\" is missing");
  expect_refusal("shape = \"mesh\"", "\"file\" is missing");
  expect_refusal("shape = \"plane\"\nradius = \"1 mm\"", "radius");
  expect_refusal("shape = \"plane\"\nradius = \"1 mm\"", "belongs to another shape");
  expect_refusal("shape = \"plane\"\nnormal = [0, 0, 0]", "no direction");
}

TEST(BadTools, MotionsThatDoNotGoTogetherAreTold) {
  const std::string still = "shape = \"plane\"\n" + apart;
  expect_refusal(still + "force = \"1 N\"\nmass = \"1 g\"", "\"force_axis\" is missing");
  expect_refusal(still + "force = \"1 N\"\nforce_axis = [0, 0, 1]", "\"mass\" is missing");
  expect_refusal(still + "mass = \"1 g\"", "\"force\" is missing");
  expect_refusal(still + "angular_velocity = \"10 rpm\"", "\"rotation_axis\" is missing");
  expect_refusal(still + "angular_velocity = \"10 Hz\"\nrotation_axis = [0, 0, 1]",
                 "\"Hz\" counts no angle, where one is meant");
  expect_refusal(still +
                     "force = \"1 N\"\nforce_axis = [0, 0, 1]\nmass = \"1 g\"\nvelocity = [\"0 "
                     "m/s\", \"0 m/s\", \"1 m/s\"]",
                 "velocity");
  expect_refusal(still + "restitution = 1.2", "restitution");
  expect_refusal(still + "friction = -0.1", "friction");
}

TEST(BadTools, RevolutionsPerMinuteAreAnAngularVelocity) {
  EXPECT_EQ(refusal("shape = \"plane\"\n" + apart +
                    "angular_velocity = \"1000 rpm\"\nrotation_axis = [0, 0, 1]"),
            "");
}

TEST(BadTools, WhatAToolIsMadeOfIsToldAsAWholeAndBesideHeatOfFriction) {
  const std::string still = "shape = \"plane\"\n" + apart;
  expect_refusal(still + "conductivity = \"50 W/(m K)\"", "\"density\" is missing");
  expect_refusal(still +
                     "conductivity = \"50 W/(m K)\"\ndensity = \"7800 kg/m^3\"\n"
                     "specific_heat_capacity = \"490 J/(kg K)\"",
                 "expected a section [friction_heat]");
  expect_refusal(still + "temperature = \"300 K\"", "expected a section [contact_conduction]");
}

TEST(BadTools, AToolThatBeginsInsideOfTheBodyIsToldHowDeepAndWhere) {
  expect_refusal("shape = \"plane\"\norigin = [\"0 mm\", \"0 mm\", \"0.15 mm\"]",
                 "[[tools]] \"one\" begins inside of the body: ");
  expect_refusal("shape = \"sphere\"\nradius = \"1 mm\"", " m deep in element ");
}

TEST(BadTools, MeshesThatAreNoneAreToldByFileAndFacet) {
  expect_refusal("shape = \"mesh\"\nfile = \"none.stl\"\nunit = \"1 mm\"", "no such file");
  folder().write("bad.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\n");
  expect_refusal("shape = \"mesh\"\nfile = \"bad.obj\"\nunit = \"1 mm\"",
                 "bad.obj: facet 2 has no area");
  folder().write("large.obj", "v 0 0 -1\nv 1000 0 -1\nv 0 1000 -1\nf 1 2 3\n");
  expect_refusal("shape = \"mesh\"\nfile = \"large.obj\"\nunit = \"1 m\"", "expected another unit");
  expect_refusal("shape = \"mesh\"\nfile = \"large.obj\"\nunit = \"1 pm\"",
                 "expected another unit");
}

TEST(BadTools, APeriodicBodyHasNone) {
  expect_refusal("shape = \"plane\"\n" + apart, "periodic",
                 replaced(body, "[material]", "periodic = [true, true, false]\n[material]"));
}

}  // namespace solidem::test::bad_tools_test
