// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace solidem {

namespace {

// Sizes in pixels.
constexpr double panel_width = 420, panel_height = 290;
constexpr double left = 78, right = 18, above = 34, below = 52;  // of a panel's frame
constexpr double head = 40, legend_line = 20;

// Told apart by people who see red and green alike (Okabe and Ito), darkest first.
constexpr const char* palette[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                   "#e69f00", "#56b4e9", "#000000", "#999933"};

const char* colour_of(int number, const char* none) {
  return number < 0 ? none : palette[number % 8];
}

const char* dashes_of(Stroke stroke) {
  switch (stroke) {
    case Stroke::dashed:
      return " stroke-dasharray=\"7 4\"";
    case Stroke::dotted:
      return " stroke-dasharray=\"1.5 3.5\"";
    case Stroke::solid:
      break;
  }
  return "";
}

/// Text as SVG has it. Letters after a Greek letter and an underscore ("δ_eq") are its index.
std::string escaped(const std::string& text) {
  const auto is_letter = [&](std::size_t k) {
    return k < text.size() && std::isalpha(static_cast<unsigned char>(text[k])) != 0;
  };
  std::string safe;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    const bool after_greek = k > 0 && static_cast<unsigned char>(text[k - 1]) >= 0x80;
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '_' && after_greek && is_letter(k + 1)) {
      safe += "<tspan dy=\"3\" font-size=\"75%\">";
      for (; is_letter(k + 1); ++k) safe += text[k + 1];
      safe += "</tspan><tspan dy=\"-3\">\u200b</tspan>";  // back up, by a letter without width
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string words(double x, double y, const std::string& text, const char* anchor, int size = 12,
                  const std::string& more = "") {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\"{}>{}</text>\n", x, y,
      anchor, size, more, escaped(text));
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1,
                     x2, y2, style);
}

/// A panel's frame on the picture, and where its values are in it.
class PlotFrame {
 public:
  PlotFrame(const PlotPanel& panel, double x, double y)
      : panel_(panel), x_(x + left), y_(y + above) {}

  static constexpr double width = panel_width - left - right;
  static constexpr double height = panel_height - above - below;

  double x(double value) const { return x_ + width * fraction(panel_.x, value); }
  double y(double value) const { return y_ + height * (1 - fraction(panel_.y, value)); }

  std::string svg(int number) const {
    std::string text = axes();
    text += fmt::format(
        "<clipPath id=\"frame{}\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.1f}\"/></clipPath>\n<g clip-path=\"url(#frame{})\">\n",
        number, x_, y_, width, height, number);
    for (const PlotMark& mark : panel_.marks)
      text += line(
          x(mark.x), y_, x(mark.x), y_ + height,
          fmt::format("stroke=\"{}\" stroke-dasharray=\"4 3\"", colour_of(mark.colour, "#888888")));
    for (const PlotCurve& curve : panel_.curves) text += path(curve);
    for (const PlotDot& dot : panel_.dots)
      text += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\" stroke=\"white\"/>\n", x(dot.x),
          y(dot.y), colour_of(dot.colour, "#000000"));
    text += "</g>\n";
    return text + heads();
  }

 private:
  static double fraction(const PlotAxis& axis, double value) {
    if (axis.logarithmic)
      return std::log(std::max(value, 1e-300) / axis.low) / std::log(axis.high / axis.low);
    return (value - axis.low) / (axis.high - axis.low);
  }

  std::string axes() const {
    std::string text;
    for (const double tick : ticks(panel_.x, 7)) {
      text += line(x(tick), y_, x(tick), y_ + height, "stroke=\"#e4e4e4\"");
      text += words(x(tick), y_ + height + 17, fmt::format("{:g}", tick), "middle");
    }
    for (const double tick : ticks(panel_.y, 6)) {
      text += line(x_, y(tick), x_ + width, y(tick), "stroke=\"#e4e4e4\"");
      text += words(x_ - 7, y(tick) + 4, fmt::format("{:g}", tick), "end");
    }
    if (!panel_.y.logarithmic && panel_.y.low < 0 && panel_.y.high > 0)
      text += line(x_, y(0), x_ + width, y(0), "stroke=\"#777777\"");
    text += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"#333333\"/>\n",
        x_, y_, width, height);
    text += words(x_ + width / 2, y_ + height + 39, panel_.x.label, "middle", 13);
    const double side = x_ - left + 16, middle = y_ + height / 2;
    text += words(side, middle, panel_.y.label, "middle", 13,
                  fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", side, middle));
    return text + words(x_, y_ - 18, panel_.title, "start", 14, " font-weight=\"bold\"");
  }

  /// The words over the marks, at most one at a place.
  std::string heads() const {
    std::string text;
    std::vector<double> taken;
    for (const PlotMark& mark : panel_.marks) {
      const double at = x(mark.x);
      const bool is_free = std::none_of(taken.begin(), taken.end(),
                                        [&](double other) { return std::abs(at - other) < 3; });
      if (at < x_ - 1 || at > x_ + width + 1 || mark.word.empty() || !is_free) continue;
      taken.push_back(at);
      text += words(at, y_ - 4, mark.word, "middle", 12,
                    fmt::format(" fill=\"{}\"", colour_of(mark.colour, "#555555")));
    }
    return text;
  }

  std::string path(const PlotCurve& curve) const {
    std::string data;
    bool is_drawing = false;
    for (std::size_t k = 0; k < std::min(curve.x.size(), curve.y.size()); ++k) {
      if (!std::isfinite(curve.x[k]) || !std::isfinite(curve.y[k])) {
        is_drawing = false;
        continue;
      }
      // Far outside the frame, viewers lose precision; what is clipped need not be exact.
      const double at_y = std::clamp(y(curve.y[k]), y_ - 10 * height, y_ + 11 * height);
      data += fmt::format("{}{:.2f} {:.2f}", is_drawing ? " L" : " M", x(curve.x[k]), at_y);
      is_drawing = true;
    }
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
        "stroke-linejoin=\"round\"{}/>\n",
        data, colour_of(curve.colour, "#000000"), dashes_of(curve.stroke));
  }

  const PlotPanel& panel_;
  double x_, y_;  // upper left corner
};

std::string legend_of(const Plot& plot, double y) {
  std::string text;
  for (const LegendLine& entry : plot.legend) {
    const std::string style =
        fmt::format("stroke=\"{}\" stroke-width=\"2\"{}", colour_of(entry.colour, "#000000"),
                    dashes_of(entry.stroke));
    if (entry.is_dot)
      text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", left + 17,
                          y, colour_of(entry.colour, "#000000"));
    else
      text += line(left, y, left + 34, y, style);
    text += words(left + 44, y + 4, entry.text, "start", 13);
    y += legend_line;
  }
  return text;
}

}  // namespace

std::vector<double> ticks(const PlotAxis& axis, int wanted) {
  std::vector<double> values;
  if (!(axis.high > axis.low)) return values;
  if (axis.logarithmic) {
    const int first = static_cast<int>(std::ceil(std::log10(axis.low) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(axis.high) + 1e-9));
    const int step = std::max(1, (last - first + wanted) / wanted);
    for (int power = first; power <= last; power += step) values.push_back(std::pow(10.0, power));
    return values;
  }
  const double rough = (axis.high - axis.low) / wanted;
  const double ten = std::pow(10.0, std::floor(std::log10(rough)));
  double step = ten;
  for (const double multiple : {1.0, 2.0, 5.0, 10.0}) {
    step = multiple * ten;
    if (step >= rough * 0.999) break;
  }
  const double first = std::ceil(axis.low / step - 1e-9);
  for (double k = first; k * step <= axis.high + 1e-9 * step; ++k)
    values.push_back(k == 0 ? 0.0 : k * step);
  return values;
}

UnitPrefix unit_prefix(double largest) {
  constexpr UnitPrefix prefixes[] = {{"p", 1e-12}, {"n", 1e-9}, {"µ", 1e-6}, {"m", 1e-3}, {"", 1},
                                     {"k", 1e3},   {"M", 1e6},  {"G", 1e9},  {"T", 1e12}};
  UnitPrefix best = prefixes[0];
  for (const UnitPrefix& prefix : prefixes)
    if (std::abs(largest) >= 0.999 * prefix.factor) best = prefix;
  return largest == 0 || !std::isfinite(largest) ? UnitPrefix{"", 1} : best;
}

std::string svg_of(const Plot& plot) {
  const int columns = std::max(1, plot.columns);
  const int rows = (static_cast<int>(plot.panels.size()) + columns - 1) / columns;
  const double width = columns * panel_width;
  const double foot = head + rows * panel_height;
  const double height = foot + legend_line * static_cast<double>(plot.legend.size()) + 16;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"DejaVu Sans, Arial, sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height);
  text += words(width / 2, 25, plot.title, "middle", 16);
  for (std::size_t k = 0; k < plot.panels.size(); ++k) {
    const int row = static_cast<int>(k) / columns, column = static_cast<int>(k) % columns;
    text += PlotFrame(plot.panels[k], column * panel_width, head + row * panel_height)
                .svg(static_cast<int>(k));
  }
  return text + legend_of(plot, foot + 8) + "</svg>\n";
}

}  // namespace solidem
