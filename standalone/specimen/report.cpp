// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "neighbours/linked_cells.hpp"
#include "specimen/bonds.hpp"
#include "specimen/walls.hpp"

namespace solidem {

namespace {

constexpr double counted_overlap = 0.005;

double distance_to_walls(const std::vector<Wall>& walls, const Vector& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) nearest = std::min(nearest, wall.distance(point));
  return nearest;
}

}  // namespace

void measure_specimen(Specimen& specimen) {
  auto& report = specimen.report;
  const auto elements = static_cast<double>(specimen.size());
  const auto bonds = static_cast<double>(specimen.bonds.size());
  const double mean = mean_radius(specimen);
  report["mean_radius"] = mean;
  report["solid_fraction"] = sphere_volume(specimen) / specimen.domain.volume;
  report["coordination_number"] = 2.0 * bonds / elements;

  const std::vector<std::int32_t> degree = count_bonds(specimen);
  const std::vector<Wall> walls = walls_of(specimen.domain);
  double bulk_elements = 0, bulk_bonds = 0;
  const bool walls_are_known = specimen.domain.has_walls();
  for (std::size_t i = 0; i < specimen.size() && walls_are_known; ++i)
    if (distance_to_walls(walls, specimen.position[i]) > 3.0 * mean) {
      bulk_elements += 1;
      bulk_bonds += degree[i];
    }
  report["bulk_elements"] = bulk_elements;
  report["bulk_coordination_number"] = bulk_elements > 0 ? bulk_bonds / bulk_elements : 0;

  Vector fabric{};
  double overlap_sum = 0, overlap_max = 0, overlapping = 0, ejecting = 0;
  for (const Pair& pair : specimen.bonds) {
    const Vector chord = rest_chord(specimen, pair);
    const double d2 = dot(chord, chord);
    if (d2 > 0)
      fabric += Vector{chord.x * chord.x / d2, chord.y * chord.y / d2, chord.z * chord.z / d2};
    const double overlap =
        1.0 - std::sqrt(d2) / (specimen.radius[pair.i] + specimen.radius[pair.j]);
    if (overlap > 0) {
      overlapping += 1;
      overlap_sum += overlap;
      overlap_max = std::max(overlap_max, overlap);
    }
    if (overlap > counted_overlap) ejecting += 1;
  }
  const double fraction = bonds > 0 ? 1.0 / bonds : 0.0;
  report["fabric_x"] = fraction * fabric.x;
  report["fabric_y"] = fraction * fabric.y;
  report["fabric_z"] = fraction * fabric.z;
  report["mean_overlap"] = overlapping > 0 ? overlap_sum / overlapping : 0;
  report["max_overlap"] = overlap_max;
  report["overlap_fraction"] = fraction * ejecting;
  report["rattlers"] = static_cast<double>(std::count(degree.begin(), degree.end(), 0));
  report["largest_component"] = static_cast<double>(largest_component(specimen).size());

  const std::vector<double> mass = represented_mass(specimen, {1.0});
  report["mass_error"] =
      std::accumulate(mass.begin(), mass.end(), 0.0) / specimen.domain.volume - 1.0;
}

std::string format_report(const Specimen& specimen) {
  const Domain& domain = specimen.domain;
  const auto figure = [&](const char* name) {
    const auto found = specimen.report.find(name);
    return found == specimen.report.end() ? std::nan("") : found->second;
  };
  const Vector extent = domain.upper - domain.lower;
  std::string periodic;
  for (int axis = 0; axis < 3; ++axis)
    if (domain.periodic[axis]) periodic += std::string(periodic.empty() ? "" : ", ") + "xyz"[axis];

  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("{:<28}{}\n", name, value);
  };
  std::string shape = domain.shape;
  if (domain.cuts > 0) shape += fmt::format(", {} taken out of it", domain.cuts);
  line("shape", shape + (periodic.empty() ? "" : " (periodic along " + periodic + ")"));
  line("extent", fmt::format("{:.6g} x {:.6g} x {:.6g} m", extent.x, extent.y, extent.z));
  line("volume", fmt::format("{:.9g} m3{}", domain.volume,
                             specimen.report.count(estimated_volume) != 0
                                 ? " (of the cells, cut at the spheres)"
                                 : ""));
  line("elements", fmt::format("{}", specimen.size()));
  for (const Body& body : specimen.bodies)
    line(("  of " + body.name).c_str(),
         fmt::format("{}, a {} of {:.9g} m3", body.elements.size(), body.shape, body.volume));
  line("mean radius", fmt::format("{:.6g} m", figure("mean_radius")));
  line("solid fraction", fmt::format("{:.4f}", figure("solid_fraction")));
  line("bonds",
       specimen.bond_tolerance > -1
           ? fmt::format("{} (tolerance {})", specimen.bonds.size(), specimen.bond_tolerance)
           : fmt::format("{}", specimen.bonds.size()));
  line("coordination number", fmt::format("{:.3f}", figure("coordination_number")));
  line("  in the bulk",
       figure("bulk_elements") > 0
           ? fmt::format("{:.3f} ({:.0f} elements over 3 mean radii from walls)",
                         figure("bulk_coordination_number"), figure("bulk_elements"))
       : !domain.has_walls() ? "the body's walls are not known"
                             : "no element is over 3 mean radii from all walls");
  if (specimen.contact_margin > 1e-12)
    line("touch within", fmt::format("{:.2g} of their distance, for the digits of the file",
                                     specimen.contact_margin));
  line("fabric tensor, diagonal", fmt::format("{:.4f} {:.4f} {:.4f}", figure("fabric_x"),
                                              figure("fabric_y"), figure("fabric_z")));
  line("overlap of bonds",
       fmt::format("mean {:.3g} %, largest {:.3g} %, above 0.5 %: {:.3g} % of bonds",
                   100 * figure("mean_overlap"), 100 * figure("max_overlap"),
                   100 * figure("overlap_fraction")));
  line("elements without bonds",
       fmt::format("{:.0f} ({:.2f} %)", figure("rattlers"),
                   100 * figure("rattlers") / static_cast<double>(specimen.size())));
  line("largest bonded body", fmt::format("{:.0f} elements", figure("largest_component")));
  line("represented mass",
       fmt::format("density x volume, relative error {:.1e}", figure("mass_error")));
  return text;
}

}  // namespace solidem
