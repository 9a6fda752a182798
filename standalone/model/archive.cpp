// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/archive.hpp"

#include <stdexcept>
#include <string>

namespace solidem {

std::size_t Archive::checked(std::size_t size) const {
  if (size > values_.size() - at_)
    throw std::out_of_range("a list of " + std::to_string(size) + " entries where " +
                            std::to_string(values_.size() - at_) + " numbers are left");
  return size;
}

}  // namespace solidem
