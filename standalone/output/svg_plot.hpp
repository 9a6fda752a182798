// SPDX-License-Identifier: GPL-2.0-or-later
//
// Line plots as SVG: panels with axes, ticks and a grid, one legend for all of them.
#ifndef SOLIDEM_OUTPUT_SVG_PLOT_HPP
#define SOLIDEM_OUTPUT_SVG_PLOT_HPP

#include <string>
#include <vector>

namespace solidem {

enum class Stroke { solid, dashed, dotted };

/// Points joined by lines, in a colour of the palette (any number; colours repeat after eight).
struct PlotCurve {
  std::vector<double> x, y;
  int colour = 0;
  Stroke stroke = Stroke::solid;
};

/// A dot.
struct PlotDot {
  double x = 0, y = 0;
  int colour = 0;
};

/// A line across the panel at an x, with a word at its head.
struct PlotMark {
  double x = 0;
  std::string word;
  int colour = -1;  ///< −1: grey
};

/// What is shown of one axis.
struct PlotAxis {
  std::string label;  ///< with its unit
  double low = 0, high = 1;
  bool logarithmic = false;  ///< then both ends are above 0
};

/// Curves leave a panel at its edges.
struct PlotPanel {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotCurve> curves;
  std::vector<PlotDot> dots;
  std::vector<PlotMark> marks;
};

/// A line of the legend.
struct LegendLine {
  std::string text;
  int colour = 0;  ///< −1: black
  Stroke stroke = Stroke::solid;
  bool is_dot = false;
};

struct Plot {
  std::string title;
  std::vector<PlotPanel> panels;  ///< filled row by row
  int columns = 2;
  std::vector<LegendLine> legend;
};

/// The picture as the text of an SVG file. Points that are not finite interrupt their curve.
std::string svg_of(const Plot& plot);

/// Round numbers from `low` to `high`, about `wanted` of them: steps of 1, 2 or 5 times a power of
/// ten; on a logarithmic axis powers of ten.
std::vector<double> ticks(const PlotAxis& axis, int wanted);

/// A prefix of a unit with which figures up to `largest` read well.
struct UnitPrefix {
  const char* symbol;  ///< "m", "µ", "", "k" ...
  double factor;       ///< 1e-3, 1e-6, 1, 1e3 ...
};
UnitPrefix unit_prefix(double largest);

}  // namespace solidem

#endif
