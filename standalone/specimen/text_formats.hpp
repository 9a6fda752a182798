// SPDX-License-Identifier: GPL-2.0-or-later
//
// Specimens as text for other codes; `specimen_file.hpp` says what the formats are.
#ifndef SOLIDEM_SPECIMEN_TEXT_FORMATS_HPP
#define SOLIDEM_SPECIMEN_TEXT_FORMATS_HPP

#include <string>

#include "model/specimen.hpp"

namespace solidem {

/// The file's content. LIGGGHTS data: atom id = element + 1, one atom type and one bond type,
/// columns `id type x y z diameter density molecule`, with the density that makes a body of 1
/// kg/m³; multiply it by the material's.
std::string liggghts_text(const Specimen& specimen);
std::string yade_text(const Specimen& specimen);
std::string csv_text(const Specimen& specimen);

/// The specimen in a file's content; `path` is for messages. The domain is the box around the
/// spheres. Bonds come with LIGGGHTS data only. Throws InputError with the line.
Specimen specimen_of_liggghts_text(const std::string& text, const std::string& path);
Specimen specimen_of_yade_text(const std::string& text, const std::string& path);
Specimen specimen_of_csv_text(const std::string& text, const std::string& path);

}  // namespace solidem

#endif
