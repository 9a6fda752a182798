// SPDX-License-Identifier: GPL-2.0-or-later
#include "neighbours/linked_cells.hpp"

#include <algorithm>
#include <cmath>

#include "model/blocks.hpp"

namespace solidem {

LinkedCells::LinkedCells(const CellBox& box, double reach, std::size_t elements)
    : box_(box), reach_(reach), extent_(box.upper - box.lower) {
  if (!(reach > 0)) return;  // one cell holds all
  // About one element a cell is best; far more cells than elements would only cost memory.
  const double most_cells = 4.0 * static_cast<double>(elements) + 64.0;
  double size = reach;
  for (;; size *= 1.25) {
    double product = 1;
    std::array<double, 3> counts{};
    for (int axis = 0; axis < 3; ++axis) {
      const double count = std::floor(component(extent_, axis) / size);
      // With two cells around a period, each would be the other's neighbour on both sides.
      counts[axis] = count >= (box.periodic[axis] ? 3.0 : 1.0) ? count : 1.0;
      product *= counts[axis];
    }
    if (product > most_cells) continue;
    for (int axis = 0; axis < 3; ++axis) counts_[axis] = static_cast<std::size_t>(counts[axis]);
    return;
  }
}

void LinkedCells::sort(const std::vector<Vector>& position) {
  const std::size_t n = position.size();
  std::vector<Vector> inside(position.size());
  cell_of_.resize(position.size());
  const auto put_into_cell = [&](std::size_t i) {
    std::array<std::size_t, 3> index{};
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = component(extent_, axis);
      double x = component(position[i], axis) - component(box_.lower, axis);
      if (box_.periodic[axis]) x -= extent * std::floor(x / extent);
      component(inside[i], axis) = x;
      const auto count = static_cast<double>(counts_[axis]);
      index[axis] = extent > 0 ? static_cast<std::size_t>(
                                     std::clamp(std::floor(x / (extent / count)), 0.0, count - 1))
                               : 0;
    }
    cell_of_[i] = (index[2] * counts_[1] + index[1]) * counts_[0] + index[0];
  };
  for_blocks(n, 20000, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) put_into_cell(i);
  });

  first_.assign(cell_count() + 1, 0);
  for (const std::size_t cell : cell_of_) ++first_[cell + 1];
  for (std::size_t cell = 0; cell < cell_count(); ++cell) first_[cell + 1] += first_[cell];
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  residents_.resize(position.size());
  for (std::size_t i = 0; i < n; ++i)
    residents_[next[cell_of_[i]]++] = {inside[i], static_cast<std::int32_t>(i)};
}

int LinkedCells::one_way_neighbours(std::size_t cell, int way,
                                    std::array<CellImage, 13>& neighbours) const {
  const std::array<std::size_t, 3> here{cell % counts_[0], cell / counts_[0] % counts_[1],
                                        cell / (counts_[0] * counts_[1])};
  int found = 0;
  for (int k = 0; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        // All nine of the layer above; in its own layer the row above and the next in the row.
        const bool forward = k > 0 || j > 0 || (j == 0 && i > 0);
        if (!forward) continue;
        const std::array<int, 3> step{way * i, way * j, way * k};
        std::array<std::size_t, 3> there{};
        std::array<int, 3> periods{};
        bool exists = true;
        for (int axis = 0; axis < 3; ++axis) {
          const std::size_t count = counts_[axis];
          there[axis] = here[axis] + static_cast<std::size_t>(step[axis]);
          if (step[axis] == 0 || there[axis] < count) continue;
          // Beyond an end: below zero it wraps to the largest numbers.
          exists = exists && count > 1 && box_.periodic[axis];
          there[axis] = step[axis] > 0 ? 0 : count - 1;
          periods[axis] = step[axis];
        }
        if (exists)
          neighbours[found++] = {(there[2] * counts_[1] + there[1]) * counts_[0] + there[0],
                                 periods};
      }
  return found;
}

std::size_t LinkedCells::find_cells_around(std::size_t cell,
                                           std::array<CellImage, 27>& cells) const {
  // Cells ask in the order of their numbers, and what asks this one stands before it, but for those
  // across a period.
  std::array<CellImage, 13> asking{}, asked{};
  const int asking_count = one_way_neighbours(cell, -1, asking);
  const int asked_count = one_way_neighbours(cell, 1, asked);
  const auto asking_end = asking.begin() + asking_count;
  std::sort(asking.begin(), asking_end,
            [](const CellImage& a, const CellImage& b) { return a.cell < b.cell; });
  const auto middle =
      std::find_if(asking.begin(), asking_end, [&](const CellImage& a) { return a.cell > cell; });
  auto to = std::copy(asking.begin(), middle, cells.begin());
  *to++ = {cell, {0, 0, 0}};
  to = std::copy(asked.begin(), asked.begin() + asked_count, to);
  return static_cast<std::size_t>(std::copy(middle, asking_end, to) - cells.begin());
}

bool LinkedCells::is_own_neighbour() const {
  for (int axis = 0; axis < 3; ++axis)
    if (box_.periodic[axis] && counts_[axis] == 1) return true;
  return false;
}

void LinkedCells::find_ranges_around(std::size_t cell, std::vector<Range>& ranges) const {
  const std::array<std::size_t, 3> here{cell % counts_[0], cell / counts_[0] % counts_[1],
                                        cell / (counts_[0] * counts_[1])};
  // How many cells the reach spans: one, or more where a period is short and repeated.
  std::array<int, 3> steps{1, 1, 1}, count{}, low{}, high{};
  for (std::size_t a = 0; a < 3; ++a) {
    count[a] = static_cast<int>(counts_[a]);
    const int at = static_cast<int>(here[a]);
    if (box_.periodic[a])
      steps[a] =
          static_cast<int>(std::ceil(reach_ * count[a] / component(extent_, static_cast<int>(a))));
    low[a] = box_.periodic[a] ? at - steps[a] : std::max(0, at - 1);
    high[a] = box_.periodic[a] ? at + steps[a] : std::min(count[a] - 1, at + 1);
  }
  const auto periods_of = [](int cell_there, int cells) {
    return cell_there < 0 ? -((cells - 1 - cell_there) / cells) : cell_there / cells;
  };
  ranges.clear();
  for (int z = low[2]; z <= high[2]; ++z)
    for (int y = low[1]; y <= high[1]; ++y) {
      const int pz = periods_of(z, count[2]), py = periods_of(y, count[1]);
      const std::size_t row = (static_cast<std::size_t>(z - pz * count[2]) * counts_[1] +
                               static_cast<std::size_t>(y - py * count[1])) *
                              counts_[0];
      // Cells along x follow each other until a period ends.
      for (int x = low[0]; x <= high[0];) {
        const int px = periods_of(x, count[0]);
        const int end = std::min(high[0] + 1, (px + 1) * count[0]);
        ranges.push_back({first_[row + static_cast<std::size_t>(x - px * count[0])],
                          first_[row + static_cast<std::size_t>(end - px * count[0])],
                          {px, py, pz}});
        x = end;
      }
    }
}

std::vector<Pair> neighbour_pairs(const CellBox& box, const std::vector<Vector>& position,
                                  const std::vector<double>& radius, double tolerance,
                                  double margin) {
  if (position.size() < 2) return {};
  const double largest = *std::max_element(radius.begin(), radius.end());
  const double stretch = (1.0 + tolerance) * (1.0 + margin);
  // A little more than the longest distance (the thesis' 1.004): no pair is lost to round-off.
  LinkedCells cells(box, 1.004 * stretch * 2.0 * largest, position.size());
  cells.sort(position);

  // Blocks of cells fill lists of their own; the final sort makes the order independent of all
  // this.
  const std::size_t cell_count = cells.cell_count();
  const std::size_t blocks = std::min<std::size_t>(cell_count, 64);
  std::vector<std::vector<Pair>> found(blocks);
  for_each_part(blocks, position.size() > 5000, [&](std::size_t block) {
    const std::size_t first = cell_count * block / blocks;
    const std::size_t last = cell_count * (block + 1) / blocks;
    cells.for_each_pair(first, last, [&](std::int32_t i, std::int32_t j, const Vector& chord) {
      const double reach = stretch * (radius[i] + radius[j]);
      if (dot(chord, chord) <= reach * reach)
        found[block].push_back({std::min(i, j), std::max(i, j)});
    });
  });

  std::vector<Pair> pairs;
  for (const auto& list : found) pairs.insert(pairs.end(), list.begin(), list.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace solidem
