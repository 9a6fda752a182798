// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_OUTPUT_DESCRIPTOR_HPP
#define SOLIDEM_OUTPUT_DESCRIPTOR_HPP

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <utility>

namespace solidem {

/// Permissions of a new file, less what the user's umask takes away.
constexpr mode_t usual_mode = 0666;

/// Owner of a file descriptor: closes it at the end. Errors are read from `errno`.
class Descriptor {
 public:
  explicit Descriptor(int descriptor = -1) : descriptor_(descriptor) {}
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    // Whoever reports an error after the descriptor is gone still wants the first one.
    const int error = errno;
    if (is_open()) ::close(descriptor_);
    errno = error;
  }

  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }

  /// Writes every byte or returns false.
  bool write_all(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count > 0) {
        bytes.remove_prefix(static_cast<std::size_t>(count));
      } else if (count == 0 || errno != EINTR) {
        if (count == 0) errno = ENOSPC;
        return false;
      }
    }
    return true;
  }

  /// Waits until all that was written is on the disk; false if it will never be there.
  bool sync() const { return ::fsync(descriptor_) == 0; }

  /// Closes now; false if something that was written is lost.
  bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_;
};

}  // namespace solidem

#endif
