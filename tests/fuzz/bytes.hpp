// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_TESTS_FUZZ_BYTES_HPP
#define SOLIDEM_TESTS_FUZZ_BYTES_HPP

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

namespace solidem::fuzz {

/// Values made of bytes; zeros when there are none left.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T take() {
    T value{};
    const std::size_t size = std::min(sizeof(T), rest_.size());
    std::memcpy(&value, rest_.data(), size);
    rest_.remove_prefix(size);
    return value;
  }
  /// A number below `count`.
  std::size_t below(std::size_t count) { return take<std::uint16_t>() % count; }
  bool is_empty() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

/// The name of a file in memory, of this process alone.
inline std::string file_in_memory(const std::string& name) {
  static const std::string folder = [] {
    const std::string memory = std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp";
    return memory + "/solidem-fuzz-" + std::to_string(::getpid());
  }();
  return folder + name;
}

}  // namespace solidem::fuzz

#endif
