// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/law_curve.hpp"
#include "app/law_words.hpp"
#include "app/print_json.hpp"
#include "app/say.hpp"
#include "app/with_prefix.hpp"
#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/replace_file.hpp"
#include "output/results_folder.hpp"
#include "output/svg_plot.hpp"

namespace solidem {

namespace {

constexpr int samples = 1201;       // of a table
constexpr int drawn_samples = 401;  // of a curve

/// What the panels are scaled by: the largest of all laws.
struct Scale {
  double attraction = 0, stiffness = 0, well = 0;
};

Scale scale_of(const std::vector<ShownLaw>& laws) {
  Scale scale;
  for (const ShownLaw& law : laws) {
    const LawFigures figures = figures_of(law);
    scale.attraction = std::max(scale.attraction, figures.attraction);
    scale.stiffness = std::max(scale.stiffness, figures.stiffness);
    scale.well = std::max(scale.well, figures.well);
  }
  return scale;
}

/// Curves of one figure, one for each part of a law that follows another; the continuation dashed.
template <class Figure>
void add_curves(PlotPanel& panel, const std::vector<LawPoint>& points, double equilibrium,
                int colour, double unit, const Figure& figure) {
  const LawPoint* before = nullptr;
  for (const LawPoint& point : points) {
    if (before == nullptr || before->part != point.part)
      panel.curves.push_back(
          {{}, {}, colour, point.part == LawPart::continuation ? Stroke::dashed : Stroke::solid});
    panel.curves.back().x.push_back(point.distance / equilibrium);
    panel.curves.back().y.push_back(figure(point) / unit);
    before = &point;
  }
}

void add_marks(PlotPanel& panel, const std::vector<ShownLaw>& laws) {
  panel.marks.push_back({1, "δ_eq"});
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const bool is_common = std::all_of(laws.begin(), laws.end(), [&](const ShownLaw& other) {
      return other.range == laws[k].range;
    });
    panel.marks.push_back({laws[k].range, "δ_lim", is_common ? -1 : static_cast<int>(k)});
    panel.marks.push_back({1 - laws[k].interpenetration, "δ_min", -1});
  }
}

/// A window of a figure: all that is there, but no more than `lower` below and `upper` above zero.
PlotAxis window(const PlotPanel& panel, const std::string& label, double lower, double upper) {
  double low = 0, high = 0;
  for (const PlotCurve& curve : panel.curves)
    for (const double y : curve.y)
      if (std::isfinite(y)) low = std::min(low, y), high = std::max(high, y);
  PlotAxis axis{label, std::max(low, -lower), std::min(high, upper)};
  if (!(axis.high > axis.low)) axis.high = axis.low + 1;
  const double margin = 0.06 * (axis.high - axis.low);
  axis.low -= axis.low < 0 ? margin : 0;
  axis.high += margin;
  return axis;
}

Plot plot_of(const std::vector<ShownLaw>& laws, double from, double to) {
  const Scale scale = scale_of(laws);
  const UnitPrefix newton = unit_prefix(scale.attraction), joule = unit_prefix(scale.well),
                   stiff = unit_prefix(scale.stiffness);
  Plot plot;
  PlotPanel force, stiffness, potential, overlap;
  force.title = "Force, above 0 it pushes apart";
  stiffness.title = "Stiffness −dF/dδ";
  potential.title = "Potential, from the range";
  overlap.title = "Force when they overlap";
  double deepest = 0;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const ShownLaw& law = laws[k];
    const int colour = static_cast<int>(k);
    const double size = law.equilibrium;
    const std::vector<LawPoint> points = sample(law, from, to, drawn_samples);
    const auto add = [&](PlotPanel& panel, double unit, const auto& figure) {
      add_curves(panel, points, size, colour, unit, figure);
    };
    add(force, newton.factor, [](const LawPoint& p) { return p.force; });
    add(stiffness, stiff.factor, [](const LawPoint& p) { return p.stiffness; });
    add(potential, joule.factor, [](const LawPoint& p) { return p.potential; });
    add_curves(overlap, sample(law, 0, 0.9999, drawn_samples), size, colour, newton.factor,
               [](const LawPoint& p) { return p.force; });
    const LawFigures figures = figures_of(law);
    deepest = std::max(deepest, law_at(law, 0).force);
    force.dots.push_back(
        {figures.attraction_distance / size, -figures.attraction / newton.factor, colour});
    const UnitPrefix metre = unit_prefix(size);
    plot.legend.push_back({fmt::format("{}   (δ_eq {:.4g} {}m, δ_lim {:.4g} δ_eq)", law.label,
                                       size / metre.factor, metre.symbol, law.range),
                           colour});
  }
  const std::string axis = "distance δ / δ_eq";
  for (PlotPanel* panel : {&force, &stiffness, &potential}) {
    panel->x = {axis, from, to};
    add_marks(*panel, laws);
  }
  overlap.x = {axis, 0, 1};
  for (const ShownLaw& law : laws) overlap.marks.push_back({1 - law.interpenetration, "δ_min"});
  const double attraction = scale.attraction / newton.factor;
  force.y = window(force, fmt::format("F, {}N", newton.symbol), 2 * attraction, 2.5 * attraction);
  const double slope = scale.stiffness / stiff.factor;
  stiffness.y = window(stiffness, fmt::format("K, {}N/m", stiff.symbol), 2 * slope, 4 * slope);
  const double well = scale.well / joule.factor;
  potential.y = window(potential, fmt::format("Φ, {}J", joule.symbol), 2 * well, 1.5 * well);
  overlap.y = {fmt::format("F, {}N", newton.symbol), 0.1 * attraction,
               1.5 * std::max(deepest / newton.factor, attraction), true};
  plot.legend.push_back({"below δ_min: the law goes on along its tangent", -1, Stroke::dashed});
  plot.legend.push_back({"largest attraction", -1, Stroke::solid, true});
  plot.title = "Central force between two elements";
  plot.panels = {force, stiffness, potential, overlap};
  return plot;
}

/// A field of a CSV file.
std::string quoted(const std::string& text) {
  std::string safe = "\"";
  for (const char c : text) safe += c == '"' ? std::string("\"\"") : std::string(1, c);
  return safe + "\"";
}

std::string table_of(const std::vector<ShownLaw>& laws, double from, double to) {
  std::string text =
      "law,distance_m,distance_over_equilibrium,force_N,stiffness_N_per_m,potential_J,part\n";
  for (const ShownLaw& law : laws)
    for (const LawPoint& p : sample(law, from, to, samples))
      text += fmt::format("{},{},{},{},{},{},{}\n", quoted(law.label), p.distance,
                          p.distance / law.equilibrium, p.force, p.stiffness, p.potential,
                          name_of(p.part));
  return text;
}

void print_figures(const ShownLaw& law) {
  const LawFigures figures = figures_of(law);
  say("{}\n", law.label);
  say("  equilibrium at {}, well {} deep, stiffness there {}\n", with_prefix(law.equilibrium, "m"),
      with_prefix(figures.well, "J"), with_prefix(figures.stiffness, "N/m"));
  say("  largest attraction {} at {:.6g} of it; {} where the range ends, at {:.4g}\n",
      with_prefix(figures.attraction, "N"), figures.attraction_distance / law.equilibrium,
      with_prefix(std::abs(figures.end_force), "N"), law.range);
  say("  overlapping by {:.3g} %: {}, {:.4g} times as stiff; steps {:.3g} times as long\n",
      100 * law.interpenetration, with_prefix(figures.deepest_force, "N"),
      figures.deepest_stiffness / figures.stiffness,
      std::sqrt(figures.stiffness / figures.deepest_stiffness));
}

nlohmann::ordered_json json_of(const std::vector<ShownLaw>& laws, const std::string& output) {
  nlohmann::ordered_json json = {{"files", {output + ".csv", output + ".svg"}},
                                 {"laws", nlohmann::ordered_json::array()}};
  for (const ShownLaw& law : laws) {
    const LawFigures figures = figures_of(law);
    json["laws"].push_back({{"label", law.label},
                            {"equilibrium", law.equilibrium},
                            {"range", law.range},
                            {"interpenetration", law.interpenetration},
                            {"well", figures.well},
                            {"stiffness", figures.stiffness},
                            {"attraction", figures.attraction},
                            {"attraction_distance", figures.attraction_distance},
                            {"end_force", figures.end_force},
                            {"deepest_force", figures.deepest_force},
                            {"deepest_stiffness", figures.deepest_stiffness}});
  }
  return json;
}

}  // namespace

void list_laws(bool json) {
  if (json) return print_json(json_of_laws());
  say("{}", list_of_laws());
}

void plot_laws(const LawPlotCommand& command) {
  const std::vector<ShownLaw> laws = laws_from_words(
      command.words, {command.equilibrium, command.range, command.interpenetration});
  double from = 1, to = 1;
  for (const ShownLaw& law : laws) {
    from = std::min(from, std::max(0.0, 1 - 1.3 * law.interpenetration));
    to = std::max(to, 1 + 1.25 * (law.range - 1));
  }
  if (command.from >= 0) from = command.from;
  if (command.to >= 0) to = command.to;
  if (!(from < to))
    throw InputError(
        fmt::format("--from {:g} --to {:g}: nothing lies between them; expected "
                    "distances over that of equilibrium, such as --from 0.7 --to 1.5",
                    from, to));
  for (const char* ending : {".csv", ".svg"})
    insist_on_new_file(command.output + ending, command.overwrite);
  const std::filesystem::path folder = std::filesystem::path(command.output).parent_path();
  if (!folder.empty()) prepare_directory(folder.string());
  replace_text_file(command.output + ".csv", table_of(laws, from, to));
  replace_text_file(command.output + ".svg", svg_of(plot_of(laws, from, to)));
  if (command.json) return print_json(json_of(laws, command.output));
  for (const ShownLaw& law : laws) print_figures(law);
  say("{0}.csv, {0}.svg\n", command.output);
}

}  // namespace solidem
