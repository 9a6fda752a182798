// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_OUTPUT_FIRST_DIFFERENCE_HPP
#define SOLIDEM_OUTPUT_FIRST_DIFFERENCE_HPP

#include <string>

namespace solidem {

/// The first line in which two texts of lines `name = value` differ: "beams.radius_ratio = 0.3, not
/// 0.27", what the first says, then the second; "run.x = 1, not given" or "run.x not given, not 1"
/// where one of them does not say; empty when they are the same.
std::string first_difference(const std::string& first, const std::string& second);

}  // namespace solidem

#endif
