// SPDX-License-Identifier: GPL-2.0-or-later
//
// A seal is a line at the end of a file that says how long the file was before it, and its SHA-256.
// HDF5 takes no notice of what stands behind a file's content.
#ifndef SOLIDEM_OUTPUT_SEAL_HPP
#define SOLIDEM_OUTPUT_SEAL_HPP

#include <string>
#include <string_view>

namespace solidem {

/// The seal of a file's content.
std::string seal_of(std::string_view content);

enum class SealState {
  absent,  ///< the file ends with no seal
  holds,   ///< every byte is as it was written
  broken
};

/// Reads a file and compares it with its seal. RunError if it cannot be read: that says nothing of
/// what is in it.
SealState check_seal(const std::string& path);

}  // namespace solidem

#endif
