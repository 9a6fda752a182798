// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_OUTPUT_READ_FILE_HPP
#define SOLIDEM_OUTPUT_READ_FILE_HPP

#include <cstddef>
#include <limits>
#include <string>

namespace solidem {

/// Every byte of a file. InputError if it cannot be read to its end, or holds more bytes than
/// `most`, as a device without an end does.
std::string read_file(const std::string& path,
                      std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace solidem

#endif
