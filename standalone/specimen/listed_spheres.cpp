// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/listed_spheres.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "model/blocks.hpp"
#include "model/slots.hpp"

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

/// The spheres in and around one cell.
class SpheresAround {
 public:
  SpheresAround(const SpheresToList& spheres, const LinkedCells& cells)
      : spheres_(&spheres), cells_(&cells), is_own_neighbour_(cells.is_own_neighbour()) {}

  void gather(std::size_t cell) {
    std::array<LinkedCells::CellImage, 27> around{};
    const std::size_t cell_count = cells_->find_cells_around(cell, around);
    std::size_t count = 0;
    for (std::size_t k = 0; k < cell_count; ++k)
      count += cells_->first_of(around[k].cell + 1) - cells_->first_of(around[k].cell);
    if (count + lanes > x_.size()) {
      for (auto* column : {&x_, &y_, &z_, &reach_}) column->resize(2 * count + lanes);
      near_.resize(2 * count + lanes);
    }
    sphere_.resize(count);
    std::size_t to = 0;
    for (std::size_t k = 0; k < cell_count; ++k) to = copy(around[k], to);
    constexpr double nowhere = 1e200;
    std::fill_n(x_.begin() + static_cast<std::ptrdiff_t>(count), lanes, nowhere);
  }

  /// Adds the neighbours of a sphere in that cell.
  void list(const LinkedCells::Resident& own, ListsFound& lists) {
    const std::size_t began = lists.neighbour.size();
    const double radius = spheres_->ball[4 * static_cast<std::size_t>(own.element) + 3];
    const std::size_t near = pick(own.position, radius);
    for (std::size_t k = 0; k < near; ++k) {
      const std::int32_t other = sphere_[near_[k]];
      if (other == own.element) continue;
      if (is_own_neighbour_ && !is_near(own, near_[k], radius)) continue;
      lists.neighbour.push_back(other);
    }
    lists.owners.push_back(
        {own.element, static_cast<std::int32_t>(lists.neighbour.size() - began)});
  }

 private:
  std::size_t copy(const LinkedCells::CellImage& image, std::size_t to) {
    const Vector& extent = cells_->extent();
    const Vector shift{image.periods[0] * extent.x, image.periods[1] * extent.y,
                       image.periods[2] * extent.z};
    for (std::size_t r = cells_->first_of(image.cell); r < cells_->first_of(image.cell + 1);
         ++r, ++to) {
      const LinkedCells::Resident& resident = cells_->resident(r);
      x_[to] = resident.position.x + shift.x;
      y_[to] = resident.position.y + shift.y;
      z_[to] = resident.position.z + shift.z;
      reach_[to] =
          spheres_->ball[4 * static_cast<std::size_t>(resident.element) + 3] + spheres_->skin;
      sphere_[to] = resident.element;
    }
    return to;
  }

  std::size_t pick(const Vector& at, double radius) {
    if (!is_own_neighbour_)
      return spheres_->pick_near({x_.data(), y_.data(), z_.data(), reach_.data(), sphere_.size()},
                                 at.x, at.y, at.z, radius, near_.data());
    std::iota(near_.begin(), near_.end(), 0U);
    return sphere_.size();
  }

  bool is_near(const LinkedCells::Resident& own, std::size_t k, double radius) const {
    const Vector chord = cells_->chord(own.position, {x_[k], y_[k], z_[k]});
    return dot(chord, chord) < (reach_[k] + radius) * (reach_[k] + radius);
  }

  const SpheresToList* spheres_;
  const LinkedCells* cells_;
  bool is_own_neighbour_;
  std::vector<double> x_, y_, z_, reach_;
  std::vector<std::int32_t> sphere_;
  std::vector<std::uint32_t> near_;
};

std::vector<ListsFound> find_lists(const SpheresToList& spheres, const LinkedCells& cells,
                                   bool on_all_threads) {
  const std::size_t cell_count = cells.cell_count();
  const std::size_t parts = std::min<std::size_t>(cell_count, 64);
  std::vector<ListsFound> found(parts);
  for_each_part_with(
      parts, on_all_threads, [&] { return SpheresAround(spheres, cells); },
      [&](SpheresAround& around, std::size_t part) {
        for (std::size_t cell = cell_count * part / parts; cell < cell_count * (part + 1) / parts;
             ++cell) {
          if (cells.first_of(cell) == cells.first_of(cell + 1)) continue;
          around.gather(cell);
          for (std::size_t r = cells.first_of(cell); r < cells.first_of(cell + 1); ++r)
            around.list(cells.resident(r), found[part]);
        }
      });
  return found;
}

}  // namespace

void list_spheres(const SpheresToList& spheres, std::vector<std::uint32_t>& first_row,
                  std::vector<std::int32_t>& neighbour) {
  constexpr std::size_t least_spheres = 3000;
  const bool on_all_threads = spheres.size > least_spheres;
  std::vector<Vector> position(spheres.size);
  for (std::size_t i = 0; i < spheres.size; ++i)
    position[i] = {spheres.ball[4 * i], spheres.ball[4 * i + 1], spheres.ball[4 * i + 2]};
  LinkedCells cells(spheres.box, 2.0 * spheres.largest_radius + spheres.skin, spheres.size);
  cells.sort(position);
  const std::vector<ListsFound> found = find_lists(spheres, cells, on_all_threads);

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
