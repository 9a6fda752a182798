// SPDX-License-Identifier: GPL-2.0-or-later
//
// A program that links the library adds an effect of its own, a uniform field, without a line
// anywhere else: its section, its column, its energy, its summary and its checkpoint.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "effects/assembly.hpp"
#include "effects/effect_kind.hpp"
#include "effects/push.hpp"
#include "keys/rules.hpp"
#include "scene/body.hpp"
#include "scene/scene_text.hpp"

namespace solidem::test::effect_of_a_program_test {

constexpr Dimension acceleration{"an acceleration", "m/s^2", "9.81 m/s^2"};
constexpr Column fall_work{"fall_work",
                           Site::element,
                           Column::Layout::lanes,
                           1,
                           1,
                           true,
                           "J",
                           "that the field did on the element"};

struct FieldParameters {
  Vector field{};  ///< m/s²
};

class UniformField : public Effect {
 public:
  UniformField(const FieldParameters& parameters, const std::vector<double>& mass)
      : field_(parameters.field), mass_(mass) {}

  void advance(Model& model, const Step& step) override {
    const auto before = model.positions(), after = model.next_positions();
    double* work = model.data(fall_work);
    const Pushes pushes(model, step);
    for (std::size_t i = 0; i < model.elements(); ++i) {
      pushes.push(i, mass_[i] * field_);
      const Vector moved{after[i][0] - before[i][0], after[i][1] - before[i][1],
                         after[i][2] - before[i][2]};
      work[i] += mass_[i] * dot(field_, moved);
    }
    ++steps_;
  }

  void observe(const Model& model, Observation& observation) const override {
    for (std::size_t i = 0; i < model.elements(); ++i)
      observe_push(model, observation, static_cast<std::int32_t>(i), mass_[i] * field_);
    observation.energies.add(EnergyLedger::Kind::input, "field_work", work(model));
    observation.add("steps_in_the_field", static_cast<double>(steps_));
  }

  double work(const Model& model) const override {
    double sum = 0;
    for (std::size_t i = 0; i < model.elements(); ++i) sum += model.data(fall_work)[i];
    return sum;
  }
  void state(Archive& archive) override { archive(steps_); }
  void summarise(const Model& model, Summary& summary) const override {
    summary["field_work"] = work(model);
  }

 private:
  Vector field_;
  std::vector<double> mass_;
  std::int64_t steps_ = 0;
};

std::vector<Key> field_keys(FieldParameters& p, Reading& /*reading*/) {
  return {must_have("field", vector(p.field, acceleration)).means("strength")};
}

void plan_field(const Setup& setup, Plan& plan) {
  const auto& field = setup.get<FieldParameters>();
  if (!field) return;
  plan.effects.push_back(
      {"uniform_field", "[uniform_field]", "", Phase::push, [field = *field](Assembly& assembly) {
         return std::make_unique<UniformField>(field, assembly.mass);
       }});
  plan.ask("uniform_field", {&fall_work});
}

EffectKind field_kind() {
  EffectKind kind =
      single_kind<FieldParameters>("uniform_field", field_keys, as_read<FieldParameters>);
  kind.needs = Provides::motion;
  kind.plan = plan_field;
  kind.example = "[uniform_field]\nfield = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]\n";
  return kind;
}

/// Adds the kind for as long as a test runs.
class EffectOfAProgram : public ::testing::Test {
 protected:
  EffectOfAProgram() { effect_kinds().push_back(field_kind()); }
  ~EffectOfAProgram() override { effect_kinds().pop_back(); }

  const std::string body = R"toml([specimen]
shape = "box"
size = ["1 mm", "1 mm", "1 mm"]
elements = 60
[material]
density = "2700 kg/m^3"
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
[run]
steps = 400
)toml";
  const std::string falling = body + field_kind().example;
};

Simulation simulate(const std::string& text) {
  const Scene scene = read_text_scene(text);
  return Simulation(scene.setup, make_body(scene));
}

double of(const HistoryRow& row, const std::string& name) {
  for (const auto& [key, value] : row.values)
    if (key == name) return value;
  return std::numeric_limits<double>::quiet_NaN();
}

TEST_F(EffectOfAProgram, LetsABodyFallAsGalileoSays) {
  Simulation simulation = simulate(falling);
  simulation.advance(400);
  const double t = simulation.time(), depth = 0.5 * 9.81 * t * t;
  for (std::size_t i = 0; i < simulation.model().elements(); ++i) {
    const double fallen =
        simulation.model().specimen().position[i].z - simulation.model().positions()[i][2];
    EXPECT_NEAR(fallen, depth, 1e-12 * 1e-3);
  }
}

TEST_F(EffectOfAProgram, EntersTheBalanceOfEnergyUnderItsName) {
  Simulation simulation = simulate(falling);
  simulation.advance(400);
  const HistoryRow row = simulation.observe();
  const double work = of(row, "field_work");
  EXPECT_GT(work, 0);
  EXPECT_NEAR(of(row, "kinetic_energy"), work, 1e-7 * work);
  EXPECT_NEAR(of(row, "energy_balance"), 0, 1e-7 * work);
  EXPECT_EQ(of(row, "steps_in_the_field"), 400);
  nlohmann::ordered_json summary;
  for (const auto& effect : simulation.effects()) effect->summarise(simulation.model(), summary);
  EXPECT_EQ(summary["field_work"].get<double>(), work);
}

TEST_F(EffectOfAProgram, GoesOnFromACheckpointToTheSameBits) {
  Simulation whole = simulate(falling), first = simulate(falling), second = simulate(falling);
  whole.advance(400);
  first.advance(150);
  second.restore(150, first.save());
  second.advance(250);
  EXPECT_EQ(second.save(), whole.save());
  EXPECT_EQ(whole.save().count("column.fall_work"), 1u);
  EXPECT_EQ(whole.save().count("effect.uniform_field"), 1u);
}

TEST_F(EffectOfAProgram, CostsNothingWhereASceneDoesNotNameIt) {
  const Simulation with = simulate(falling), without = simulate(body);
  EXPECT_TRUE(with.model().has(fall_work));
  EXPECT_FALSE(without.model().has(fall_work));
  EXPECT_EQ(without.effects().size() + 1, with.effects().size());
}

TEST_F(EffectOfAProgram, ItsSectionIsReadAsStrictlyAsAnyOther) {
  EXPECT_NE(
      complaint(replaced(falling, "\"-9.81 m/s^2\"", "\"-9.81 m\"")).find("[uniform_field] field"),
      std::string::npos);
  EXPECT_NE(complaint(replaced(falling, "field = ", "feld = ")).find("did you mean field"),
            std::string::npos);
  const std::string still = replaced(
      replaced(falling, body.substr(body.find("[beams]")),
               "[conduction]\ninitial_temperature = \"300 K\"\n[run]\nsteps = 1\n"),
      "[material]\n",
      "[material]\nspecific_heat_capacity = \"880 J/(kg K)\"\nconductivity = \"134 W/(m K)\"\n");
  EXPECT_NE(complaint(still).find("[uniform_field]: nothing moves; expected a section [beams]"),
            std::string::npos)
      << complaint(still);
}

}  // namespace solidem::test::effect_of_a_program_test
