// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/file_seal.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>

#include "model/error.hpp"

namespace solidem {

namespace {

constexpr std::string_view mark = "\nsolidem seal ";
constexpr std::size_t seal_size = mark.size() + 16 + 1 + 20 + 1;

// FNV-1a of 64 bits: finds damage, not forgery.
std::string seal_of(std::string_view content) {
  std::uint64_t checksum = 0xcbf29ce484222325U;
  for (const char c : content)
    checksum = (checksum ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return fmt::format("{}{:016x} {:020}\n", mark, checksum, content.size());
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

}  // namespace

void seal_file(const std::string& path) {
  const std::string seal = seal_of(bytes_of(path));
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file << seal << std::flush;
  if (!file) throw RunError("cannot write " + path + ": " + std::strerror(errno));
}

bool check_seal(const std::string& path) {
  const std::string bytes = bytes_of(path);
  if (bytes.size() < seal_size) return false;
  const std::size_t content = bytes.size() - seal_size;
  const std::string_view seal = std::string_view(bytes).substr(content);
  if (seal.substr(0, mark.size()) != mark) return false;
  if (seal != seal_of(std::string_view(bytes).substr(0, content)))
    throw InputError(path +
                     ": is damaged: its bytes are not those that were written, as the checksum at "
                     "its end tells; copy it again, or make it anew");
  return true;
}

}  // namespace solidem
