// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "pair_solidem_central.h"

#include <string.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_solidem_central.h"
#include "fix_solidem_damage.h"
#include "force.h"
#include "laws/central_interaction.hpp"
#include "laws/crack_face.hpp"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "solidem_restart.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

typedef solidem::Vector3<double> Vector;

Vector vector(const double* v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

PairSolidemCentral::PairSolidemCentral(LAMMPS* liggghts)
    : Pair(liggghts), memory_(NULL), damage_(NULL), list_is_current_(false) {
  single_enable = 1;
  restartinfo = 1;
  one_coeff = 1;
  no_virial_fdotr_compute = 1;  // pairs across ranks are worked out on both of them
}

PairSolidemCentral::~PairSolidemCentral() {
  if (modify->find_fix(FixSolidemCentral::ID) >= 0) modify->delete_fix(FixSolidemCentral::ID);
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairSolidemCentral::settings(int narg, char** arg) {
  settings_ = solidem_read_central(lmp, std::vector<std::string>(arg, arg + narg));
}

void PairSolidemCentral::coeff(int narg, char** arg) {
  if (narg != 2 || strcmp(arg[0], "*") != 0 || strcmp(arg[1], "*") != 0)
    error->all(FLERR,
               "Pair style solidem/central: pair_coeff takes '* *' and no more; the law and its "
               "parameters belong to pair_style");
  allocate();
  provide_memory();
}

void PairSolidemCentral::allocate() {
  if (allocated) return;
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 0; i < n; i++) std::fill_n(setflag[i], n, 1);
}

// After a restart the fix must come when what it remembers has been read.
void PairSolidemCentral::provide_memory() {
  if (modify->find_fix(FixSolidemCentral::ID) < 0) {
    const char* command[] = {FixSolidemCentral::ID, "all", "solidem/central"};
    modify->add_fix(3, const_cast<char**>(command));
  }
  memory_ = static_cast<FixSolidemCentral*>(modify->fix[modify->find_fix(FixSolidemCentral::ID)]);
}

void PairSolidemCentral::init_style() {
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR,
               "Pair style solidem/central needs atoms with radius and density, such as "
               "'atom_style granular'");
  if (settings_.remembers() && !atom->tag_enable)
    error->all(FLERR, "Pair style solidem/central needs atoms with ids");
  if (settings_.dissipation > 0.0 && !comm->ghost_velocity)
    error->all(FLERR, "Pair style solidem/central: dissipation needs 'communicate single vel yes'");
  provide_memory();
  damage_ = NULL;
  for (int k = 0; k < modify->nfix; k++)
    if (FixSolidemDamage* found = dynamic_cast<FixSolidemDamage*>(modify->fix[k])) damage_ = found;

  std::vector<double> radius(atom->ntypes + 1, 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    radius[atom->type[i]] = std::max(radius[atom->type[i]], atom->radius[i]);
  largest_radius_.resize(radius.size());
  MPI_Allreduce(radius.data(), largest_radius_.data(), static_cast<int>(radius.size()), MPI_DOUBLE,
                MPI_MAX, world);
  if (settings_.remembers()) require_wide_cell();

  const int request = neighbor->request(this);
  neighbor->requests[request]->newton = 2;  // every rank lists all pairs of its own atoms
}

// Pairs are known by the atoms' ids: an atom must not meet two images of another.
void PairSolidemCentral::require_wide_cell() const {
  const double largest = *std::max_element(largest_radius_.begin(), largest_radius_.end());
  const double least = 4.0 * settings_.reach() * largest;
  for (int k = 0; k < 3; k++)
    if (domain->periodicity[k] && domain->prd[k] < least) {
      char why[256];
      snprintf(why, sizeof why,
               "Pair style solidem/central: the periodic cell is %g wide in %c, but must be %g, "
               "twice the reach of the largest atoms, so that ids tell pairs; only 'equilibrium "
               "radii' with 'neighbours changing' does without",
               domain->prd[k], "xyz"[k], least);
      error->all(FLERR, why);
    }
}

double PairSolidemCentral::init_one(int i, int j) {
  return settings_.reach() * (largest_radius_[i] + largest_radius_[j]);
}

const std::vector<PairSolidemCentral::Listed>& PairSolidemCentral::listed() {
  if (list_is_current_) return listed_;
  if (settings_.remembers() && !memory_->knows()) remember_initial_pairs();
  make_list();
  make_columns();
  list_is_current_ = true;
  return listed_;
}

/* ----------------------------------------------------------------------
   the start: who is near whom, and how far away
------------------------------------------------------------------------- */

void PairSolidemCentral::remember_initial_pairs() {
  for (int k = 0; k < list->inum; k++) {
    const int i = list->ilist[k];
    for (int m = 0; m < list->numneigh[i]; m++) {
      const int j = list->firstneigh[i][m] & NEIGHMASK;
      const Vector chord = vector(atom->x[j]) - vector(atom->x[i]);
      const double distance = std::sqrt(dot(chord, chord));
      if (!settings_.is_initial(distance, atom->radius[i] + atom->radius[j])) continue;
      memory_->keep(i, atom->tag[j], distance);
      if (j < atom->nlocal) memory_->keep(j, atom->tag[i], distance);
    }
  }
  memory_->end_of_keeping();
}

/* ----------------------------------------------------------------------
   of LIGGGHTS' list, which goes by the largest radii, those pairs that may
   come within their own range before the next list is built
------------------------------------------------------------------------- */

void PairSolidemCentral::make_list() {
  listed_.clear();
  for (int k = 0; k < list->inum; k++) {
    const int i = list->ilist[k];
    for (int m = 0; m < list->numneigh[i]; m++) {
      const int j = list->firstneigh[i][m] & NEIGHMASK;
      const Vector chord = vector(atom->x[j]) - vector(atom->x[i]);
      const double radii = atom->radius[i] + atom->radius[j];
      const double farthest = settings_.range * radii + neighbor->skin;
      if (dot(chord, chord) > farthest * farthest) continue;
      const double kept = settings_.remembers() ? memory_->initial_distance(i, atom->tag[j]) : 0.0;
      if (settings_.fixed_neighbours && kept == 0.0) continue;
      listed_.push_back({i, j, settings_.initial_distance && kept > 0.0 ? kept : radii});
    }
  }
}

double PairSolidemCentral::equilibrium(int i, int j) const {
  const double kept = settings_.initial_distance ? memory_->initial_distance(i, atom->tag[j]) : 0.0;
  return kept > 0.0 ? kept : atom->radius[i] + atom->radius[j];
}

PairSolidemCentral::Seen PairSolidemCentral::see(int i, int j) const {
  Seen seen;
  seen.chord = vector(atom->x[j]) - vector(atom->x[i]);
  const double square = dot(seen.chord, seen.chord);
  seen.distance = std::sqrt(square);
  // Between two atoms at one place no force has a direction.
  seen.inside = seen.distance < settings_.range * (atom->radius[i] + atom->radius[j]) &&
                square > solidem::tiny_square &&
                !(damage_ && (damage_->is_removed(i) || damage_->is_removed(j)));
  return seen;
}

bool PairSolidemCentral::are_on_opposite_faces(int i, int j, const Vector& chord) const {
  return damage_ && damage_->finds_crack_faces() &&
         solidem::on_opposite_faces(damage_->barycentre(i), damage_->barycentre(j), chord);
}

/* ----------------------------------------------------------------------
   without dissipation: that is no property of a pair of places
------------------------------------------------------------------------- */

double PairSolidemCentral::single(int i, int j, int, int, double square, double, double,
                                  double& force_over_distance) {
  force_over_distance = 0.0;
  const double range = settings_.range * (atom->radius[i] + atom->radius[j]);
  const double distance = std::sqrt(square);
  if (!(distance < range) || !(square > solidem::tiny_square)) return 0.0;
  if (damage_ && (damage_->is_removed(i) || damage_->is_removed(j))) return 0.0;
  const double rest = equilibrium(i, j);
  if (settings_.fixed_neighbours && memory_->initial_distance(i, atom->tag[j]) == 0.0) return 0.0;
  const Vector chord = vector(atom->x[j]) - vector(atom->x[i]);
  return std::visit(
      [&](const auto& law) {
        const double push =
            solidem::central_force(law, settings_.interpenetration, distance, rest).force;
        if (push >= 0.0 || !are_on_opposite_faces(i, j, chord))
          force_over_distance = push / distance;
        return solidem::central_potential(law, settings_.interpenetration, range, distance, rest);
      },
      settings_.law);
}

void PairSolidemCentral::write_restart(FILE* fp) {
  write_restart_settings(fp);
}

void PairSolidemCentral::read_restart(FILE* fp, const int major, const int minor) {
  read_restart_settings(fp, major, minor);
  allocate();
}

// As the words of the command.
void PairSolidemCentral::write_restart_settings(FILE* fp) {
  const std::string words = solidem_write_central(settings_);
  const int length = static_cast<int>(words.size());
  const double checksum = solidem_checksum(words.data(), words.size());
  fwrite(&length, sizeof(int), 1, fp);
  fwrite(&checksum, sizeof(double), 1, fp);
  fwrite(words.data(), 1, words.size(), fp);
}

// On rank 0.
std::string PairSolidemCentral::read_words(FILE* fp) {
  const int longest = 10000;
  int length = 0;
  double checksum = 0.0;
  std::string words;
  if (fread(&length, sizeof(int), 1, fp) == 1 && fread(&checksum, sizeof(double), 1, fp) == 1 &&
      length > 0 && length < longest) {
    words.resize(length);
    words.resize(fread(&words[0], 1, length, fp));
  }
  if (words.empty() || checksum != solidem_checksum(words.data(), words.size()))
    error->one(FLERR,
               "The restart file is damaged, or of another version: the settings of pair style "
               "solidem/central do not match their checksum");
  return words;
}

void PairSolidemCentral::read_restart_settings(FILE* fp, const int, const int) {
  std::string text;
  if (comm->me == 0) text = read_words(fp);
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  text.resize(length);
  MPI_Bcast(&text[0], length, MPI_CHAR, 0, world);
  std::vector<std::string> words;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find(' ', at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  settings_ = solidem_read_central(lmp, words);
}

double PairSolidemCentral::memory_usage() {
  return Pair::memory_usage() + static_cast<double>(listed_.capacity() * sizeof(Listed));
}
