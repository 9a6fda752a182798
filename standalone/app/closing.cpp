// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/closing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/colours.hpp"
#include "app/with_prefix.hpp"
#include "output/progress.hpp"
#include "output/svg_plot.hpp"

namespace solidem {

namespace {

constexpr std::size_t most_columns = 4;  // that a line names
constexpr int digits = 4;

std::optional<double> value_of(const HistoryRow& row, const std::string& column) {
  for (const auto& [name, value] : row.values)
    if (name == column) return value;
  return std::nullopt;
}

std::string gauge_line(const RunOutcome& outcome) {
  const std::optional<double> peak = value_of(outcome.peak, "gauge.stress"),
                              strain = value_of(outcome.peak, "gauge.strain"),
                              last = value_of(outcome.last, "gauge.stress");
  if (!peak || !last) return "";
  std::string line = "peak stress " + with_prefix(*peak, "Pa", digits);
  if (strain) line += fmt::format(" at a strain of {:.4g}", *strain);
  return line +
         (*last == *peak ? ", at the end" : ", at the end " + with_prefix(*last, "Pa", digits));
}

/// Without a gauge, what grips and sensors showed last.
std::string last_line(const HistoryRow& last) {
  std::string line;
  std::size_t named = 0;
  const auto ends_with = [](const std::string& name, const std::string& end) {
    return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
  };
  for (const auto& [name, value] : last.values) {
    const bool is_sensor = name.rfind("sensor.", 0) == 0;
    const bool is_force = name.rfind("grip.", 0) == 0 && name.find(".force_") != std::string::npos;
    if ((!is_sensor && !is_force) || value == 0 || named == most_columns) continue;
    ++named;
    const char* const unit = is_force                                      ? "N"
                             : ends_with(name, "temperature")              ? "K"
                             : name.find(".velocity") != std::string::npos ? "m/s"
                                                                           : "m";
    line += (line.empty() ? "at the end " : ", ") + name + " " +
            (ends_with(name, "temperature") ? fmt::format("{:.5g} K", value)
                                            : with_prefix(value, unit, digits));
  }
  return line;
}

std::string broken_line(const Simulation& simulation) {
  nlohmann::ordered_json figures;
  for (const auto& effect : simulation.effects()) effect->summarise(simulation.model(), figures);
  if (!figures.contains("bonds_broken")) return "";
  return fmt::format("{} bonds broken, {} left", figures["bonds_broken"].get<std::size_t>(),
                     simulation.model().slots().bonds());
}

std::string files_line(const Simulation& simulation, const std::string& directory) {
  const bool has_frames = simulation.setup().output.frames > 0;
  return fmt::format("look at {0}/history.csv and {0}/summary.json{1}", directory,
                     has_frames ? fmt::format("; paraview {}/trajectory.xdmf", directory) : "");
}

}  // namespace

std::string closing_lines(const Simulation& simulation, const RunOutcome& outcome,
                          const std::string& directory, double seconds) {
  std::string lines =
      with_look(
          Look::result,
          fmt::format("done: {} simulated, {} steps in {}",
                      with_prefix(simulation.time(), "s", digits), simulation.step(),
                      seconds < 10 ? fmt::format("{:.2g} s", seconds) : duration_text(seconds)),
          stdout) +
      "\n";
  const std::string gauge = gauge_line(outcome);
  for (const std::string& line : {gauge.empty() ? last_line(outcome.last) : gauge,
                                  broken_line(simulation), files_line(simulation, directory)})
    if (!line.empty()) lines += line + "\n";
  return lines;
}

}  // namespace solidem
