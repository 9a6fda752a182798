// SPDX-License-Identifier: GPL-2.0-or-later
//
// The continuous body of a specimen in an HDF5 file: attributes of a group.
#ifndef SOLIDEM_SPECIMEN_DOMAIN_FILE_HPP
#define SOLIDEM_SPECIMEN_DOMAIN_FILE_HPP

#include <string>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

class Hdf5Group;

/// A vector as the three numbers of an attribute, and back.
std::vector<double> row_of(const Vector& v);
Vector read_vector(const Hdf5Group& group, const std::string& name);

void write_domain(const Hdf5Group& group, const Domain& body);
Domain read_domain(const Hdf5Group& group);

}  // namespace solidem

#endif
