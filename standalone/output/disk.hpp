// SPDX-License-Identifier: GPL-2.0-or-later
//
// What is asked of the disk before something is read from it or written to it.
#ifndef SOLIDEM_OUTPUT_DISK_HPP
#define SOLIDEM_OUTPUT_DISK_HPP

#include <string>

namespace solidem {

/// Whether something stands at a path. InputError where the disk does not tell: what cannot be
/// looked at is not what is not there.
bool is_there(const std::string& path);

/// Whether it is a folder, or a file and no device.
bool is_folder(const std::string& path);
bool is_regular_file(const std::string& path);

/// Makes a directory (and those above it) for results and checks that files can be made in it.
/// RunError names the directory and the reason.
void prepare_directory(const std::string& directory);

/// RunError if something stands at `path` that is not a regular file, as HDF5 needs it.
void insist_on_regular_file(const std::string& path);

}  // namespace solidem

#endif
