// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_RESTART_H
#define LMP_SOLIDEM_RESTART_H

#include <stdio.h>

#include <cstddef>
#include <vector>

namespace LAMMPS_NS {

// The styles' own part of a restart file bears a checksum, so that a file that was cut or damaged
// there is refused with words. LIGGGHTS itself checks nothing of what it reads.

/// Tells whether bytes are those that were written: FNV-1a of 32 bits, exact as a double.
double solidem_checksum(const void* bytes, std::size_t count);

/// Numbers of a fix as a whole, for Fix::write_restart on rank 0.
void solidem_write_restart(FILE* fp, const std::vector<double>& numbers);
/// These `count` numbers again, for Fix::restart; ends with an error if they are others.
std::vector<double> solidem_read_restart(class Error* error, class Fix* fix, const char* buffer,
                                         int count);

/// Numbers that a fix stores with one atom.
struct SolidemStored {
  const double* numbers;
  int count;
};
/// How many numbers stand before those of an atom: LIGGGHTS wants the length, then the checksum.
const int SOLIDEM_RESTART_HEAD = 2;
/// Closes the record of an atom whose `count` numbers stand at buffer + SOLIDEM_RESTART_HEAD; its
/// length, for Fix::pack_restart.
int solidem_seal(double* buffer, int count);
/// Record `nth` of local atom i, for Fix::unpack_restart; ends with an error if it is damaged.
SolidemStored solidem_unseal(class Error* error, const class Atom* atom, class Fix* fix, int i,
                             int nth);
/// Ends with the error that the record of local atom i is damaged.
void solidem_damaged(class Error* error, const class Atom* atom, class Fix* fix, int i);

}  // namespace LAMMPS_NS

#endif
