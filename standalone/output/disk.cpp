// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/disk.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "model/error.hpp"
#include "output/descriptor.hpp"

namespace solidem {

namespace fs = std::filesystem;

namespace {

/// Zero, or the error that growing an open file by `bytes` would end in.
int error_of_growing(const Descriptor& file, std::uint64_t bytes) {
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) return errno;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      size + bytes > limit.rlim_cur)
    return EFBIG;
  const auto start = static_cast<off_t>(size);
  const auto length = static_cast<off_t>(bytes);
  if (::fallocate(file.get(), FALLOC_FL_KEEP_SIZE, start, length) == 0) return 0;
  if (errno != EOPNOTSUPP && errno != ENOSYS) return errno;
  // File systems that cannot reserve are asked by writing zeros, which HDF5 then overwrites.
  return ::posix_fallocate(file.get(), start, length);
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
  const Descriptor file(::open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, usual_mode));
  if (!file.is_open())
    throw RunError("cannot write into the directory " + directory + ": " + std::strerror(errno));
  ::unlink(probe.c_str());
}

void reserve_space(const std::string& path, std::uint64_t bytes, const std::string& shown,
                   const std::string& safe) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, usual_mode));
  const int error = file.is_open() ? error_of_growing(file, bytes) : errno;
  if (error != 0)
    throw RunError("cannot write " + shown + ": " + std::strerror(error) +
                   (safe.empty() ? "" : "; " + safe));
}

void insist_on_regular_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw RunError("cannot write " + path + ": " +
                   (fs::is_directory(status) ? "it is a directory" : "it is not a regular file"));
}

}  // namespace solidem
