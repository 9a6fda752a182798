// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/seal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "model/error.hpp"
#include "output/descriptor.hpp"
#include "output/digest.hpp"

namespace solidem {

namespace {

constexpr std::string_view mark = "\nsolidem seal ";
constexpr int size_digits = 20;
constexpr std::size_t seal_size = mark.size() + Digest::hexadecimal_digits + 1 + size_digits + 1;
constexpr std::size_t piece = std::size_t{1} << 20;

std::string seal_of(const Digest& digest, std::size_t size) {
  return fmt::format("{}{} {:0{}}\n", mark, digest.hexadecimal(), size, size_digits);
}

[[noreturn]] void fail(const std::string& path) {
  throw RunError("cannot read " + path + ": " + std::strerror(errno));
}

/// Reads `size` bytes at a place; false at the end of the file.
bool read_at(const Descriptor& file, const std::string& path, std::size_t place, std::size_t size,
             char* bytes) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t count =
        ::pread(file.get(), bytes + done, size - done, static_cast<off_t>(place + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path);
    if (count == 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

std::string seal_of(std::string_view content) {
  Digest digest;
  digest.add(content);
  return seal_of(digest, content.size());
}

SealState check_seal(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.get(), &status) != 0) fail(path);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size < seal_size) return SealState::absent;
  const std::size_t content = size - seal_size;
  std::string seal(seal_size, '\0');
  if (!read_at(file, path, content, seal_size, seal.data())) return SealState::broken;
  if (seal.compare(0, mark.size(), mark) != 0) return SealState::absent;

  Digest digest;
  std::vector<char> bytes(std::min(piece, content));
  for (std::size_t place = 0; place < content; place += piece) {
    const std::size_t now = std::min(piece, content - place);
    if (!read_at(file, path, place, now, bytes.data())) return SealState::broken;
    digest.add({bytes.data(), now});
  }
  return seal == seal_of(digest, content) ? SealState::holds : SealState::broken;
}

}  // namespace solidem
