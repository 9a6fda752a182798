// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "fix_solidem_bonds.h"

#include <string.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "atom.h"
#include "atom_vec.h"
#include "bond_solidem_beam.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_property_atom.h"
#include "force.h"
#include "laws/rigid_sphere.hpp"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "solidem_reach.h"
#include "solidem_restart.h"
#include "solidem_waiting_heat.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

typedef SolidemBondMemory Row;

// Comm packs an atom's data behind slack of a thousand numbers; other fixes want some too.
const int MOST_NUMBERS_OF_AN_ATOM = 800;

}  // namespace

FixSolidemBonds::FixSolidemBonds(LAMMPS* liggghts, int narg, char** arg)
    : Fix(liggghts, narg, arg),
      history(NULL),
      list_is_current(false),
      contacts(liggghts),
      bonded_contacts(false),
      contacts_are_new(true),
      minimal_bonds(0),
      beams(NULL),
      orientation(NULL),
      lost(NULL),
      removed(NULL),
      moved(0),
      turned(0),
      gone_plastic_work(0.0) {
  read_options(narg, arg);
  if (igroup != 0) error->fix_error(FLERR, this, "must be used with group 'all'");
  if (!atom->avec->bonds_allow)
    error->fix_error(FLERR, this, "needs 'atom_style hybrid granular molecular'");
  if (!force->bond || atom->n_bondhist == 0)
    error->fix_error(FLERR, this, "comes after 'bond_style', with a bond style that keeps history");
  if (atom->bond_hist) error->fix_error(FLERR, this, "the bonds' history already has an owner");

  vector_flag = 1;
  size_vector = 8;
  global_freq = 1;
  extvector = 1;
  comm_reverse = 2;
  restart_global = 1;
  restart_peratom = 1;
  history = new SolidemBondValues(liggghts, atom->bond_hist, atom->n_bondhist);
  history->when_forgotten = [this](const double* memory_of_bond) {
    if (history->width() < Row::BREAKING) return;
    const double fraction = force->newton_bond ? 1.0 : 0.5;  // else both atoms list it
    gone_plastic_work += fraction * memory_of_bond[Row::PLASTIC_WORK];
  };
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

void FixSolidemBonds::read_options(int narg, char** arg) {
  const char* known = "takes no arguments but 'minimal_bonds N' and 'bonded_contacts yes' or 'no'";
  for (int k = 3; k < narg; k += 2) {
    const std::string key = arg[k], value = k + 1 < narg ? arg[k + 1] : "";
    if (key == "minimal_bonds" && !value.empty())
      minimal_bonds = force->inumeric(FLERR, arg[k + 1]);
    else if (key == "bonded_contacts" && (value == "yes" || value == "no"))
      bonded_contacts = value == "yes";
    else
      error->fix_error(FLERR, this, known);
  }
  if (minimal_bonds < 0) error->fix_error(FLERR, this, "minimal_bonds must not be negative");
}

FixSolidemBonds::~FixSolidemBonds() {
  if (!history) return;
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  delete history;
}

void FixSolidemBonds::post_create() {
  if (!modify->find_fix_property("orientation", "property/atom", "vector", 4, 0, style, false)) {
    const char* command[] = {"orientation", "all",    "property/atom",
                             "orientation", "vector", "yes",
                             "yes",         "no",     "1",
                             "0",           "0",      "0"};
    modify->add_fix_property_atom(12, const_cast<char**>(command), style);
  }
  find_properties();
}

void FixSolidemBonds::find_properties() {
  orientation = static_cast<FixPropertyAtom*>(
      modify->find_fix_property("orientation", "property/atom", "vector", 4, 0, style));
  beams = dynamic_cast<BondSolidemBeam*>(force->bond);
  if (beams && beams->may_break()) lost = property("lostBonds", "no", "yes");
  if (beams && beams->gives_heat()) solidem_waiting_heat(modify, atom->nlocal, style);
  if (minimal_bonds > 0) removed = property("removedAtom", "yes", "no");
  if (beams && beams->may_damp()) {
    keep_motion("motionAtPose", "yes");
    keep_motion("motionBefore", "no");
  }
}

// Six numbers of every atom, which no restart file needs; made if there are none. Without a
// default: LIGGGHTS would give it to all atoms once more at the end of the first setup.
void FixSolidemBonds::keep_motion(const char* name, const char* forward) {
  if (modify->find_fix_property(name, "property/atom", "vector", 6, 0, style, false)) return;
  const char* command[] = {name, "all",  "property/atom", name,   "vector", "no",   forward,
                           "no", "none", "none",          "none", "none",   "none", "none"};
  FixPropertyAtom* kept = modify->add_fix_property_atom(14, const_cast<char**>(command), style);
  for (int i = 0; i < atom->nlocal; i++) std::fill_n(kept->array_atom[i], 6, 0.0);
}

// A number of every atom, zero at first; made if there is none.
FixPropertyAtom* FixSolidemBonds::property(const char* name, const char* forward,
                                           const char* reverse) {
  Fix* found = modify->find_fix_property(name, "property/atom", "scalar", 0, 0, style, false);
  if (found) return static_cast<FixPropertyAtom*>(found);
  const char* command[] = {name,  "all",   "property/atom", name, "scalar",
                           "yes", forward, reverse,         "0"};
  return modify->add_fix_property_atom(9, const_cast<char**>(command), style);
}

int FixSolidemBonds::setmask() {
  return POST_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR | PRE_FORCE | POST_FORCE;
}

void FixSolidemBonds::init() {
  if (!force->bond || atom->n_bondhist != history->width())
    error->fix_error(
        FLERR, this,
        "the bonds' history has another width now: define the fix after bond_style and "
        "every bond_coeff");
  find_properties();
  if (minimal_bonds > 0 && !lost)
    error->fix_error(FLERR, this, "minimal_bonds needs bond_style solidem/beam with rupture");
  if (lost && modify->n_fixes_style_strict("solidem/conduction") > 0)
    error->fix_error(FLERR, this, "bonds that break cannot conduct heat as well");
  if (history->most_numbers_of_an_atom() > MOST_NUMBERS_OF_AN_ATOM)
    error->fix_error(FLERR, this, "an atom has too many bonds for the buffers of LIGGGHTS");
  require_one_list();
  require_turning();
}

/* ----------------------------------------------------------------------
   beams bend with the turn of their atoms: who moves atoms by their forces
   must turn them, too
------------------------------------------------------------------------- */

void FixSolidemBonds::require_turning() {
  moved = turned = 0;
  if (!beams || !beams->bears_moments()) return;
  for (int k = 0; k < modify->nfix; k++) {
    if (strcmp(modify->fix[k]->style, "nve/solidem") == 0) turned |= modify->fix[k]->groupbit;
    if (strcmp(modify->fix[k]->style, "move") == 0) moved |= modify->fix[k]->groupbit;
  }
  for (int k = 0; k < modify->nfix; k++) {
    const Fix* mover = modify->fix[k];
    const std::string moves = mover->style;
    if (!mover->time_integrate || moves == "move" || moves.compare(0, 11, "nve/noforce") == 0)
      continue;
    const int unturned = bonded_and_unturned(mover->groupbit);
    if (unturned == 0) continue;
    error->fix_error(FLERR, this,
                     ("'fix " + std::string(mover->id) + " ... " + moves + "' moves " +
                      std::to_string(unturned) +
                      " bonded atoms that nothing turns, but beams bend with the turn of their "
                      "atoms: use 'fix ID GROUP nve/solidem' instead, and for atoms that must not "
                      "turn 'move' or 'nve/noforce'")
                         .c_str());
  }
}

// How many atoms of a group list a bond, and no 'nve/solidem' turns them.
int FixSolidemBonds::bonded_and_unturned(int movers) const {
  int here = 0, all;
  for (int i = 0; i < atom->nlocal; i++)
    here += atom->num_bond[i] > 0 && (atom->mask[i] & movers) && !(atom->mask[i] & turned);
  MPI_Allreduce(&here, &all, 1, MPI_INT, MPI_SUM, world);
  return all;
}

// 'fix move ... rotate' gives its atoms an angular velocity and knows no orientation: it follows
// here, so that a grip turns as one rigid body. Other motions leave the angular velocity as it is.
void FixSolidemBonds::post_integrate() {
  if (moved == 0) return;
  for (int i = 0; i < atom->nlocal; i++) {
    const double* omega = atom->omega[i];
    if (!(atom->mask[i] & moved) || (atom->mask[i] & turned)) continue;
    if (omega[0] == 0.0 && omega[1] == 0.0 && omega[2] == 0.0) continue;
    double* q = orientation->array_atom[i];
    const solidem::Quaternion<double> now =
        solidem::turn(solidem::Quaternion<double>{q[0], {q[1], q[2], q[3]}},
                      solidem::Vector3<double>{omega[0], omega[1], omega[2]}, update->dt);
    q[0] = now.w;
    q[1] = now.v.x;
    q[2] = now.v.y;
    q[3] = now.v.z;
  }
}

// The neighbour lists were just built: from now on the bond style works on neighbor->bondhistlist.
void FixSolidemBonds::setup_pre_force(int step) {
  pre_force(step);
}

void FixSolidemBonds::pre_force(int) {
  list_is_current = true;
  if (contacts_are_new)
    hide_bonded_pairs();
  else
    show_parted_pairs();
  contacts_are_new = false;
}

/* ----------------------------------------------------------------------
   two atoms push each other by their bond or by a granular pair style, never
   by both: as long as the bond holds, the pair is hidden from the list of the
   pair style. In the step after a rupture it is back
------------------------------------------------------------------------- */

// With newton_bond on only one of two ranks knows of a bond, but both list the contact.
void FixSolidemBonds::require_one_list() {
  if (force->newton_bond && !bonded_contacts && force->pair_match("gran", 0))
    error->fix_error(FLERR, this,
                     "beside a granular pair style newton_bond must be off ('newton off'), that "
                     "bonded atoms be told from touching ones; or let contacts act between bonded "
                     "atoms, too, by 'bonded_contacts yes'");
}

void FixSolidemBonds::hide_bonded_pairs() {
  hidden_pairs.clear();
  const Pair* granular = bonded_contacts ? NULL : force->pair_match("gran", 0);
  if (!granular || !granular->list) return;
  contacts.begin(granular->list);
  for (int n = 0; n < neighbor->nbondlist; n++) {
    if (!holds(n)) continue;
    hidden_pairs.push_back(n);
    contacts.hide(neighbor->bondlist[n][0], neighbor->bondlist[n][1]);
  }
}

void FixSolidemBonds::show_parted_pairs() {
  if (!lost) return;  // no bond breaks
  for (size_t k = hidden_pairs.size(); k-- > 0;) {
    const int n = hidden_pairs[k];
    if (holds(n)) continue;
    hidden_pairs[k] = hidden_pairs.back();
    hidden_pairs.pop_back();
    if (!is_held_by_another(n)) contacts.show(neighbor->bondlist[n][0], neighbor->bondlist[n][1]);
  }
}

bool FixSolidemBonds::holds(int n) const {
  if (!beams) return true;
  int i = neighbor->bondlist[n][0], j = neighbor->bondlist[n][1];
  const SolidemBondEnds ends = beams->ends(i, j);
  return beams->beam(neighbor->bondlist[n][2])
      .holds(neighbor->bondhistlist[n], ends, static_cast<double>(update->ntimestep));
}

// Whether another bond of the same two atoms still holds them.
bool FixSolidemBonds::is_held_by_another(int n) const {
  int** list = neighbor->bondlist;
  return std::any_of(hidden_pairs.begin(), hidden_pairs.end(), [&](int other) {
    return (list[other][0] == list[n][0] && list[other][1] == list[n][1]) ||
           (list[other][0] == list[n][1] && list[other][1] == list[n][0]);
  });
}

// At the start of a run Neighbor::init has emptied the list; post_run stored it in time.
void FixSolidemBonds::setup_pre_exchange() {
  list_is_current = false;
}

void FixSolidemBonds::pre_exchange() {
  store_history();
  drop_gone_bonds();
}

// Whoever changed the lists of bonds since, the next list of bonds finds each row in its place.
void FixSolidemBonds::setup_pre_neighbor() {
  require_bonds_switched_on();
  require_unit_orientations();
  pre_neighbor();
}

void FixSolidemBonds::pre_neighbor() {
  history->settle_all();
  contacts_are_new = true;
  if (beams) beams->forget_list();
}

void FixSolidemBonds::require_bonds_switched_on() const {
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < atom->num_bond[i]; m++)
      if (atom->bond_type[i][m] <= 0)
        error->one(FLERR, ("Fix solidem/bonds: the bond of atoms " + std::to_string(atom->tag[i]) +
                           " and " + std::to_string(atom->bond_atom[i][m]) +
                           " is switched off: use delete_bonds with 'remove', or 'undo'")
                              .c_str());
}

void FixSolidemBonds::require_unit_orientations() const {
  const double tolerance = 1e-6;  // what a user may have typed
  for (int i = 0; i < atom->nlocal; i++) {
    const double* q = orientation->array_atom[i];
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(fabs(square - 1.0) <= tolerance))
      error->one(FLERR,
                 ("Fix solidem/bonds: the orientation of atom " + std::to_string(atom->tag[i]) +
                  " has the square " + std::to_string(square) + ", not 1")
                     .c_str());
  }
}

void FixSolidemBonds::post_run() {
  store_history();
  drop_gone_bonds();
}

void FixSolidemBonds::setup(int) {
  remove_atoms();
}

void FixSolidemBonds::post_force(int) {
  remove_atoms();
}

double FixSolidemBonds::extend_cut_ghost() {
  return solidem_reach(atom, world);
}

const double* FixSolidemBonds::lost_bonds() const {
  return lost ? lost->vector_atom : NULL;
}

double FixSolidemBonds::compute_vector(int n) {
  if (beams && n == 7) {
    double damping;
    MPI_Allreduce(&beams->ledger.damping, &damping, 1, MPI_DOUBLE, MPI_SUM, world);
    return damping;
  }
  if (!beams || history->width() < Row::BREAKING) return n == 6 ? -1.0 : 0.0;
  const SolidemLedger& ledger = beams->ledger;
  double here = 0.0, all;
  if (n == 6) {
    const double never = std::numeric_limits<double>::infinity();
    here = ledger.first_rupture == 0.0 ? never : ledger.first_rupture - 1.0;
    MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_MIN, world);
    return all == never ? -1.0 : all;
  }
  if (n == 0) here = plastic_work();
  if (n == 1) here = ledger.fracture_energy;
  if (n == 2) here = ledger.broken;
  if (n == 3) here = beams->contact_energy();
  if (n == 4 && removed)
    here = std::accumulate(removed->vector_atom, removed->vector_atom + atom->nlocal, 0.0);
  if (n == 5) here = ledger.formed;
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}
