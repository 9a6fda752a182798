// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/digest.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <new>
#include <stdexcept>

namespace solidem {

namespace {

std::shared_ptr<void> new_context() {
  EVP_MD_CTX* const made = EVP_MD_CTX_new();
  if (made == nullptr) throw std::bad_alloc();
  return {made, [](void* context) { EVP_MD_CTX_free(static_cast<EVP_MD_CTX*>(context)); }};
}

EVP_MD_CTX* as_context(const std::shared_ptr<void>& context) {
  return static_cast<EVP_MD_CTX*>(context.get());
}

void insist(int done) {
  if (done != 1) throw std::runtime_error("SHA-256 is not available in the system's libcrypto");
}

}  // namespace

Digest::Digest() : context_(new_context()) {
  insist(EVP_DigestInit_ex(as_context(context_), EVP_sha256(), nullptr));
}

Digest::Digest(const Digest& other) : context_(new_context()) {
  insist(EVP_MD_CTX_copy_ex(as_context(context_), as_context(other.context_)));
}

void Digest::add(std::string_view bytes) {
  insist(EVP_DigestUpdate(as_context(context_), bytes.data(), bytes.size()));
}

std::string Digest::hexadecimal() const {
  const Digest now(*this);  // which may go on
  std::array<unsigned char, hexadecimal_digits / 2> bytes{};
  insist(EVP_DigestFinal_ex(as_context(now.context_), bytes.data(), nullptr));
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

std::string digest_of(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.hexadecimal();
}

}  // namespace solidem
