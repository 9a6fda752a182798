// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/svg_plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace solidem::svg_plot_test {

TEST(Ticks, AreRoundNumbersInsideTheAxis) {
  EXPECT_EQ(ticks({"", 0, 10}, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks({"", -2.9, 3.1}, 6), (std::vector<double>{-2, -1, 0, 1, 2, 3}));
  for (const auto& [low, high] : {std::pair{0.613, 1.497}, {-3e-7, 8e-7}, {1e5, 1.2e5}}) {
    const std::vector<double> found = ticks({"", low, high}, 6);
    ASSERT_GE(found.size(), 3U);
    EXPECT_LE(found.size(), 13U);
    EXPECT_GE(found.front(), low - 1e-9 * (high - low));
    EXPECT_LE(found.back(), high + 1e-9 * (high - low));
    const double step = found[1] - found[0];
    const double mantissa = step / std::pow(10, std::floor(std::log10(step * (1 + 1e-9))));
    EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 ||
                std::abs(mantissa - 5) < 1e-6)
        << mantissa;
  }
  EXPECT_TRUE(ticks({"", 1, 1}, 5).empty());
}

TEST(Ticks, OfALogarithmicAxisArePowersOfTen) {
  const std::vector<double> found = ticks({"", 0.5, 2e4, true}, 6);
  ASSERT_EQ(found.size(), 5U);
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k] / std::pow(10, static_cast<double>(k)), 1, 1e-12);
  EXPECT_LE(ticks({"", 1e-9, 1e9, true}, 6).size(), 7U);
}

TEST(UnitPrefix, LeavesFiguresFromOneToAThousand) {
  for (const double value : {3e-11, 4.2e-6, 0.02, 1.0, 25.0, 999.5, 1.5e6, 7.3e10, -2.5e-4}) {
    const UnitPrefix prefix = unit_prefix(value);
    EXPECT_GE(std::abs(value) / prefix.factor, 0.999) << value;
    EXPECT_LT(std::abs(value) / prefix.factor, 1000) << value;
  }
  EXPECT_STREQ(unit_prefix(2.8e6).symbol, "M");
  EXPECT_STREQ(unit_prefix(0).symbol, "");
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++found;
  return found;
}

TEST(Svg, ShowsPanelsCurvesAndWordsAndNoNumberThatIsNone) {
  PlotPanel panel;
  panel.title = "a < b & c";
  panel.x = {"δ_eq, mm", 0, 1};
  panel.y = {"F, N", -1, 1};
  panel.curves.push_back({{0, 0.5, 0.6, 1}, {0, NAN, INFINITY, 1e30}, 2, Stroke::dashed});
  panel.marks.push_back({0.5, "here", 1});
  const std::string svg =
      svg_of({"title", {panel, panel}, 2, {{"A", 2}, {"B", -1, Stroke::dotted}}});
  EXPECT_EQ(count(svg, "<path"), 2U);
  EXPECT_EQ(count(svg, "<clipPath"), 2U);
  EXPECT_EQ(count(svg, "a &lt; b &amp; c"), 2U);
  EXPECT_EQ(count(svg, ">here<"), 2U);
  EXPECT_EQ(count(svg, "nan"), 0U);
  EXPECT_EQ(count(svg, "inf"), 0U);
  EXPECT_EQ(count(svg, "1e30"), 0U);
  EXPECT_EQ(count(svg, "<text"), count(svg, "</text>"));
  EXPECT_EQ(count(svg, "<tspan"), count(svg, "</tspan>"));
  // A point that is no number interrupts its curve: two strokes of the pen.
  EXPECT_EQ(count(svg.substr(svg.find("<path"),
                             svg.find("fill=\"none\" stroke=\"#009e73\"") - svg.find("<path")),
                  " M"),
            2U);
}

}  // namespace solidem::svg_plot_test
