// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/read_file.hpp"

#include <fcntl.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "model/error.hpp"
#include "output/descriptor.hpp"

namespace solidem {

std::string read_file(const std::string& path, std::size_t most) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const auto fail = [&] {
    throw InputError(path + ": cannot be read (" + std::strerror(errno) + ")");
  };
  if (!file.is_open()) fail();
  std::string content;
  std::array<char, 1 << 16> piece{};
  while (true) {
    const ssize_t count = ::read(file.get(), piece.data(), piece.size());
    if (count == 0) return content;
    if (count > 0) content.append(piece.data(), static_cast<std::size_t>(count));
    if (content.size() > most)
      throw InputError(path + ": more than " + std::to_string(most) + " bytes");
    if (count < 0 && errno != EINTR) fail();
  }
}

}  // namespace solidem
