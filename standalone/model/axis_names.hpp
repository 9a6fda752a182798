// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_AXIS_NAMES_HPP
#define SOLIDEM_MODEL_AXIS_NAMES_HPP

namespace solidem {

/// The axes as they end the names of figures: force_x.
inline constexpr const char* axis_names[] = {"x", "y", "z"};

}  // namespace solidem

#endif
