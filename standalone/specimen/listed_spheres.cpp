// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/listed_spheres.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "model/blocks.hpp"
#include "model/slots.hpp"
#include "specimen/soft_sphere_kernels.hpp"

namespace solidem {

namespace {

/// Neighbours of some spheres, one sphere after the other.
struct ListsFound {
  struct Owner {
    std::int32_t sphere, neighbours;
  };
  std::vector<Owner> owners;
  std::vector<std::int32_t> neighbour;
};

/// All spheres in the order of the cells.
class SpheresInCells {
 public:
  explicit SpheresInCells(const SpheresToList& spheres)
      : cells_(spheres.box, 2.0 * spheres.largest_radius + spheres.skin, spheres.size) {
    for (const bool periodic : spheres.box.periodic) is_periodic_ = is_periodic_ || periodic;
    const double* ball = spheres.ball;
    std::vector<Vector> position(spheres.size);
    for (std::size_t i = 0; i < spheres.size; ++i)
      position[i] = {ball[4 * i], ball[4 * i + 1], ball[4 * i + 2]};
    cells_.sort(position);
    for (auto* column : {&x_, &y_, &z_, &reach_}) column->resize(spheres.size + lanes);
    radius_.resize(spheres.size);
    for (std::size_t k = 0; k < spheres.size; ++k) {
      const LinkedCells::Resident& resident = cells_.resident(k);
      x_[k] = resident.position.x;
      y_[k] = resident.position.y;
      z_[k] = resident.position.z;
      radius_[k] = ball[4 * static_cast<std::size_t>(resident.element) + 3];
      reach_[k] = radius_[k] + spheres.skin;
    }
  }

  const LinkedCells& cells() const { return cells_; }
  bool is_periodic() const { return is_periodic_; }
  std::size_t size() const { return radius_.size(); }
  SortedSpheres columns() const { return {x_.data(), y_.data(), z_.data(), reach_.data()}; }
  double radius(std::size_t k) const { return radius_[k]; }
  /// For the few bodies in which a cell stands beside itself: whether a sphere is near the nearest
  /// image of another.
  bool are_near(std::size_t k, std::size_t other) const {
    const double reach = radius_[k] + reach_[other];
    const Vector chord = cells_.chord(cells_.resident(k).position, cells_.resident(other).position);
    return dot(chord, chord) < reach * reach;
  }

 private:
  LinkedCells cells_;
  bool is_periodic_ = false;
  std::vector<double> x_, y_, z_, reach_, radius_;
};

/// Finds the neighbours of the spheres in one cell.
class NeighbourSearch {
 public:
  explicit NeighbourSearch(const SpheresInCells& spheres)
      : spheres_(&spheres), is_own_neighbour_(spheres.cells().is_own_neighbour()) {}

  void list(std::size_t cell, ListsFound& lists) {
    const LinkedCells& cells = spheres_->cells();
    if (cells.first_of(cell) == cells.first_of(cell + 1)) return;
    spheres_->is_periodic() ? find_ranges(cell) : find_plain_ranges(cell);
    for (std::size_t k = cells.first_of(cell); k < cells.first_of(cell + 1); ++k) {
      const std::size_t near = pick(k), began = lists.neighbour.size();
      for (std::size_t n = 0; n < near; ++n)
        if (near_[n] != k && (!is_own_neighbour_ || spheres_->are_near(k, near_[n])))
          lists.neighbour.push_back(cells.resident(near_[n]).element);
      lists.owners.push_back(
          {cells.resident(k).element, static_cast<std::int32_t>(lists.neighbour.size() - began)});
    }
  }

 private:
  // Without periods the order of the pairs is that of the cells.
  void find_plain_ranges(std::size_t cell) {
    spheres_->cells().find_ranges_around(cell, plain_ranges_);
    std::size_t spheres = 0;
    ranges_.clear();
    for (const LinkedCells::Range& range : plain_ranges_) {
      ranges_.push_back({range.first, range.last, {}});
      spheres += range.last - range.first;
    }
    make_room(spheres);
  }

  void make_room(std::size_t spheres) {
    if (near_.size() < spheres + lanes) near_.resize(2 * spheres + lanes);
  }

  void find_ranges(std::size_t cell) {
    const LinkedCells& cells = spheres_->cells();
    std::array<LinkedCells::CellImage, 27> around{};
    const std::size_t count = cells.find_cells_around(cell, around);
    const Vector& extent = cells.extent();
    ranges_.clear();
    std::size_t spheres = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const LinkedCells::CellImage& image = around[n];
      const std::size_t first = cells.first_of(image.cell), last = cells.first_of(image.cell + 1);
      spheres += last - first;
      if (n > 0 && first == ranges_.back().last && image.periods == around[n - 1].periods)
        ranges_.back().last = last;
      else
        ranges_.push_back({first,
                           last,
                           {image.periods[0] * extent.x, image.periods[1] * extent.y,
                            image.periods[2] * extent.z}});
    }
    make_room(spheres);
  }

  std::size_t pick(std::size_t k) {
    // Where images count, all are looked at one by one.
    constexpr double everywhere = 1e150;
    const double reach = is_own_neighbour_ ? everywhere : spheres_->radius(k);
    return soft_sphere_kernels().pick(spheres_->columns(), ranges_.data(), ranges_.size(),
                                      spheres_->cells().resident(k).position, reach, near_.data());
  }

  const SpheresInCells* spheres_;
  bool is_own_neighbour_;
  std::vector<LinkedCells::Range> plain_ranges_;
  std::vector<SphereRange> ranges_;
  std::vector<std::uint32_t> near_;
};

std::vector<ListsFound> find_lists(const SpheresInCells& spheres, bool on_all_threads) {
  const std::size_t cell_count = spheres.cells().cell_count();
  const std::size_t parts = std::min<std::size_t>(cell_count, 64);
  constexpr std::size_t usual_neighbours = 12;
  std::vector<ListsFound> found(parts);
  for_each_part_with(
      parts, on_all_threads, [&] { return NeighbourSearch(spheres); },
      [&](NeighbourSearch& search, std::size_t part) {
        found[part].owners.reserve(spheres.size() / parts);
        found[part].neighbour.reserve(usual_neighbours * spheres.size() / parts);
        for (std::size_t cell = cell_count * part / parts; cell < cell_count * (part + 1) / parts;
             ++cell)
          search.list(cell, found[part]);
      });
  return found;
}

}  // namespace

void list_spheres(const SpheresToList& spheres, std::vector<std::uint32_t>& first_row,
                  std::vector<std::int32_t>& neighbour) {
  constexpr std::size_t least_spheres = 3000;
  const bool on_all_threads = spheres.size > least_spheres;
  const std::vector<ListsFound> found = find_lists(SpheresInCells(spheres), on_all_threads);

  const std::size_t blocks = spheres.size / lanes + 1;
  first_row.assign(blocks + 1, 0);
  for (const ListsFound& lists : found)
    for (const ListsFound::Owner& owner : lists.owners) {
      std::uint32_t& rows = first_row[static_cast<std::size_t>(owner.sphere) / lanes + 1];
      rows = std::max(rows, static_cast<std::uint32_t>(owner.neighbours));
    }
  std::partial_sum(first_row.begin(), first_row.end(), first_row.begin());
  neighbour.assign(std::size_t{first_row.back()} * lanes, static_cast<std::int32_t>(spheres.size));
  for_each_part(found.size(), on_all_threads, [&](std::size_t part) {
    std::size_t from = 0;
    for (const ListsFound::Owner& owner : found[part].owners) {
      const auto sphere = static_cast<std::size_t>(owner.sphere);
      std::size_t to = std::size_t{first_row[sphere / lanes]} * lanes + sphere % lanes;
      for (std::int32_t k = 0; k < owner.neighbours; ++k, to += lanes)
        neighbour[to] = found[part].neighbour[from++];
    }
  });
}

}  // namespace solidem
