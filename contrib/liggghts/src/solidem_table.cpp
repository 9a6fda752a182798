// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_table.h"

#include <mpi.h>

#include <fstream>
#include <sstream>

#include "comm.h"
#include "error.h"

namespace LAMMPS_NS {

namespace {

// Lines that say something, with their numbers.
struct Lines {
  std::ifstream stream;
  long number;

  explicit Lines(const std::string& file) : stream(file.c_str()), number(0) {}

  bool next(std::string& line) {
    while (std::getline(stream, line)) {
      ++number;
      const std::size_t start = line.find_first_not_of(" \t\r");
      if (start != std::string::npos && line[start] != '#') return true;
    }
    return false;
  }
};

// On one rank; the complaint, or nothing.
std::string read_section(const std::string& file, const std::string& section, int columns,
                         std::vector<double>& rows) {
  Lines lines(file);
  if (!lines.stream) return file + " cannot be read";
  std::string line, found;
  while (lines.next(line)) {
    std::ostringstream place;
    place << file << ", line " << lines.number << ": ";
    std::istringstream header(line);
    std::string name, rest;
    long count = -1;
    if (!(header >> name >> count) || count < 0 || header >> rest)
      return place.str() + "'" + line + "' where a section, NAME COUNT, should begin";
    found += (found.empty() ? "" : ", ") + name;
    const bool wanted = name == section;
    for (long row = 0; row < count; ++row) {
      if (!lines.next(line)) {
        std::ostringstream message;
        message << file << " ends after " << row << " of " << count << " rows of '" << name << "'";
        return message.str();
      }
      if (!wanted) continue;
      std::istringstream words(line);
      double value;
      int read = 0;
      while (words >> value) {
        rows.push_back(value);
        ++read;
      }
      if (read != columns || !words.eof()) {
        std::ostringstream message;
        message << file << ", line " << lines.number << ": '" << line << "' where a row of '"
                << name << "' should have " << columns << " numbers";
        return message.str();
      }
    }
    if (wanted) return "";
  }
  return file + " has no section '" + section + "'; it has: " + (found.empty() ? "none" : found);
}

}  // namespace

std::vector<double> solidem_table(LAMMPS* liggghts, const std::string& file,
                                  const std::string& section, int columns) {
  std::vector<double> rows;
  std::string complaint;
  if (liggghts->comm->me == 0) complaint = read_section(file, section, columns, rows);
  double size = complaint.empty() ? static_cast<double>(rows.size()) : -1.0;
  MPI_Bcast(&size, 1, MPI_DOUBLE, 0, liggghts->world);
  if (size < 0.0) liggghts->error->all(FLERR, complaint.c_str());
  rows.resize(static_cast<std::size_t>(size));
  MPI_Bcast(rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE, 0, liggghts->world);
  return rows;
}

}  // namespace LAMMPS_NS
