// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_LAWS_CONSTANTS_HPP
#define SOLIDEM_LAWS_CONSTANTS_HPP

namespace solidem {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double two_pi = 2 * pi;

}  // namespace solidem

#endif
