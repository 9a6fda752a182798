// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/archive.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace solidem {

void Archive::insist_on_integer(double value, double lowest, double highest) {
  constexpr double largest = 9007199254740992;  // up to which doubles count one by one
  if (!(std::abs(value) <= largest) || value != std::floor(value) || value < lowest ||
      value > highest)
    throw std::out_of_range(std::to_string(value) + " where an integer is expected");
}

void Archive::insist_on_element(std::int32_t value) const {
  if (value < 0 || static_cast<std::size_t>(value) >= elements_)
    throw std::out_of_range("element " + std::to_string(value) + " of " +
                            std::to_string(elements_));
}

std::size_t Archive::checked(std::size_t size) const {
  if (size > values_.size() - at_)
    throw std::out_of_range("a list of " + std::to_string(size) + " entries where " +
                            std::to_string(values_.size() - at_) + " numbers are left");
  return size;
}

}  // namespace solidem
