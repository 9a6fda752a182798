// SPDX-License-Identifier: GPL-2.0-or-later
//
// A seal is a line at the end of a file that says how long the file was before it, and a checksum
// of all its bytes. HDF5 takes no notice of what stands behind a file's content, and takes it away
// when it changes the file.
#ifndef SOLIDEM_SPECIMEN_FILE_SEAL_HPP
#define SOLIDEM_SPECIMEN_FILE_SEAL_HPP

#include <string>

namespace solidem {

/// Puts a seal at the end of a file that has none. Throws RunError when it cannot be written.
void seal_file(const std::string& path);

/// Whether a file has a seal. Throws InputError when it does not fit the file's bytes. The library
/// of HDF5 is not safe against damaged files, so this comes before it sees one.
bool check_seal(const std::string& path);

}  // namespace solidem

#endif
