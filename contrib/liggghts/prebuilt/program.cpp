// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
//
// LIGGGHTS with the styles of ../src, on the library that is already built.
#include <mpi.h>

#include "input.h"
#include "lammps.h"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  LAMMPS_NS::LAMMPS* liggghts = new LAMMPS_NS::LAMMPS(argc, argv, MPI_COMM_WORLD);
  liggghts->input->file();
  delete liggghts;
  MPI_Finalize();
}
