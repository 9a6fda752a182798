// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_TESTS_SUPPORT_SANITIZED_HPP
#define SOLIDEM_TESTS_SUPPORT_SANITIZED_HPP

namespace solidem {

/// Whether AddressSanitizer watches this program, which then is several times as slow.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool is_sanitized = true;  // told so by g++
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool is_sanitized = true;  // and so by clang
#else
constexpr bool is_sanitized = false;
#endif
#else
constexpr bool is_sanitized = false;
#endif

}  // namespace solidem

#endif
