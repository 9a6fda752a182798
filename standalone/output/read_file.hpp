// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_OUTPUT_READ_FILE_HPP
#define SOLIDEM_OUTPUT_READ_FILE_HPP

#include <string>

namespace solidem {

/// Every byte of a file. InputError if it cannot be read to its end.
std::string read_file(const std::string& path);

}  // namespace solidem

#endif
