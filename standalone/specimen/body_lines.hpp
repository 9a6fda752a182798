// SPDX-License-Identifier: GPL-2.0-or-later
//
// The body in text formats, which have no place for it: comments such as "# solidem shape
// cylinder", one for each of shape, lower, upper, periodic, volume, axis, radius, inner_radius,
// angle, cuts.
#ifndef SOLIDEM_SPECIMEN_BODY_LINES_HPP
#define SOLIDEM_SPECIMEN_BODY_LINES_HPP

#include <string>

#include "model/specimen.hpp"
#include "specimen/text_lines.hpp"

namespace solidem {

/// The comments of a specimen's body; none of a body that is known by its spheres alone.
std::string body_lines(const Specimen& specimen);

/// Reads such comments into a domain; what they do not name stays. Throws InputError with the line.
void read_body_lines(const std::string& text, const std::string& path, Domain& domain);

/// The domain of bare spheres: the box around them, shape "imported", volume 0 (not known).
void put_in_box(Specimen& specimen);

/// The contact margin of a specimen whose numbers were written with a precision: up to 1e-3.
double contact_margin(const DecimalPrecision& precision, const Specimen& specimen);
/// The same for positions that are off by up to `round_off`, m.
double contact_margin(double round_off, const Specimen& specimen);

/// The largest component of all positions, m.
double largest_coordinate(const Specimen& specimen);

}  // namespace solidem

#endif
