// SPDX-License-Identifier: GPL-2.0-or-later
//
// Specimens on disk. The format follows from the extension:
//   .h5    solidem specimen (HDF5), the only one that keeps everything
//   .data  data file of LIGGGHTS and LAMMPS, bonds included; written in the atom style `hybrid
//          granular molecular`, read in each that has diameters
//   .txt   YADE text, "x y z r" a line (yade.ymport.text reads it)
//   .csv   header "x,y,z,radius"
// Numbers are written with 17 digits, so a round trip keeps every bit of positions and radii. Text
// formats carry the body in comments (body_lines.hpp). Where it is not told the body is "imported":
// known by its spheres alone, its volume that of their cut cells (cut_cells.hpp), without walls.
#ifndef SOLIDEM_SPECIMEN_SPECIMEN_FILE_HPP
#define SOLIDEM_SPECIMEN_SPECIMEN_FILE_HPP

#include <optional>
#include <string>

#include "model/specimen.hpp"

namespace solidem {

class Hdf5File;

/// Reads a specimen. `body` is that of spheres whose file does not tell it; its volume may be 0 and
/// its shape "imported": not known. Throws InputError that names the file, the place (line,
/// element, bond), the value found and what would be right.
Specimen read_specimen(const std::string& path, const std::optional<Domain>& body = {});

/// Writes a specimen whole or not at all (output/replace_file.hpp). Throws InputError when the
/// extension is unknown and RunError when the file cannot be written.
void write_specimen(const std::string& path, const Specimen& specimen);

/// Puts a specimen into a file that is to hold more. The specimen must be sound.
void put_specimen(const Hdf5File& file, const Specimen& specimen);

/// Throws InputError at the first thing that is wrong with a specimen: no element, a position or
/// radius that is no number, a radius ≤ 0, an element far outside its body, two elements in one
/// place, a bond out of range, unsorted or twice, a set out of range, a periodic direction without
/// extent, a volume ≤ 0. `origin` opens the text ("bar.h5").
void check_specimen(const Specimen& specimen, const std::string& origin);

}  // namespace solidem

#endif
