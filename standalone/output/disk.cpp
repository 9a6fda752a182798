// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/disk.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "model/error.hpp"

namespace solidem {

namespace fs = std::filesystem;

namespace {

fs::file_status status_of(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status))
    throw InputError(path + ": cannot be looked at (" + error.message() + ")");
  return status;
}

}  // namespace

bool is_there(const std::string& path) {
  return fs::exists(status_of(path));
}

bool is_folder(const std::string& path) {
  return fs::is_directory(status_of(path));
}

bool is_regular_file(const std::string& path) {
  return fs::is_regular_file(status_of(path));
}

void prepare_directory(const std::string& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  std::error_code unknown;
  if (!fs::is_directory(directory, unknown))
    throw RunError("cannot make the directory " + directory + ": " +
                   (error ? error.message() : "something else has that name"));
  if (::faccessat(AT_FDCWD, directory.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    throw RunError("cannot write into the directory " + directory + ": " + std::strerror(errno));
}

void insist_on_regular_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status)) throw RunError("cannot write " + path + ": " + error.message());
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw RunError("cannot write " + path + ": " +
                   (fs::is_directory(status) ? "it is a directory" : "it is not a regular file"));
}

}  // namespace solidem
