// SPDX-License-Identifier: GPL-2.0-or-later
//
// What bonds that break and are made do to the pairs that conduct heat.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "effects/conduction.hpp"
#include "effects/conduction_parameters.hpp"
#include "laws/platonic_conduction.hpp"
#include "support/specimens.hpp"

namespace solidem::changing_conductors_test {

using Law = ConductionParameters::Law;
using BrokenBonds = ConductionParameters::BrokenBonds;
using Conductances = std::map<Pair, double>;

constexpr double conductivity = 134;

/// A body whose bonds may change, and its conduction.
struct Body {
  ConductionGeometry geometry;
  std::unique_ptr<Model> model;
  std::unique_ptr<Conduction> conduction;

  Body(Law law, BrokenBonds choice, const Specimen& specimen,
       std::vector<Material> materials = {material_of(2790, 880, conductivity)},
       const std::vector<std::size_t>& of_element = {}, const std::vector<Contact>& contacts = {})
      : geometry(conduction_geometry(law, specimen)) {
    ConductionParameters parameters;
    parameters.law = law;
    parameters.initial_temperature = 300;
    parameters.contacts = contacts;
    model =
        std::make_unique<Model>(specimen, law == Law::voronoi ? geometry.faces : specimen.bonds);
    for (const Column* column : Conduction::columns(parameters, materials)) model->add(*column);
    conduction = std::make_unique<Conduction>(
        parameters, ThermalProperties{std::move(materials), of_element}, geometry, *model);
    conduction->watch_bonds(choice, geometry, *model);
  }

  Conductances conductances() const {
    Conductances all;
    const std::vector<double> temperature(model->elements(), 300.0);
    conduction->for_each_conductance(*model, temperature.data(),
                                     [&](std::int32_t i, std::int32_t j, double value) {
                                       all[{i, j}] = value;
                                     });
    return all;
  }
};

/// Twenty-four elements, some with few neighbours and free slots.
Specimen small_block() {
  return jittered("simple_cubic", {4, 3, 2});
}

/// Two elements that no bond joins though each could have one more.
Pair apart(const Model& model) {
  for (std::int32_t i = 0; i < 24; ++i)
    for (std::int32_t j = 23; j > i; --j)
      if (!model.conductors().find(i, j) && model.slots().find(i, i) && model.slots().find(j, j))
        return {i, j};
  throw std::logic_error("all are bonded");
}

TEST(ChangingConductors, a_broken_bond_insulates_and_no_other_pair_notices) {
  for (const Law law : {Law::platonic, Law::voronoi}) {
    Body body(law, BrokenBonds::insulate, small_block());
    Conductances expected = body.conductances();
    const Pair cut = body.model->slots().pairs()[7];
    ASSERT_GT(expected.at(cut), 0);
    const std::uint64_t before = body.model->conductors_version();
    body.model->break_bond(cut, 2e-4);
    EXPECT_TRUE(body.conduction->follow_bonds(*body.model));
    EXPECT_GT(body.model->conductors_version(), before);
    expected[cut] = 0;
    EXPECT_EQ(body.conductances(), expected);
    EXPECT_FALSE(body.conduction->follow_bonds(*body.model));
  }
}

TEST(ChangingConductors, a_broken_bond_conducts_as_before_where_the_scene_says_so) {
  for (const Law law : {Law::platonic, Law::voronoi}) {
    Body body(law, BrokenBonds::conduct, small_block());
    const Conductances expected = body.conductances();
    for (const Pair& pair : body.model->slots().pairs()) body.model->break_bond(pair, 2e-4);
    EXPECT_FALSE(body.conduction->follow_bonds(*body.model));
    EXPECT_EQ(body.conductances(), expected);
  }
}

TEST(ChangingConductors, faces_that_no_bond_crossed_conduct_on_when_all_bonds_are_broken) {
  Body body(Law::voronoi, BrokenBonds::insulate, small_block());
  Conductances expected = body.conductances();
  std::size_t untouched = expected.size();
  for (const Pair& pair : body.model->slots().pairs()) {
    body.model->break_bond(pair, 2e-4);
    expected[pair] = 0;
    --untouched;
  }
  body.conduction->follow_bonds(*body.model);
  EXPECT_EQ(body.conductances(), expected);
  EXPECT_GT(untouched, 0u);
}

TEST(ChangingConductors, a_bond_made_again_conducts_what_it_did_at_the_start) {
  for (const Law law : {Law::platonic, Law::voronoi}) {
    Body body(law, BrokenBonds::insulate, small_block());
    const Conductances expected = body.conductances();
    const Pair pair = body.model->slots().pairs()[7];
    body.model->break_bond(pair, 2e-4);
    body.conduction->follow_bonds(*body.model);
    ASSERT_TRUE(body.model->make_bond(pair, 1.7e-4));
    EXPECT_TRUE(body.conduction->follow_bonds(*body.model));
    EXPECT_EQ(body.conductances(), expected);
    // Within one step it may do both.
    body.model->break_bond(pair, 2e-4);
    ASSERT_TRUE(body.model->make_bond(pair, 1.7e-4));
    body.conduction->follow_bonds(*body.model);
    EXPECT_EQ(body.conductances(), expected);
  }
}

TEST(ChangingConductors, a_new_pair_conducts_through_its_elements_own_areas) {
  for (const BrokenBonds choice : {BrokenBonds::insulate, BrokenBonds::conduct}) {
    Body body(Law::platonic, choice, small_block());
    Conductances expected = body.conductances();
    const Pair cut = body.model->slots().pairs()[0];
    body.model->break_bond(cut, 2e-4);  // leaves a free slot on either side
    const Pair pair = apart(*body.model);
    const double length = 1.9e-4;
    ASSERT_TRUE(body.model->make_bond(pair, length));
    body.conduction->follow_bonds(*body.model);
    const auto side = [&](std::int32_t element) {
      return body.geometry.transmission_area[static_cast<std::size_t>(element)];
    };
    if (choice == BrokenBonds::insulate) expected[cut] = 0;
    expected[pair] = conductivity * std::sqrt(side(pair.i) * side(pair.j)) / length;
    const Conductances found = body.conductances();
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [of, value] : expected) EXPECT_DOUBLE_EQ(found.at(of), value);
    // It breaks like any other, and the distance of its next bond counts.
    body.model->break_bond(pair, length);
    body.conduction->follow_bonds(*body.model);
    EXPECT_EQ(body.conductances().at(pair), choice == BrokenBonds::insulate ? 0 : found.at(pair));
    ASSERT_TRUE(body.model->make_bond(pair, 2 * length));
    body.conduction->follow_bonds(*body.model);
    EXPECT_DOUBLE_EQ(body.conductances().at(pair), 0.5 * found.at(pair));
  }
}

TEST(ChangingConductors, a_new_pair_without_a_face_conducts_through_the_mean_of_bonded_faces) {
  Body body(Law::voronoi, BrokenBonds::insulate, small_block());
  const std::vector<Pair> bonds = body.model->slots().pairs();
  const auto mean_face = [&](std::int32_t element) {
    double sum = 0, count = 0;
    for (const Pair& bond : bonds)
      if (bond.i == element || bond.j == element) {
        sum += body.geometry.path(body.model->specimen(), bond).area;
        ++count;
      }
    return sum / count;
  };
  body.model->break_bond(bonds[0], 2e-4);
  const Pair pair = apart(*body.model);
  const double expected = std::sqrt(mean_face(pair.i) * mean_face(pair.j)) / 1.9e-4;
  ASSERT_TRUE(body.model->make_bond(pair, 1.9e-4));
  body.conduction->follow_bonds(*body.model);
  EXPECT_DOUBLE_EQ(body.conductances().at(pair), conductivity * expected);
}

TEST(ChangingConductors, materials_and_their_contacts_hold_for_new_pairs_as_well) {
  // Once as stored conductances, once as lengths and resistances beside a conductivity that varies.
  for (const bool varies : {false, true}) {
    std::vector<Material> materials = {material_of(2790, 880, 100, {}, "a"),
                                       material_of(2790, 880, 300, {}, "b")};
    if (varies)
      for (Material& m : materials) {
        const double value = m.conductivity(300);
        m.conductivity = TemperatureFunction({200, 300, 400}, {value, value, 2 * value});
      }
    std::vector<std::size_t> of_element(24, 0);
    for (std::size_t i = 0; i < 24; i += 2) of_element[i] = 1;
    Body body(Law::platonic, BrokenBonds::insulate, small_block(), materials, of_element,
              {{"a", "b", 1e5}});
    Conductances expected = body.conductances();
    for (const Pair& pair : body.model->slots().pairs()) {
      body.model->break_bond(pair, 2e-4);
      expected[pair] = 0;
    }
    for (const Pair pair : {Pair{0, 23}, Pair{0, 22}, Pair{1, 23}}) {
      ASSERT_TRUE(body.model->make_bond(pair, 1.9e-4));
      const double area =
          std::sqrt(body.geometry.transmission_area[static_cast<std::size_t>(pair.i)] *
                    body.geometry.transmission_area[static_cast<std::size_t>(pair.j)]);
      const bool is_mixed = (pair.i + pair.j) % 2 == 1;
      const double lambda = is_mixed ? 150 : pair.i % 2 == 0 ? 300 : 100;
      const double resistance = 1.9e-4 / (lambda * area) + (is_mixed ? 1 / (1e5 * area) : 0);
      expected[pair] = 1 / resistance;
    }
    body.conduction->follow_bonds(*body.model);
    const Conductances found = body.conductances();
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [pair, value] : expected)
      EXPECT_NEAR(found.at(pair), value, 1e-14 * value) << varies << " " << pair.i << " " << pair.j;
  }
}

std::vector<double> state_of(const Body& body) {
  Archive archive;
  body.conduction->state(archive);
  return archive.values();
}

TEST(ChangingConductors, are_the_same_whatever_the_order_of_events) {
  Body one(Law::platonic, BrokenBonds::insulate, small_block());
  Body two(Law::platonic, BrokenBonds::insulate, small_block());
  Body restored(Law::platonic, BrokenBonds::insulate, small_block());
  const std::vector<Pair> bonds = one.model->slots().pairs();
  for (const Pair& pair : bonds) one.model->break_bond(pair, 2e-4);
  for (const Pair pair : {Pair{0, 23}, Pair{0, 22}, Pair{1, 23}, bonds[3]}) {
    ASSERT_TRUE(one.model->make_bond(pair, 1.9e-4));
    one.conduction->follow_bonds(*one.model);
  }
  for (std::size_t k = bonds.size(); k-- > 0;) {
    two.model->break_bond(bonds[k], 2e-4);
    two.conduction->follow_bonds(*two.model);
  }
  for (const Pair pair : {bonds[3], Pair{1, 23}, Pair{0, 22}, Pair{0, 23}})
    ASSERT_TRUE(two.model->make_bond(pair, 1.9e-4));
  two.conduction->follow_bonds(*two.model);
  Archive saved(state_of(one), one.model->elements());
  restored.conduction->state(saved);
  const auto column = [](const Body& body) {
    const double* data = body.model->data(columns::conductance);
    return std::vector<double>(data, data + body.model->size(columns::conductance));
  };
  EXPECT_EQ(column(one), column(two));
  EXPECT_EQ(column(one), column(restored));
  EXPECT_EQ(state_of(one), state_of(two));
  EXPECT_EQ(one.conduction->surely_stable_step(1e-6),
            restored.conduction->surely_stable_step(1e-6));
}

TEST(ChangingConductors, new_pairs_shorten_the_stable_step_no_more_than_is_foreseen) {
  Body body(Law::platonic, BrokenBonds::conduct, small_block());
  const double at_start = body.conduction->stable_time_step(*body.model, {});
  EXPECT_EQ(body.conduction->surely_stable_step(at_start), at_start);
  for (const Pair& pair : body.model->slots().pairs()) body.model->break_bond(pair, 2e-4);
  int made = 0;
  for (std::int32_t j = 1; j < 24; ++j)
    if (!body.model->conductors().find(0, j) && body.model->make_bond({0, j}, 1e-4)) ++made;
  ASSERT_GE(made, 2);
  body.conduction->follow_bonds(*body.model);
  const double now = body.conduction->stable_time_step(*body.model, {});
  const double foreseen = body.conduction->surely_stable_step(at_start);
  EXPECT_LT(now, 0.8 * at_start);
  EXPECT_LE(foreseen, now);
  EXPECT_GT(foreseen, 0.5 * now);
}

}  // namespace solidem::changing_conductors_test
