// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/slots.hpp"

#include <algorithm>

#include "model/blocks.hpp"

namespace solidem {

Slots::Slots(std::size_t elements, const std::vector<Pair>& bonds)
    : elements_(elements), bonds_(bonds.size()) {
  const std::size_t blocks = (elements + lanes - 1) / lanes;
  std::vector<std::uint32_t> used(blocks * lanes, 0);
  for (const Pair& bond : bonds) {
    ++used[static_cast<std::size_t>(bond.i)];
    ++used[static_cast<std::size_t>(bond.j)];
  }
  lay_out(used);

  // Bonds are sorted pairs i < j: filling first the lower, then the higher neighbours leaves every
  // element's neighbours in increasing order, whoever wrote the bonds.
  std::fill(used.begin(), used.end(), 0);
  const auto put = [&](std::int32_t element, std::int32_t neighbour) {
    const auto e = static_cast<std::size_t>(element);
    const std::size_t row = first_row_[e / lanes] + used[e]++;
    neighbour_[row * lanes + e % lanes] = neighbour;
  };
  for (const Pair& bond : bonds) put(bond.j, bond.i);
  for (const Pair& bond : bonds) put(bond.i, bond.j);
}

void Slots::list(const std::vector<std::uint32_t>& first,
                 const std::vector<std::int32_t>& neighbours, std::size_t bonds) {
  elements_ = first.size() - 1;
  bonds_ = bonds;
  std::vector<std::uint32_t> used((elements_ + lanes - 1) / lanes * lanes, 0);
  for (std::size_t i = 0; i < elements_; ++i) used[i] = first[i + 1] - first[i];
  lay_out(used);
  for_blocks(elements_, 20000, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = first[i]; k < first[i + 1]; ++k)
        neighbour_[(first_row_[i / lanes] + (k - first[i])) * lanes + i % lanes] = neighbours[k];
  });
}

void Slots::lay_out(const std::vector<std::uint32_t>& used) {
  const std::size_t blocks = used.size() / lanes;
  first_row_.resize(blocks + 1);
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto first = used.begin() + static_cast<std::ptrdiff_t>(b * lanes);
    first_row_[b + 1] = first_row_[b] + *std::max_element(first, first + lanes);
  }
  neighbour_.assign(std::size_t{first_row_.back()} * lanes);
  for (std::size_t b = 0; b < blocks; ++b)
    for (std::size_t k = first_row_[b] * std::size_t{lanes};
         k < first_row_[b + 1] * std::size_t{lanes}; ++k)
      neighbour_[k] = static_cast<std::int32_t>(b * lanes + k % lanes);
}

std::int32_t Slots::element_of(Place place) const {
  const auto after = std::upper_bound(first_row_.begin(), first_row_.end(), place.row);
  const auto block = static_cast<std::int32_t>(after - first_row_.begin()) - 1;
  return block * lanes + place.lane;
}

std::optional<Slots::Place> Slots::find(std::int32_t element, std::int32_t neighbour) const {
  const auto block = static_cast<std::size_t>(element / lanes);
  for (std::size_t row = first_row_[block]; row < first_row_[block + 1]; ++row)
    if (const Place place{row, element % lanes}; neighbour_of(place) == neighbour) return place;
  return std::nullopt;
}

int Slots::coordination(std::int32_t element) const {
  const auto block = static_cast<std::size_t>(element / lanes);
  int count = 0;
  for (std::size_t row = first_row_[block]; row < first_row_[block + 1]; ++row)
    if (neighbour_of({row, element % lanes}) != element) ++count;
  return count;
}

std::vector<int> Slots::coordination() const {
  std::vector<int> count(elements_, 0);
  for_each([&](std::int32_t element, std::int32_t, std::size_t, int) {
    ++count[static_cast<std::size_t>(element)];
  });
  return count;
}

bool Slots::is_symmetric() const {
  bool symmetric = true;
  for_each([&](std::int32_t element, std::int32_t neighbour, std::size_t, int) {
    symmetric = symmetric && find(neighbour, element);
  });
  return symmetric;
}

std::vector<Pair> Slots::pairs() const {
  std::vector<Pair> result;
  result.reserve(bonds_);
  for_each([&](std::int32_t element, std::int32_t neighbour, std::size_t, int) {
    if (element < neighbour) result.push_back({element, neighbour});
  });
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace solidem
