// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_restart.h"

#include <stdint.h>
#include <string.h>

#include <string>

#include "atom.h"
#include "error.h"
#include "fix.h"

namespace LAMMPS_NS {

double solidem_checksum(const void* bytes, std::size_t count) {
  const unsigned char* byte = static_cast<const unsigned char*>(bytes);
  uint32_t sum = 2166136261U;
  for (std::size_t k = 0; k < count; k++) sum = (sum ^ byte[k]) * 16777619U;
  return sum;
}

void solidem_write_restart(FILE* fp, const std::vector<double>& numbers) {
  const double head[2] = {solidem_checksum(numbers.data(), numbers.size() * sizeof(double)),
                          static_cast<double>(numbers.size())};
  const int bytes = static_cast<int>(sizeof head + numbers.size() * sizeof(double));
  fwrite(&bytes, sizeof(int), 1, fp);
  fwrite(head, sizeof(double), 2, fp);
  fwrite(numbers.data(), sizeof(double), numbers.size(), fp);
}

std::vector<double> solidem_read_restart(Error* error, Fix* fix, const char* buffer, int count) {
  double head[2];
  memcpy(head, buffer, sizeof head);
  std::vector<double> numbers(count);
  if (head[1] == count) memcpy(numbers.data(), buffer + sizeof head, count * sizeof(double));
  if (head[1] != count || head[0] != solidem_checksum(numbers.data(), count * sizeof(double)))
    error->fix_error(FLERR, fix,
                     "the restart file is damaged, or of another version, or this fix has other "
                     "words now: what this fix wrote into it does not match its checksum");
  return numbers;
}

int solidem_seal(double* buffer, int count) {
  const int length = count + SOLIDEM_RESTART_HEAD;
  buffer[0] = length;
  buffer[1] = solidem_checksum(buffer + SOLIDEM_RESTART_HEAD, count * sizeof(double));
  return length;
}

SolidemStored solidem_unseal(Error* error, const Atom* atom, Fix* fix, int i, int nth) {
  const double* record = atom->extra[i];
  int left = atom->nextra_store;
  for (int before = 0; before <= nth; before++) {
    if (left < 1 || !(record[0] >= 1.0 && record[0] <= left)) solidem_damaged(error, atom, fix, i);
    if (before == nth) break;
    left -= static_cast<int>(record[0]);
    record += static_cast<int>(record[0]);
  }
  const SolidemStored stored = {record + SOLIDEM_RESTART_HEAD,
                                static_cast<int>(record[0]) - SOLIDEM_RESTART_HEAD};
  if (stored.count < 0 ||
      record[1] != solidem_checksum(stored.numbers, stored.count * sizeof(double)))
    solidem_damaged(error, atom, fix, i);
  return stored;
}

void solidem_damaged(Error* error, const Atom* atom, Fix* fix, int i) {
  error->one(FLERR, ("Fix " + std::string(fix->style) + " (id " + fix->id +
                     "): the restart file is damaged, or of another version: the record of atom " +
                     std::to_string(atom->tag[i]) + " does not match its checksum")
                        .c_str());
}

}  // namespace LAMMPS_NS
