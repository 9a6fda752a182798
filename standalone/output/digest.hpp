// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_OUTPUT_DIGEST_HPP
#define SOLIDEM_OUTPUT_DIGEST_HPP

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace solidem {

/// SHA-256 of bytes that come one after the other.
class Digest {
 public:
  Digest();
  /// A digest goes on from where another was.
  Digest(const Digest& other);
  Digest& operator=(const Digest&) = delete;
  Digest(Digest&&) noexcept = default;
  Digest& operator=(Digest&&) noexcept = default;
  ~Digest() = default;

  void add(std::string_view bytes);
  /// The bytes of numbers (or of a plain struct of them) as they stand in memory.
  template <class T>
  void add(const std::vector<T>& values) {
    add({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }

  /// Of all bytes so far, as 64 hexadecimal digits.
  std::string hexadecimal() const;

  static constexpr std::size_t hexadecimal_digits = 64;

 private:
  std::shared_ptr<void> context_;  // OpenSSL's
};

/// The digest of bytes that are all there.
std::string digest_of(std::string_view bytes);

}  // namespace solidem

#endif
