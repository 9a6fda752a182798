// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_TESTS_SUPPORT_REFUSAL_HPP
#define SOLIDEM_TESTS_SUPPORT_REFUSAL_HPP

#include <string>

#include "model/error.hpp"

namespace solidem::test {

/// With what words an act refuses what it was given; empty where it does not.
template <class Act>
std::string refusal_of(const Act& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace solidem::test

#endif
