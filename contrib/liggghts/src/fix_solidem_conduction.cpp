// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_conduction.h"

#include <stdio.h>
#include <string.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_property_atom.h"
#include "fix_solidem_exchange.h"
#include "force.h"
#include "laws/heat_exchange.hpp"
#include "laws/platonic_conduction.hpp"
#include "modify.h"
#include "neighbor.h"
#include "solidem_cells.h"
#include "solidem_reach.h"
#include "solidem_restart.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixSolidemConduction::FixSolidemConduction(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      conductivity(0.0),
      specific_heat(0.0),
      density(0.0),
      initial_temperature(0.0),
      area_factor(0.0),
      volume(0.0),
      capacity_factor(0.0),
      bond_value(NULL),
      values(NULL),
      step_of_capacities(-1.0),
      checked_step(-1.0),
      leads_(false),
      leaves_forces_(false),
      contacts_heat_(false),
      every_(1),
      waited_(0),
      waited_time_(0.0),
      temperature(NULL),
      heat_flux(NULL),
      heat_source(NULL),
      coordination(NULL),
      cell_volume(NULL),
      waiting_heat(NULL) {
  if (igroup != 0) error->fix_error(FLERR, this, "must be used with group 'all'");
  if (!atom->avec->bonds_allow || !atom->radius_flag)
    error->fix_error(FLERR, this, "needs 'atom_style hybrid granular molecular'");
  read_arguments(narg, arg);

  scalar_flag = 1;
  global_freq = 1;
  extscalar = 1;
  restart_global = 1;
  restart_peratom = 1;
  values = new SolidemBondValues(liggghts, bond_value, law == "voronoi" ? 2 : 1);
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixSolidemConduction::~FixSolidemConduction() {
  if (!values) return;
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  delete values;
}

void FixSolidemConduction::read_arguments(int narg, char** arg) {
  bool has_temperature = false;
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (iarg + 1 == narg) error->fix_error(FLERR, this, ("keyword without value: " + key).c_str());
    if (key == "law") {
      law = arg[iarg + 1];
      if (law != "platonic" && law != "platonic-calibrated" && law != "voronoi")
        error->fix_error(
            FLERR, this,
            ("unknown law '" + law + "': known are platonic, platonic-calibrated, voronoi")
                .c_str());
      continue;
    }
    if (key == "file") {
      file = arg[iarg + 1];
      continue;
    }
    if (key == "every") {
      every_ = force->inumeric(FLERR, arg[iarg + 1]);
      if (every_ < 1)
        error->fix_error(
            FLERR, this,
            ("every is a number of steps, 1 at least, but is " + std::string(arg[iarg + 1]))
                .c_str());
      continue;
    }
    const double value = force->numeric(FLERR, arg[iarg + 1]);
    if (key == "initial_temperature") {
      if (!(value >= 0.0))
        error->fix_error(FLERR, this,
                         ("initial_temperature is counted from absolute zero and must not be below "
                          "it, but is " +
                          std::string(arg[iarg + 1]))
                             .c_str());
      initial_temperature = value;
      has_temperature = true;
      continue;
    }
    if (value <= 0.0) error->fix_error(FLERR, this, (key + " must be positive").c_str());
    if (key == "conductivity")
      conductivity = value;
    else if (key == "specific_heat")
      specific_heat = value;
    else if (key == "density")
      density = value;
    else if (key == "area_factor")
      area_factor = value;
    else if (key == "volume")
      volume = value;
    else
      error->fix_error(FLERR, this,
                       ("unknown keyword '" + key +
                        "': known are law, conductivity, specific_heat, density, "
                        "initial_temperature, area_factor, volume, file, every")
                           .c_str());
  }
  if (law.empty() || conductivity == 0.0 || specific_heat == 0.0 || density == 0.0 ||
      !has_temperature)
    error->fix_error(FLERR, this,
                     "needs all of: law, conductivity, specific_heat, density, "
                     "initial_temperature");
  const bool calibrated = law == "platonic-calibrated";
  if (calibrated != (area_factor > 0.0) || calibrated != (volume > 0.0))
    error->fix_error(FLERR, this,
                     "law platonic-calibrated needs both area_factor and volume, others neither");
  if ((law == "voronoi") != !file.empty())
    error->fix_error(FLERR, this, "law voronoi needs file, others do not");
  if (!calibrated) area_factor = capacity_factor = 1.0;
}

// The property of that name, made if there is none. LIGGGHTS gives a new property its initial value
// again at the end of the first set-up, unless that value is "none".
FixPropertyAtom* FixSolidemConduction::property(const char* name, const char* initial,
                                                const char* forward, const char* reverse) {
  Fix* found = modify->find_fix_property(name, "property/atom", "scalar", 0, 0, style, false);
  if (found) return static_cast<FixPropertyAtom*>(found);
  const char* command[] = {name,  "all",   "property/atom", name,   "scalar",
                           "yes", forward, reverse,         initial};
  FixPropertyAtom* made = modify->add_fix_property_atom(9, const_cast<char**>(command), style);
  if (strcmp(initial, "none") == 0 && !made->restart_reset)
    std::fill_n(made->vector_atom, atom->nlocal, 0.0);
  return made;
}

void FixSolidemConduction::post_create() {
  find_properties();
}

int FixSolidemConduction::setmask() {
  return POST_INTEGRATE | PRE_FORCE | POST_FORCE | FINAL_INTEGRATE;
}

void FixSolidemConduction::init() {
  find_properties();
  find_what_bonds_ask();
  if (law == "voronoi") see_cells();
}

void FixSolidemConduction::find_properties() {
  char initial[32];
  snprintf(initial, sizeof initial, "%.17g", initial_temperature);
  temperature = property("Temp", initial, "yes", "no");
  heat_flux = property("heatFlux", "0", "no", "yes");
  heat_source = property("heatSource", "0", "no", "no");
  if (law == "voronoi")
    cell_volume = property("cellVolume", "none", "no", "no");
  else
    coordination = property("coordination", "none", "yes", "yes");
}

/* ----------------------------------------------------------------------
   distance up to which a rank must know its neighbours' atoms
------------------------------------------------------------------------- */

double FixSolidemConduction::extend_cut_ghost() {
  const double usual = solidem_reach(atom, world);
  if (law != "voronoi") return usual;
  double local = 0.0, longest;  // faces join atoms that do not touch
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < atom->num_bond[i]; m++) local = std::max(local, bond_value[i][m][0]);
  MPI_Allreduce(&local, &longest, 1, MPI_DOUBLE, MPI_MAX, world);
  return std::max(usual, 1.1 * longest);
}

void FixSolidemConduction::setup_pre_force(int) {
  build_conductors();
}

void FixSolidemConduction::setup(int) {
  require_temperatures();
  require_stable_step();
  leave_forces(!somebody_acts());
}

// Indices of atoms hold until the neighbour lists are built anew.
void FixSolidemConduction::pre_force(int) {
  if (neighbor->ago == 0) build_conductors();
  if (neighbor->ago == 0 && leaves_forces_) clear_forces();
  std::fill_n(heat_flux->vector_atom, atom->nlocal + atom->nghost, 0.0);
}

bool FixSolidemConduction::any_rank(bool here) const {
  int one = here, any;
  MPI_Allreduce(&one, &any, 1, MPI_INT, MPI_MAX, world);
  return any != 0;
}

/* ----------------------------------------------------------------------
   the image of the atom bond m of atom i leads to that is nearest to atom i
------------------------------------------------------------------------- */

int FixSolidemConduction::partner(int i, int m) const {
  const int j = atom->map(atom->bond_atom[i][m]);
  if (j < 0) {
    char message[160];
    snprintf(message, sizeof message,
             "Fix solidem/conduction: the bond of atoms %d and %d is longer than %s", atom->tag[i],
             atom->bond_atom[i][m], law == "voronoi" ? "1.1 faces' distances" : "two diameters");
    error->one(FLERR, message);
  }
  return domain->closest_image(i, j);
}

/* ----------------------------------------------------------------------
   rest distances of bonds seen for the first time; true if any rank saw one
------------------------------------------------------------------------- */

bool FixSolidemConduction::see_new_bonds() {
  bool seen = false;
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < atom->num_bond[i]; m++) {
      double& distance = bond_value[i][m][0];
      if (distance != 0.0) continue;
      seen = true;
      const double* a = atom->x[i];
      const double* b = atom->x[partner(i, m)];
      distance = sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                      (b[2] - a[2]) * (b[2] - a[2]));
    }
  return any_rank(seen);
}

/* ----------------------------------------------------------------------
   law voronoi: faces of the bonds and volumes of the atoms from the file,
   unless they came with a restart file
------------------------------------------------------------------------- */

void FixSolidemConduction::see_cells() {
  values->settle_all();
  bool unseen = false;
  for (int i = 0; i < atom->nlocal; i++) {
    unseen = unseen || cell_volume->vector_atom[i] == 0.0;
    for (int m = 0; m < atom->num_bond[i]; m++) unseen = unseen || bond_value[i][m][0] == 0.0;
  }
  if (!any_rank(unseen)) return;

  const SolidemCells cells(lmp, file);
  char message[120];
  double count = 0.0, bonds;
  for (int i = 0; i < atom->nlocal; i++) {
    cell_volume->vector_atom[i] = cells.volume(atom->tag[i]);
    if (cell_volume->vector_atom[i] == 0.0) {
      snprintf(message, sizeof message, "Fix solidem/conduction: no volume of atom %d in ",
               atom->tag[i]);
      error->one(FLERR, (message + file).c_str());
    }
    for (int m = 0; m < atom->num_bond[i]; m++) {
      const int other = atom->bond_atom[i][m];
      const SolidemCells::Face* face = cells.face(atom->tag[i], other);
      if (!face) {
        snprintf(message, sizeof message,
                 "Fix solidem/conduction: no face for the bond of atoms %d and %d in ",
                 atom->tag[i], other);
        error->one(FLERR, (message + file).c_str());
      }
      bond_value[i][m][0] = face->distance;
      bond_value[i][m][1] = face->area;
      count += force->newton_bond ? 1.0 : 0.5;
    }
  }
  MPI_Allreduce(&count, &bonds, 1, MPI_DOUBLE, MPI_SUM, world);
  if (bonds == static_cast<double>(cells.faces())) return;
  snprintf(message, sizeof message,
           " has %.0f faces, the body %.0f bonds: each face needs its bond",
           static_cast<double>(cells.faces()), bonds);
  error->fix_error(FLERR, this, (file + message).c_str());
}

// The number of bonds of every local atom; with newton_bond on only one of the two atoms lists a
// bond.
void FixSolidemConduction::count_bonds() {
  double* count = coordination->vector_atom;
  std::fill_n(count, atom->nlocal + atom->nghost, 0.0);
  for (int i = 0; i < atom->nlocal; i++) {
    count[i] += atom->num_bond[i];
    if (!force->newton_bond) continue;
    for (int m = 0; m < atom->num_bond[i]; m++) count[partner(i, m)] += 1.0;
  }
  if (force->newton_bond) coordination->do_reverse_comm();
}

// Law platonic-calibrated: the capacities of all atoms add up to that of the body.
void FixSolidemConduction::scale_capacities() {
  capacity_factor = 1.0;
  double capacity = 0.0, total;
  for (int i = 0; i < atom->nlocal; i++) capacity += heat_capacity(i);
  MPI_Allreduce(&capacity, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  capacity_factor = specific_heat * density * volume / total;
}

void FixSolidemConduction::build_conductors() {
  values->settle_all();
  if (law != "voronoi") {
    const bool new_bonds = see_new_bonds();
    if (new_bonds) count_bonds();
    coordination->do_forward_comm();
    if (law == "platonic-calibrated" && (new_bonds || capacity_factor == 0.0)) scale_capacities();
  }
  conductors.clear();
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < atom->num_bond[i]; m++) {
      const int j = partner(i, m);
      if (!force->newton_bond && i > j) continue;  // the bond is listed by both
      const double distance = bond_value[i][m][0];
      conductors.push_back(
          {i, j, solidem::path_conductance(conductivity, area(i, m, j), distance)});
    }
  lay_out_conductors();
  step_of_capacities = -1.0;
}

// In the order of the bonds, for each atom.
void FixSolidemConduction::lay_out_conductors() {
  const int nlocal = atom->nlocal, blocks = (nlocal + 7) / 8;
  std::vector<int> sides(8 * blocks, 0);
  for (const Conductor& bond : conductors) {
    sides[bond.i]++;
    if (bond.j < nlocal) sides[bond.j]++;
  }
  first_row.assign(1, 0);
  for (int block = 0; block < blocks; block++)
    first_row.push_back(first_row.back() + *std::max_element(sides.begin() + 8 * block,
                                                             sides.begin() + 8 * block + 8));
  row_conductance.assign(first_row.back(), SolidemRow());
  neighbour.resize(8 * first_row.back());
  for (int block = 0; block < blocks; block++)
    for (int slot = 8 * first_row[block]; slot < 8 * first_row[block + 1]; slot++)
      neighbour[slot] = std::min(8 * block + slot % 8, nlocal - 1);
  std::fill(sides.begin(), sides.end(), 0);
  const auto add = [&](int i, int j, double conductance) {
    const int row = first_row[i / 8] + sides[i]++;
    neighbour[8 * row + i % 8] = j;
    row_conductance[row].number[i % 8] = conductance;
  };
  outward.clear();
  for (const Conductor& bond : conductors) {
    add(bond.i, bond.j, bond.conductance);
    if (bond.j < nlocal)
      add(bond.j, bond.i, bond.conductance);
    else if (force->newton_bond)
      outward.push_back(bond);
  }
}

// Transmission area of bond m of atom i, which leads to atom j.
double FixSolidemConduction::area(int i, int m, int j) const {
  if (law == "voronoi") return bond_value[i][m][1];
  const solidem::PlatonicElement side_i = {atom->radius[i], coordination->vector_atom[i]};
  const solidem::PlatonicElement side_j = {atom->radius[j], coordination->vector_atom[j]};
  return area_factor * solidem::platonic_transmission_area(side_i, side_j);
}

double FixSolidemConduction::heat_capacity(int i) const {
  if (law == "voronoi") return specific_heat * density * cell_volume->vector_atom[i];
  const solidem::PlatonicElement element = {atom->radius[i], coordination->vector_atom[i]};
  return capacity_factor * solidem::platonic_heat_capacity(element, density, specific_heat);
}

double FixSolidemConduction::effusivity() const {
  return sqrt(conductivity * density * specific_heat);
}

void FixSolidemConduction::find_steps(double time) {
  step_over_capacity.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) step_over_capacity[i] = time / heat_capacity(i);
  step_of_capacities = time;
}

void FixSolidemConduction::require_temperatures() const {
  for (int i = 0; i < atom->nlocal; i++)
    if (!(temperature->vector_atom[i] >= 0.0))
      error->one(FLERR, ("Fix solidem/conduction: atom " + std::to_string(atom->tag[i]) + " has " +
                         std::to_string(temperature->vector_atom[i]) +
                         " K; temperatures are counted from absolute zero")
                            .c_str());
}

/* ----------------------------------------------------------------------
   thermal energy of all atoms, J
------------------------------------------------------------------------- */

double FixSolidemConduction::compute_scalar() {
  double energy = 0.0, total;
  for (int i = 0; i < atom->nlocal; i++) energy += heat_capacity(i) * temperature->vector_atom[i];
  MPI_Allreduce(&energy, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  return total;
}

// Of the clock; all else stands with the atoms.
void FixSolidemConduction::write_restart(FILE* fp) {
  if (comm->me != 0) return;
  solidem_write_restart(fp, {static_cast<double>(waited_), waited_time_});
}

void FixSolidemConduction::restart(char* buffer) {
  const std::vector<double> clock = solidem_read_restart(error, this, buffer, 2);
  waited_ = static_cast<int>(clock[0]);
  waited_time_ = clock[1];
}

void FixSolidemConduction::grow_arrays(int nmax) {
  values->grow(nmax);
}
void FixSolidemConduction::copy_arrays(int i, int j, int) {
  values->copy(i, j);
}
void FixSolidemConduction::set_arrays(int i) {
  values->clear(i);
}
int FixSolidemConduction::pack_exchange(int i, double* buffer) {
  return values->pack_exchange(i, buffer);
}
int FixSolidemConduction::unpack_exchange(int i, double* buffer) {
  return values->unpack_exchange(i, buffer);
}
int FixSolidemConduction::pack_restart(int i, double* buffer) {
  return values->pack_restart(i, buffer);
}
void FixSolidemConduction::unpack_restart(int i, int nth) {
  values->unpack_restart(this, i, nth);
}
int FixSolidemConduction::size_restart(int i) {
  return values->size_restart(i);
}
int FixSolidemConduction::maxsize_restart() {
  return values->maxsize_restart();
}
double FixSolidemConduction::memory_usage() {
  return values->memory_usage() + (conductors.capacity() + outward.capacity()) * sizeof(Conductor) +
         (first_row.capacity() + neighbour.capacity()) * sizeof(int) +
         row_conductance.capacity() * sizeof(SolidemRow) +
         step_over_capacity.capacity() * sizeof(double);
}
