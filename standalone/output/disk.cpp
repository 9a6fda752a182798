// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/disk.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "model/error.hpp"
#include "output/descriptor.hpp"

namespace solidem {

namespace fs = std::filesystem;

namespace {

/// Makes a file that nobody had made and removes it again; false, with errno, if that cannot be.
bool can_make_files(const std::string& name) {
  ::unlink(name.c_str());
  const Descriptor file(
      ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, usual_mode));
  return file.is_open() && ::unlink(name.c_str()) == 0;
}

}  // namespace

void prepare_directory(const std::string& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  std::error_code unknown;
  if (!fs::is_directory(directory, unknown))
    throw RunError("cannot make the directory " + directory + ": " +
                   (error ? error.message() : "something else has that name"));
  const std::string probe =
      (fs::path(directory) / (".solidem-" + std::to_string(::getpid()))).string();
  if (!can_make_files(probe))
    throw RunError("cannot write into the directory " + directory + ": " + std::strerror(errno));
}

void insist_on_regular_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw RunError("cannot write " + path + ": " +
                   (fs::is_directory(status) ? "it is a directory" : "it is not a regular file"));
}

}  // namespace solidem
