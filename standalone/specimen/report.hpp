// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SPECIMEN_REPORT_HPP
#define SOLIDEM_SPECIMEN_REPORT_HPP

#include <string>

#include "model/specimen.hpp"

namespace solidem {

/// The figure of a report that is there where the volume of a body is an estimate, m³.
inline constexpr const char* estimated_volume = "estimated_volume";

/// Measures the specimen with its present bonds and stores the figures in `specimen.report`;
/// entries of other names stay. N elements, B bonds, n the unit vector of a bond:
///   solid_fraction             sum of sphere volumes / volume of the body
///   coordination_number        2B/N
///   bulk_coordination_number   bonds per element farther than 3 R_m from every wall (0: none)
///   bulk_elements              how many those are; 0 where walls are not known
///   fabric_x, _y, _z           diagonal of the mean of n ⊗ n, 1/3 each when isotropic
///   mean_overlap, max_overlap  of 1 − d/(R_i+R_j), over bonds that overlap
///   overlap_fraction           share of bonds with an overlap above 0.5 %
///   rattlers                   elements without a bond
///   largest_component          elements in the largest bonded body
///   mean_radius                R_m, m
///   mass_error                 relative difference between the sum of represented masses and ρ V
void measure_specimen(Specimen& specimen);

/// The figures as text to print, a line each.
std::string format_report(const Specimen& specimen);

}  // namespace solidem

#endif
