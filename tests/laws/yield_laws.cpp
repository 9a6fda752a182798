// SPDX-License-Identifier: GPL-2.0-or-later
//
// Yield laws of bonds: each against its derivative, and the returns that they share against what
// they solve and against exact integration.
#include "laws/yield_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "laws/beam_flow.hpp"

namespace solidem::yield_laws_test {

LinearHardening linear(double hardening_ratio) {
  return {2e-3, hardening_ratio};
}

VoceHardening voce() {
  VoceHardening law;
  law.yield_strain = 2e-3;
  law.saturation_strain = 3e-3;
  law.plastic_scale = 1e-2;
  return law;
}

/// The law of this name with parameters of bonds of metal.
template <class Law>
Law typical() {
  Law law;
  for (const auto& parameter : law.parameters())
    law.*parameter.member = parameter.stress_name != nullptr ? 3e-3 : 0.3;
  return law;
}

TEST(YieldLaws, have_names_and_parameters_of_their_own) {
  std::string names;
  YieldLaws::for_each([&](const auto& law) {
    EXPECT_EQ(names.find(std::string(law.name) + ";"), std::string::npos) << law.name;
    names += std::string(law.name) + ";";
    EXPECT_GT(law.parameters().size(), 0u);
    for (const auto& parameter : law.parameters()) EXPECT_NE(parameter.meaning[0], 0);
  });
}

TEST(YieldLaws, slope_is_the_derivative_of_the_limit) {
  YieldLaws::for_each([](auto empty) {
    const auto law = typical<decltype(empty)>();
    const YieldCurve<decltype(empty), double> curve{law};
    for (const double at : {1e-4, 3e-3, 0.1}) {
      const double h = 1e-4 * at;
      const double expected = (curve.limit(at + h) - curve.limit(at - h)) / (2 * h);
      EXPECT_NEAR(curve.slope(at), expected, 1e-6 * (1 + std::fabs(expected))) << law.name;
    }
  });
}

TEST(YieldLaws, limit_is_nowhere_below_the_lower_bound) {
  YieldLaws::for_each([](auto empty) {
    const auto law = typical<decltype(empty)>();
    for (const double at : {0.0, 1e-4, 3e-3, 0.1})
      for (const double temperature : {0.0, 300.0, 2000.0})
        for (const double rate : {0.0, 1.0, 1e5})
          EXPECT_GE(law.limit(at, YieldState<double>{temperature, rate}), law.lower_bound(at));
  });
}

/// A law without its closed forms.
template <class Law>
struct Plain {
  Law law;
  template <class Real>
  Real limit(const Real& plastic_strain, const YieldState<Real>& state) const {
    return law.limit(plastic_strain, state);
  }
};

TEST(YieldLaws, newtons_return_is_the_closed_form_of_linear_hardening) {
  for (const double h : {0.0, 1e-3, 0.1, 2.0}) {
    const LinearHardening law = linear(h);
    const Plain<LinearHardening> plain{law};
    const YieldCurve<Plain<LinearHardening>, double> curve{plain};
    for (const double before : {0.0, 1e-3, 0.2})
      for (const double over : {1e-12, 1e-6, 1e-3, 1.0}) {
        const double strain = law.limit(before) + over;
        EXPECT_NEAR(newton_return(curve, strain, before), law.returned(strain, before),
                    1e-14 * strain)
            << h << ' ' << before << ' ' << over;
        const YieldCurve<LinearHardening, double> closed{law};
        EXPECT_NEAR(curve.total_limit(before), closed.total_limit(before), 1e-15);
      }
  }
}

TEST(YieldLaws, a_return_ends_on_the_yield_curve_of_any_law) {
  YieldLaws::for_each([](auto empty) {
    const auto law = typical<decltype(empty)>();
    const YieldCurve<decltype(empty), double> curve{law};
    for (const double before : {0.0, 1e-3, 0.05})
      for (const double over : {1e-9, 1e-4, 1e-2, 0.3}) {
        const double strain = curve.limit(before) + over;
        const double after = returned_strain(curve, strain, before);
        EXPECT_LT(after, strain);
        const double tolerance = 4e-16 * (1 + curve.slope(before + strain - after));
        EXPECT_NEAR(after, curve.limit(before + strain - after), tolerance) << law.name;
      }
  });
}

TEST(YieldLaws, a_scaled_curve_is_the_law_with_its_stresses_and_plastic_strains_scaled) {
  const LimitScale<double> scale{false, 0.6, 2.0, 1.0};
  YieldLaws::for_each([&](auto empty) {
    const auto law = typical<decltype(empty)>();
    const ScaledLaw<decltype(empty), double> scaled{law, scale};
    const YieldCurve<ScaledLaw<decltype(empty), double>, double> curve{scaled};
    for (const double before : {0.0, 1e-3, 0.05}) {
      EXPECT_DOUBLE_EQ(curve.limit(before), 0.6 * law.limit(before / 2, YieldState<double>{}));
      EXPECT_LE(curve.lower_bound(before), curve.limit(before));
      EXPECT_DOUBLE_EQ(curve.total_limit(before), curve.limit(before) + before);
      const double strain = curve.limit(before) + 0.01;
      const double after = returned_strain(curve, strain, before);
      EXPECT_NEAR(after, curve.limit(before + strain - after), 1e-15) << law.name;
    }
  });
  // Linear hardening of another material is linear hardening.
  const LinearHardening law = linear(0.05), own{0.6 * 2e-3, 0.6 / 2 * 0.05};
  const ScaledLaw<LinearHardening, double> scaled{law, scale};
  const YieldCurve<ScaledLaw<LinearHardening, double>, double> curve{scaled};
  const YieldCurve<LinearHardening, double> expected{own};
  for (const double before : {0.0, 1e-3, 0.05}) {
    EXPECT_NEAR(curve.slope(before), expected.slope(before), 1e-15);
    EXPECT_NEAR(returned_strain(curve, 0.03, before), returned_strain(expected, 0.03, before),
                1e-16);
  }
}

JohnsonCook fast_metal() {
  JohnsonCook law;
  law.yield_strain = 3e-3;
  law.hardening_strain = 4e-3;
  law.hardening_exponent = 0.25;
  law.rate_sensitivity = 0.025;
  return law;
}

TEST(YieldLaws, a_return_ends_at_the_rate_that_it_makes) {
  const JohnsonCook law = fast_metal();
  YieldCurve<JohnsonCook, double> curve{law, {0, 50}};
  for (const double per_flow : {0.0, 1.0, 1e6, 1e12}) {
    curve.rate_per_flow = per_flow;
    for (const double before : {0.0, 1e-3, 0.1}) {
      curve.flow_start = before;
      const double strain = curve.limit(before) + 2e-3;
      const double after = returned_strain(curve, strain, before);
      const double flow = strain - after, rate = 50 + per_flow * flow;
      EXPECT_GE(flow, 0);
      EXPECT_NEAR(after, law.limit(before + flow, YieldState<double>{0, rate}), 1e-15);
      EXPECT_GE(after, curve.lower_bound(before));
    }
  }
}

TEST(YieldLaws, associated_flow_finds_a_curve_that_begins_infinitely_steep) {
  const JohnsonCook law = fast_metal();
  const YieldCurve<JohnsonCook, double> curve{law};
  for (const double over : {1e-9, 1e-6, 1e-3, 0.1}) {
    const ResultantStrain<double> strain{law.yield_strain + over, 0, 0};
    const AssociatedFlow<double> flow = associated_flow(curve, strain, 0.4, strain.normal, 0.0);
    const double expected = returned_strain(curve, strain.normal, 0.0);  // in tension alone
    EXPECT_NEAR(flow.elastic_strain, expected, 1e-5 * over) << over;
  }
}

/// Strength that falls steeply and then stays: its derivative is below −1 on the way.
struct Softening {
  template <class Real>
  Real limit(const Real& plastic_strain, const YieldState<Real>&) const {
    using std::exp;
    return Real{1e-3} + Real{4e-3} * exp(-plastic_strain / Real{1e-3});
  }
};

TEST(YieldLaws, newtons_return_stays_in_its_bracket_where_a_law_softens) {
  const Softening law;
  const YieldCurve<Softening, double> curve{law};
  for (const double before : {0.0, 5e-4, 2e-3, 1e-2})
    for (const double over : {1e-8, 1e-5, 1e-3, 0.1}) {
      const double strain = curve.limit(before) + over;
      const double after = newton_return(curve, strain, before);
      EXPECT_GE(after, 0);
      EXPECT_LE(after, strain);
      EXPECT_NEAR(after, curve.limit(before + strain - after), 1e-15) << before << ' ' << over;
    }
}

/// Stress over E of a bar strained monotonically by dε = dσ/E + dκ, σ = E ε_y(κ), integrated by
/// Runge and Kutta's fourth order in the strain.
double integrated_voce(const VoceHardening& law, double strain) {
  if (strain <= law.yield_strain) return strain;
  const auto slope = [&](double plastic) {
    const double hardening =
        law.saturation_strain / law.plastic_scale * std::exp(-plastic / law.plastic_scale);
    return 1 / (1 + hardening);
  };
  const int steps = 2000;
  const double h = (strain - law.yield_strain) / steps;
  double plastic = 0;
  for (int n = 0; n < steps; ++n) {
    const double a = slope(plastic), b = slope(plastic + 0.5 * h * a);
    const double c = slope(plastic + 0.5 * h * b), d = slope(plastic + h * c);
    plastic += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return strain - plastic;
}

const Vector3<double> direction{0.6, 0.64, 0.48};
constexpr double E = 70e9, G = 27e9, r = 3e-5, l = 1.1e-4;

YieldingBeam<double> beam() {
  return {euler_bernoulli_rigidity<double>({E, G, r}), l, r, G / E};
}

/// A beam whose ends do not turn.
BeamResponse<double> respond(FlowRule rule, const YieldCurve<VoceHardening, double>& curve,
                             const BeamHistory<double>& history, const Vector3<double>& chord) {
  return flow_response(rule, curve, beam(), history, direction, {chord, {}, {}});
}

TEST(VoceHardening, one_beam_follows_the_integrated_curve_by_either_rule) {
  const VoceHardening law = voce();
  const YieldCurve<VoceHardening, double> curve{law};
  BeamHistory<double> radial = unyielded(direction), offset = radial;
  for (int n = 1; n <= 100; ++n) {
    const double strain = 5e-4 * n;
    const Vector3<double> chord = (l * (1 + strain)) * direction;
    const auto a = respond(FlowRule::radial_return, curve, radial, chord);
    const auto b = respond(FlowRule::scaled_offset, curve, offset, chord);
    const double expected = integrated_voce(law, strain);
    EXPECT_NEAR(a.strain, expected, 1e-11) << strain;
    EXPECT_NEAR(b.load.force.x, a.load.force.x, 1e-11 * E * r * r);
    radial = a.history;
    offset = b.history;
  }
  EXPECT_GT(radial.strain, 4 * law.plastic_scale);
}

TEST(VoceHardening, scaled_offset_yields_in_reverse_only_at_the_opposite_strain) {
  const VoceHardening law = voce();
  const YieldCurve<VoceHardening, double> curve{law};
  BeamHistory<double> history = unyielded(direction);
  const auto at = [&](double strain) {
    return respond(FlowRule::scaled_offset, curve, history, (l * (1 + strain)) * direction);
  };
  for (int n = 1; n <= 100; ++n) history = at(1e-4 * n).history;
  EXPECT_GT(history.strain, 5e-3);
  EXPECT_EQ(at(-0.99e-2).history.strain, history.strain);
  EXPECT_GT(at(-1.01e-2).history.strain, history.strain);
}

TEST(VoceHardening, work_of_a_pull_is_energy_and_plastic_work) {
  const VoceHardening law = voce();
  const YieldCurve<VoceHardening, double> curve{law};
  const auto error_of = [&](int steps) {
    BeamHistory<double> history = unyielded(direction);
    double work = 0, plastic = 0, energy = 0, before = 0;
    for (int n = 1; n <= steps; ++n) {
      const double strain = 2e-2 * n / steps;
      const auto response =
          respond(FlowRule::radial_return, curve, history, (l * (1 + strain)) * direction);
      const double force = dot(response.load.force, direction);
      work += 0.5 * (before + force) * 2e-2 * l / steps;
      plastic += response.plastic_work;
      energy = response.energy;
      history = response.history;
      before = force;
    }
    return std::fabs(work - energy - plastic) / work;
  };
  EXPECT_LT(error_of(1000), 1e-6);
}

}  // namespace solidem::yield_laws_test
