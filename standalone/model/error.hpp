// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_ERROR_HPP
#define SOLIDEM_MODEL_ERROR_HPP

#include <stdexcept>
#include <string>

namespace solidem {

/// Something the user gave cannot be used: a scene, a specimen file, a path, an option. The text
/// says where (file, line, key), what was found, and what would be right.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A run that cannot go on: it diverged, or a file could not be written. The text says what
/// happened, when, and what is safe on disk.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace solidem

#endif
