// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_SLOTS_HPP
#define SOLIDEM_MODEL_SLOTS_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/buffer.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// Elements in a block, one in each lane of the widest SIMD pack.
inline constexpr int lanes = 8;

/// Bonds seen from both sides (sliced ELLPACK): each element has a slot for each of its bonds, so
/// that it gathers what acts on it and nobody scatters. Eight elements form a block, in the lanes
/// of a pack; row k of a block holds the k-th slot of each. An element with fewer bonds than its
/// block has rows is filled up with slots whose neighbour is the element itself.
class Slots {
 public:
  Slots() = default;
  Slots(std::size_t elements, const std::vector<Pair>& bonds);

  /// Holds lists that see each neighbour from both sides in the place of what was there: those of
  /// element i stand from first[i] to first[i + 1], one beyond the last, and keep their order. A
  /// neighbour may stand several times, as several images. `bonds`: what bonds() tells.
  void list(const std::vector<std::uint32_t>& first, const std::vector<std::int32_t>& neighbours,
            std::size_t bonds);

  std::size_t elements() const { return elements_; }
  /// Bonds at the start.
  std::size_t bonds() const { return bonds_; }
  std::size_t blocks() const { return first_row_.size() - 1; }
  /// Elements counting those that fill the last block up.
  std::size_t padded_elements() const { return blocks() * lanes; }
  std::size_t rows() const { return first_row_.back(); }
  const std::uint32_t* first_row() const { return first_row_.data(); }
  const std::int32_t* neighbours() const { return neighbour_.data(); }
  std::size_t bytes() const {
    return first_row_.size() * sizeof(std::uint32_t) + neighbour_.size() * sizeof(std::int32_t);
  }

  /// Calls visit(element, neighbour, row, lane) for each slot in use, in the order of elements'
  /// blocks; each bond is seen twice.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t block = 0; block < blocks(); ++block) for_each_in(block, visit);
  }

  /// The same for the slots of one block.
  template <class Visit>
  void for_each_in(std::size_t block, Visit visit) const {
    for (std::size_t row = first_row_[block]; row < first_row_[block + 1]; ++row)
      for (int lane = 0; lane < lanes; ++lane) {
        const auto element = static_cast<std::int32_t>(block * lanes) + lane;
        const std::int32_t neighbour = neighbour_[row * lanes + static_cast<std::size_t>(lane)];
        if (neighbour != element) visit(element, neighbour, row, lane);
      }
  }

  /// Where one side of a bond stands.
  struct Place {
    std::size_t row;
    int lane;
    std::size_t index() const { return row * lanes + static_cast<std::size_t>(lane); }
  };
  static Place place_of(std::size_t index) {
    return {index / lanes, static_cast<int>(index % lanes)};
  }

  /// The element whose slot this is.
  std::int32_t element_of(Place place) const;
  std::int32_t neighbour_of(Place place) const { return neighbour_[place.index()]; }

  /// The slot in which an element sees a neighbour; for the element itself, the first that is free.
  std::optional<Place> find(std::int32_t element, std::int32_t neighbour) const;

  /// Puts a neighbour into a slot; the element itself empties it.
  void set_neighbour(Place place, std::int32_t neighbour) { neighbour_[place.index()] = neighbour; }

  /// Number of bonds that an element has now.
  int coordination(std::int32_t element) const;

  /// Number of bonds of each element.
  std::vector<int> coordination() const;

  /// Whether j stands in a slot of i exactly when i stands in one of j.
  bool is_symmetric() const;

  /// The bonds as sorted pairs, each once.
  std::vector<Pair> pairs() const;

 private:
  /// Lays out empty slots, `used` of each element.
  void lay_out(const std::vector<std::uint32_t>& used);

  std::size_t elements_ = 0, bonds_ = 0;
  std::vector<std::uint32_t> first_row_{0};
  Buffer<std::int32_t> neighbour_;
};

}  // namespace solidem

#endif
