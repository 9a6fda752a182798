// SPDX-License-Identifier: GPL-2.0-or-later
#include "neighbours/neighbourhood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "model/blocks.hpp"
#include "model/error.hpp"
#include "neighbours/linked_cells.hpp"

namespace solidem {

namespace {

/// Whether cells as wide as the reach are few enough to lay them all out.
bool is_dense(const CellBox& box, double reach, std::size_t elements) {
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis)
    cells *= std::max(1.0, component(box.upper - box.lower, axis) / reach);
  return cells < 4.0 * static_cast<double>(elements);
}

/// The box of the cells: the periods, and elsewhere where the elements stand.
CellBox box_around(const Domain& domain, const std::vector<Vector>& position) {
  CellBox box{domain.lower, domain.upper, domain.periodic};
  for (int axis = 0; axis < 3; ++axis) {
    if (domain.periodic[static_cast<std::size_t>(axis)]) continue;
    const auto before = [axis](const Vector& a, const Vector& b) {
      return component(a, axis) < component(b, axis);
    };
    const auto [low, high] = std::minmax_element(position.begin(), position.end(), before);
    component(box.lower, axis) = component(*low, axis);
    component(box.upper, axis) = component(*high, axis);
  }
  return box;
}

/// Moves fragments that have flown apart together again: slabs across an axis that hold no element
/// are narrowed to twice the reach. Who is within reach stays so, and nobody comes to be.
void fold(const Domain& domain, double reach, std::vector<Vector>& position) {
  std::vector<std::pair<double, std::size_t>> positions(position.size());
  for (int axis = 0; axis < 3; ++axis) {
    if (domain.periodic[static_cast<std::size_t>(axis)]) continue;
    for (std::size_t i = 0; i < positions.size(); ++i)
      positions[i] = {component(position[i], axis), i};
    std::sort(positions.begin(), positions.end());
    double removed = 0;
    for (std::size_t k = 1; k < positions.size(); ++k) {
      const double gap = positions[k].first - positions[k - 1].first;
      if (gap > 2 * reach) removed += gap - 2 * reach;
      component(position[positions[k].second], axis) -= removed;
    }
  }
}

/// The box without the few outermost elements, which count to the outermost cells then: cells stay
/// small where most are.
void leave_out_a_few(const std::vector<Vector>& position, CellBox& box) {
  std::vector<double> place(position.size());
  const auto cut = static_cast<std::ptrdiff_t>(position.size() / 200);
  for (int axis = 0; axis < 3; ++axis) {
    if (box.periodic[static_cast<std::size_t>(axis)]) continue;
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = component(position[i], axis);
    std::nth_element(place.begin(), place.begin() + cut, place.end());
    component(box.lower, axis) = place[static_cast<std::size_t>(cut)];
    std::nth_element(place.begin(), place.end() - 1 - cut, place.end());
    component(box.upper, axis) = *(place.end() - 1 - cut);
  }
}

/// The elements in cells.
LinkedCells sorted_into_cells(const Domain& domain, const std::vector<Vector>& position,
                              double reach) {
  CellBox box = box_around(domain, position);
  const bool dense = is_dense(box, reach, position.size());
  std::vector<Vector> folded;
  if (!dense) {
    folded = position;
    fold(domain, reach, folded);
    box = box_around(domain, folded);
    if (!is_dense(box, reach, folded.size())) leave_out_a_few(folded, box);
  }
  LinkedCells cells(box, reach, position.size());
  cells.sort(dense ? position : folded);
  return cells;
}

/// A neighbour and its image in one number, by which they are sorted.
using Found = std::uint64_t;

Found found_of(std::int32_t neighbour, Image image) {
  return static_cast<Found>(neighbour) << 32 | image.code();
}

/// The neighbours of some elements, one after the other.
struct Run {
  std::vector<std::pair<std::int32_t, std::uint32_t>> elements;  ///< with the number of theirs
  std::vector<Found> found;
};

/// All elements, and images of elements, that may be neighbours of those in one cell.
struct Candidates {
  std::vector<LinkedCells::Range> ranges;
  std::vector<double> x, y, z, reach;  ///< reach: factor R_j + margin
  std::vector<std::int32_t> element;
  std::vector<std::array<int, 3>> image;  ///< where something is periodic
  std::vector<std::uint32_t> near;        ///< room for the numbers of those that are

  void gather(const LinkedCells& cells, std::size_t cell, const std::vector<double>& radius,
              double factor, double margin, bool periodic) {
    cells.find_ranges_around(cell, ranges);
    std::size_t count = 0;
    for (const LinkedCells::Range& range : ranges) count += range.last - range.first;
    const std::size_t room = count + 8;
    if (room > x.size())
      for (auto* column : {&x, &y, &z, &reach}) column->resize(room);
    element.resize(count);
    near.resize(room);
    if (periodic) image.resize(count);
    std::size_t to = 0;
    for (const LinkedCells::Range& range : ranges) {
      const Vector& extent = cells.extent();
      const Vector shift{range.periods[0] * extent.x, range.periods[1] * extent.y,
                         range.periods[2] * extent.z};
      for (std::size_t k = range.first; k < range.last; ++k, ++to) {
        const LinkedCells::Resident& resident = cells.resident(k);
        x[to] = resident.position.x + shift.x;
        y[to] = resident.position.y + shift.y;
        z[to] = resident.position.z + shift.z;
        reach[to] = factor * radius[static_cast<std::size_t>(resident.element)] + margin;
        element[to] = resident.element;
        if (periodic) image[to] = range.periods;
      }
    }
    constexpr double nowhere = 1e200;
    std::fill(x.begin() + static_cast<std::ptrdiff_t>(count),
              x.begin() + static_cast<std::ptrdiff_t>(room), nowhere);
  }

  NearPositions positions() const {
    return {x.data(), y.data(), z.data(), reach.data(), element.size()};
  }
};

/// Periods by which an element stands away from its image in the box.
std::array<int, 3> periods_away(const Domain& domain, const Vector& position) {
  std::array<int, 3> periods{};
  for (int axis = 0; axis < 3; ++axis)
    if (domain.periodic[static_cast<std::size_t>(axis)])
      periods[static_cast<std::size_t>(axis)] =
          static_cast<int>(std::floor((component(position, axis) - component(domain.lower, axis)) /
                                      component(domain.upper - domain.lower, axis)));
  return periods;
}

}  // namespace

std::size_t pick_near_positions(const NearPositions& positions, double x, double y, double z,
                                double reach, std::uint32_t* near) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < positions.count; ++k) {
    const double dx = positions.x[k] - x, dy = positions.y[k] - y, dz = positions.z[k] - z;
    const double limit = positions.reach[k] + reach;
    // Without a branch, which would be mistaken for one in ten.
    near[count] = static_cast<std::uint32_t>(k);
    count += dx * dx + dy * dy + dz * dz <= limit * limit ? 1 : 0;
  }
  return count;
}

Vector image_shift(const Domain& domain, Image image) {
  Vector shift{};
  for (int axis = 0; axis < 3; ++axis)
    if (domain.periodic[static_cast<std::size_t>(axis)])
      component(shift, axis) = image.periods(axis) * component(domain.upper - domain.lower, axis);
  return shift;
}

namespace {

/// Images are told apart up to so many periods; more is no body any more.
void insist_on_few_periods(const Domain& domain, const std::vector<Vector>& position) {
  std::array<int, 3> low{}, high{};
  for (std::size_t i = 0; i < position.size(); ++i) {
    const std::array<int, 3> away = periods_away(domain, position[i]);
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = i == 0 ? away[a] : std::min(low[a], away[a]);
      high[a] = i == 0 ? away[a] : std::max(high[a], away[a]);
    }
  }
  for (std::size_t a = 0; a < 3; ++a)
    if (high[a] - low[a] > Image::most_periods - 100)
      throw RunError(std::string("elements have drifted ") + std::to_string(high[a] - low[a]) +
                     " periods apart along " + "xyz"[a] + "; at most " +
                     std::to_string(Image::most_periods - 100) + " are told apart");
}

}  // namespace

Neighbourhood find_neighbours(const Domain& domain, const std::vector<Vector>& position,
                              const std::vector<double>& radius, double factor, double margin,
                              const std::vector<char>& absent, PickNear pick) {
  Neighbourhood result;
  const std::size_t count = position.size();
  result.first.assign(count + 1, 0);
  if (count == 0) return result;
  const bool periodic = domain.is_periodic();
  if (periodic) insist_on_few_periods(domain, position);
  const double largest = *std::max_element(radius.begin(), radius.end());
  const double reach = 1.004 * (2 * factor * largest + margin);
  const LinkedCells cells = sorted_into_cells(domain, position, reach);

  const std::size_t cell_count = cells.cell_count();
  const std::size_t parts = std::min<std::size_t>(cell_count, 64);
  std::vector<Run> runs(parts);
  for_each_part(parts, count > 5000, [&](std::size_t part) {
    Run& run = runs[part];
    const std::size_t per_part = cell_count / parts, rest = cell_count % parts;
    const std::size_t begin = per_part * part + std::min(rest, part);
    const std::size_t end = begin + per_part + (part < rest ? 1 : 0);
    Candidates candidates;
    for (std::size_t cell = begin; cell < end; ++cell) {
      if (cells.first_of(cell) == cells.first_of(cell + 1)) continue;
      candidates.gather(cells, cell, radius, factor, margin, periodic);
      const NearPositions positions = candidates.positions();
      for (std::size_t r = cells.first_of(cell); r < cells.first_of(cell + 1); ++r) {
        const LinkedCells::Resident& own = cells.resident(r);
        const auto i = static_cast<std::size_t>(own.element);
        if (!absent.empty() && absent[i] != 0) continue;
        const std::size_t near = pick(positions, own.position.x, own.position.y, own.position.z,
                                      factor * radius[i], candidates.near.data());
        const std::array<int, 3> away =
            periodic ? periods_away(domain, position[i]) : std::array<int, 3>{};
        const std::size_t began = run.found.size();
        for (std::size_t k = 0; k < near; ++k) {
          const std::size_t c = candidates.near[k];
          const auto j = static_cast<std::size_t>(candidates.element[c]);
          if (j == i || (!absent.empty() && absent[j] != 0)) continue;
          Image image;
          if (periodic) {
            const std::array<int, 3> there = periods_away(domain, position[j]);
            const std::array<int, 3>& moved = candidates.image[c];
            image = Image(moved[0] - there[0] + away[0], moved[1] - there[1] + away[1],
                          moved[2] - there[2] + away[2]);
          }
          run.found.push_back(found_of(candidates.element[c], image));
        }
        if (run.found.size() == began) continue;
        std::sort(run.found.begin() + static_cast<std::ptrdiff_t>(began), run.found.end());
        run.elements.emplace_back(own.element,
                                  static_cast<std::uint32_t>(run.found.size() - began));
      }
    }
  });

  for (const Run& run : runs)
    for (const auto& [element, number] : run.elements)
      result.first[static_cast<std::size_t>(element) + 1] = number;
  for (std::size_t i = 0; i < count; ++i) result.first[i + 1] += result.first[i];
  result.neighbour.resize(result.first.back());
  if (periodic) result.image.resize(result.first.back());
  for_each_part(parts, count > 5000, [&](std::size_t part) {
    const Run& run = runs[part];
    std::size_t from = 0;
    for (const auto& entry : run.elements) {
      std::size_t to = result.first[static_cast<std::size_t>(entry.first)];
      for (std::uint32_t k = 0; k < entry.second; ++k, ++from, ++to) {
        result.neighbour[to] = static_cast<std::int32_t>(run.found[from] >> 32);
        if (periodic)
          result.image[to] = Image::of_code(static_cast<std::uint32_t>(run.found[from]));
      }
    }
  });
  return result;
}

}  // namespace solidem
