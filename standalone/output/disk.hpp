// SPDX-License-Identifier: GPL-2.0-or-later
//
// What is asked of the disk before something is written to it.
#ifndef SOLIDEM_OUTPUT_DISK_HPP
#define SOLIDEM_OUTPUT_DISK_HPP

#include <cstdint>
#include <string>

namespace solidem {

/// Makes a directory (and those above it) for results and checks that files can be made in it.
/// RunError names the directory and the reason.
void prepare_directory(const std::string& directory);

/// Makes sure that a file can grow by `bytes`, so that what is written next cannot fill the disk
/// halfway. The file is made if it is not there; its size and content stay. RunError names `shown`,
/// as the user knows the file, the reason, and what is `safe` ("" if there is nothing to say).
void reserve_space(const std::string& path, std::uint64_t bytes, const std::string& shown,
                   const std::string& safe);

/// RunError if something stands at `path` that is not a regular file, as HDF5 needs it.
void insist_on_regular_file(const std::string& path);

}  // namespace solidem

#endif
