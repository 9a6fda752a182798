// SPDX-License-Identifier: GPL-2.0-or-later
//
// The outline of a specimen in its HDF5 file: the group `outline`, with the mesh that bounds it in
// `surface` and its cuts in `cuts`, by their number; of several bodies, in `bodies`, how each was
// made and put in its place.
#ifndef SOLIDEM_SPECIMEN_OUTLINE_FILE_HPP
#define SOLIDEM_SPECIMEN_OUTLINE_FILE_HPP

#include <memory>

#include "model/outline.hpp"

namespace solidem {

class Hdf5Group;

void write_outline(const Hdf5Group& file, const Outline& outline);

/// Null where the file has none. Throws InputError where what it has bounds no body, or not this
/// one.
std::shared_ptr<const Outline> read_outline(const Hdf5Group& file, const Domain& body);

}  // namespace solidem

#endif
