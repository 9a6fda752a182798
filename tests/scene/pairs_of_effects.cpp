// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every pair of effects that a scene may name together runs for some steps: all stays finite,
// energy and heat are balanced, a restart and any number of threads give the same bits. What a kind
// of effect brings for it is its example; a new one joins by being in the list.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstring>
#include <map>

#include "effects/effect_kind.hpp"
#include "model/error.hpp"
#include "scene/body.hpp"
#include "scene/scene_text.hpp"
#include "support/sanitized.hpp"

namespace solidem::test::pairs_of_effects_test {

// Under sanitizers memory is looked at, which takes fewer steps than physics.
constexpr int steps = is_sanitized ? 180 : 600, restart_at = 7 * steps / 12;

const std::string base = R"toml([specimen]
shape = "box"
size = ["5 mm", "3 mm", "2 mm"]
elements = 240
[[material]]
name = "left"
density = "2790 kg/m^3"
specific_heat_capacity = "880 J/(kg K)"
conductivity = "134 W/(m K)"
expansion_coefficient = "23e-6 1/K"
region = { upper = ["2.5 mm", "any", "any"] }
[[material]]
name = "right"
density = "5000 kg/m^3"
specific_heat_capacity = "500 J/(kg K)"
conductivity = "50 W/(m K)"
expansion_coefficient = "12e-6 1/K"
region = { lower = ["2.5 mm", "any", "any"] }
[run]
steps = 600
time_step_ratio = 0.05
)toml";

const EffectKind& kind_of(const std::string& section) {
  for (const EffectKind& kind : effect_kinds())
    if (kind.section == section) return kind;
  throw std::logic_error("no kind of effect has a section " + section);
}

using Sections = std::vector<std::string>;

void add(Sections& sections, const std::string& section) {
  if (std::find(sections.begin(), sections.end(), section) == sections.end())
    sections.push_back(section);
}

Sections providers(Provides what) {
  Sections sections;
  for (const EffectKind& kind : effect_kinds())
    if (kind.provides == what) sections.push_back(kind.section);
  return sections;
}

/// Whether what a section needs beside it leads to another.
bool leads_to(const std::string& section, const std::string& other) {
  const std::vector<std::string> beside = kind_of(section).beside;
  return section == other || std::any_of(beside.begin(), beside.end(),
                                         [&](const auto& name) { return leads_to(name, other); });
}

/// The section, of those that would do, which goes with what moves.
std::string chosen(const std::vector<std::string>& sections, const std::string& mover) {
  for (const std::string& section : sections)
    if (leads_to(section, mover)) return section;
  return sections.front();
}

/// Adds what a section needs beside it, and what moves or heats where the choice is free. A body
/// that can move is strained from the start, so that it flows, breaks, touches and bonds anew.
void add_with_needs(Sections& sections, const std::string& section, const std::string& mover) {
  const EffectKind& kind = kind_of(section);
  if (!kind.beside.empty()) add_with_needs(sections, chosen(kind.beside, mover), mover);
  if (kind.needs == Provides::motion) add(sections, mover);
  if (kind.needs == Provides::heat) add(sections, providers(Provides::heat).front());
  add(sections, section);
  if (kind.provides == Provides::motion || kind.needs == Provides::motion)
    add(sections, "initial_velocities");
}

std::string scene_of(const Sections& sections) {
  std::string text = base;
  for (const std::string& section : sections) text += kind_of(section).example;
  return text;
}

/// Whether a plan can be made: some sections do not go together unless a third is there.
bool has_plan(const Sections& sections) {
  try {
    make_plan(read_text_scene(scene_of(sections)).setup, false);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

bool go_together(const Sections& sections) {
  for (const std::string& section : sections)
    for (const Conflict& conflict : kind_of(section).conflicts)
      if (std::find(sections.begin(), sections.end(), conflict.section) != sections.end())
        return false;
  return true;
}

struct Pairing {
  Sections sections;
};

std::string name_of(const ::testing::TestParamInfo<Pairing>& info) {
  std::string name;
  for (const std::string& section : info.param.sections)
    name += (name.empty() ? "" : "_with_") + section;
  return name;
}

/// All sets of sections that a pair calls for, each once; where the pair leaves open what moves,
/// with each mover.
std::vector<Pairing> pairings() {
  std::map<Sections, Pairing> found;
  for (const std::string& mover : providers(Provides::motion))
    for (const EffectKind& a : effect_kinds())
      for (const EffectKind& b : effect_kinds()) {
        Sections sections;
        add_with_needs(sections, a.section, mover);
        add_with_needs(sections, b.section, mover);
        Sections sorted = sections;
        std::sort(sorted.begin(), sorted.end());
        if (go_together(sections) && has_plan(sections)) found.emplace(sorted, Pairing{sections});
      }
  std::vector<Pairing> all;
  for (const auto& entry : found) all.push_back(entry.second);
  return all;
}

class PairsOfEffects : public ::testing::TestWithParam<Pairing> {
 protected:
  PairsOfEffects()
      : scene_(read_text_scene(scene_of(GetParam().sections))), body_(make_body(scene_)) {}

  bool names(const std::string& section) const {
    const Sections& sections = GetParam().sections;
    return std::find(sections.begin(), sections.end(), section) != sections.end();
  }
  Simulation simulation() const { return Simulation(scene_.setup, body_); }

  Scene scene_;
  Specimen body_;
};

double of(const HistoryRow& row, const std::string& name) {
  for (const auto& [key, value] : row.values)
    if (key == name) return value;
  return 0;
}

/// The largest energy that a row names.
double scale_of(const HistoryRow& row) {
  double scale = 0;
  for (const auto& [name, value] : row.values)
    if (name.find("energy") != std::string::npos || name.find("work") != std::string::npos) {
      if (name != "energy_balance" && name != "thermal_energy")
        scale = std::max(scale, std::fabs(value));
    }
  return scale;
}

/// Also where a value is not a number yet, such as the time of a rupture that has not happened.
bool are_the_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST_P(PairsOfEffects, BalanceEnergyAndHeatAndGoOnFromACheckpointOnOtherThreadsToTheSameBits) {
  omp_set_num_threads(1);
  Simulation whole = simulation();
  double energy_scale = 1e-20,
         heat_scale = 0.1;  // J, above the round-off of bonds that no one moves
  for (int n = 0; n <= 6; ++n) {
    const HistoryRow row = whole.observe();  // throws where anything is not finite
    energy_scale = std::max(energy_scale, scale_of(row));
    heat_scale = std::max(heat_scale, std::fabs(of(row, "thermal_energy")));
    // What cracks under central forces take is what the balance lacks: docs/scene.md.
    if (!names("damage") || !names("central_forces")) {
      EXPECT_LE(std::fabs(of(row, "energy_balance")), 0.02 * energy_scale) << row.step;
    }
    EXPECT_LE(std::fabs(of(row, "heat_balance")), 1e-12 * heat_scale) << row.step;
    if (n < 6) whole.advance(steps / 6);
  }
  const auto end = whole.save();
  omp_set_num_threads(2);
  Simulation first = simulation();
  first.advance(restart_at);
  omp_set_num_threads(3);
  Simulation second = simulation();
  second.restore(restart_at, first.save());
  second.advance(steps - restart_at);
  omp_set_num_threads(1);
  const auto resumed = second.save();
  for (const auto& [name, values] : end) {
    ASSERT_TRUE(resumed.count(name)) << name;
    EXPECT_TRUE(are_the_same_bits(resumed.at(name), values)) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, PairsOfEffects, ::testing::ValuesIn(pairings()), name_of);

TEST(KindsOfEffects, BringAnExampleThatTheyReadAndThatMakesThemAct) {
  for (const EffectKind& kind : effect_kinds()) {
    Sections sections;
    add_with_needs(sections, kind.section, "beams");
    const std::string text = scene_of(sections);
    ASSERT_FALSE(kind.example.empty()) << kind.section;
    ASSERT_EQ(complaint(text), "") << kind.section;
    EXPECT_TRUE(kind.is_named(read_text_scene(text).setup)) << kind.section;
  }
}

}  // namespace solidem::test::pairs_of_effects_test
