// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_touch.h"

#include <string.h>

#include <algorithm>
#include <string>
#include <vector>

#include "error.h"
#include "fix_mesh_surface.h"
#include "fix_wall_gran.h"
#include "granular_wall.h"
#include "modify.h"

using namespace LAMMPS_NS;
using LIGGGHTS::ContactModels::SurfacesIntersectData;
using LIGGGHTS::Walls::IGranularWall;

namespace {

typedef solidem::Vector3<double> Vector;

Vector vector_of(const double* a) {
  return {a[0], a[1], a[2]};
}

// Names the member that holds a wall's contacts, which is for heirs alone.
struct Heir : public FixWallGran {
  static IGranularWall*& contacts_of(FixWallGran* wall) { return wall->*(&Heir::impl); }
};

FixWallGran* granular_wall(Fix* fix) {
  return strncmp(fix->style, "wall/gran", 9) == 0 ? dynamic_cast<FixWallGran*>(fix) : NULL;
}

// Holds the contacts of a wall in place of its own: they act as before, and watchers are told of
// each.
class WatchedContacts : public IGranularWall {
 public:
  std::vector<SolidemTouchWatcher*> watchers;

  explicit WatchedContacts(IGranularWall* watched) : contacts(watched) {}
  ~WatchedContacts() { delete contacts; }  // as the wall would have done

  void settings(int narg, char** arg, LIGGGHTS::IContactHistorySetup* history) {
    contacts->settings(narg, arg, history);
  }
  void init_granular() { contacts->init_granular(); }
  bool checkSurfaceIntersect(SurfacesIntersectData& contact) {
    return contacts->checkSurfaceIntersect(contact);
  }
  int get_history_offset(std::string name) { return contacts->get_history_offset(name); }
  bool contact_match(const std::string kind, const std::string model) {
    return contacts->contact_match(kind, model);
  }
  void compute_force(FixWallGran*, SurfacesIntersectData&, bool, double*, FixMeshSurface*, int,
                     TriMesh*, int);
  void forget(SolidemTouchWatcher* watcher) {
    watchers.erase(std::remove(watchers.begin(), watchers.end(), watcher), watchers.end());
  }

 private:
  IGranularWall* contacts;
};

WatchedContacts* watched(FixWallGran* wall) {
  return dynamic_cast<WatchedContacts*>(Heir::contacts_of(wall));
}

// The spring of what has parted is forgotten by this very call.
void WatchedContacts::compute_force(FixWallGran* wall, SurfacesIntersectData& contact,
                                    bool intersects, double* velocity_of_wall, FixMeshSurface* mesh,
                                    int number, TriMesh* facets, int facet) {
  const Vector none = {0.0, 0.0, 0.0};
  const double* spring = wall->dnum() == 3 ? contact.contact_history : NULL;
  const Vector before = spring ? vector_of(spring) : none;
  contacts->compute_force(wall, contact, intersects, velocity_of_wall, mesh, number, facets, facet);
  if (!wall->computeflag() || (!intersects && dot(before, before) == 0.0)) return;
  SolidemTouch touch = {contact.i,
                        wall,
                        wall->atom_type_wall(),
                        intersects,
                        spring && wall->shearupdate(),
                        contact.deltan,
                        vector_of(contact.en),
                        before,
                        spring && intersects ? vector_of(spring) : none,
                        {contact.vtr1, contact.vtr2, contact.vtr3}};
  if (mesh) touch.tool = mesh;
  if (!intersects) {
    const Vector& normal = touch.normal;
    const Vector relative = vector_of(contact.v_i) -
                            contact.radi * cross(vector_of(contact.omega_i), normal) -
                            vector_of(velocity_of_wall);
    touch.velocity = relative - dot(relative, normal) * normal;
  }
  for (SolidemTouchWatcher* watcher : watchers) watcher->see(touch);
}

void require_model(Error* error, Fix* fix, FixWallGran* wall) {
  if (wall->contact_match("normal", "hooke/stiffness") &&
      wall->contact_match("tangential", "history") && wall->dnum() == 3)
    return;
  error->fix_error(FLERR, fix,
                   ("fix " + std::string(wall->id) +
                    " wall/gran must be 'model hooke/stiffness tangential history' without further "
                    "models that remember contacts")
                       .c_str());
}

}  // namespace

int SolidemTouchWatcher::watch_walls(Modify* modify, Error* error, Fix* fix,
                                     const Fix* conduction) {
  const int last = std::min(modify->find_fix(conduction->id), modify->find_fix(fix->id));
  int rubbing = 0;
  for (int k = 0; k < modify->nfix; k++) {
    FixWallGran* wall = granular_wall(modify->fix[k]);
    if (!wall) continue;
    if (k > last)
      error->fix_error(FLERR, fix,
                       ("fix " + std::string(wall->id) +
                        " wall/gran must be defined before this fix and fix solidem/conduction")
                           .c_str());
    if (!wall->contact_match("tangential", "off")) {
      require_model(error, fix, wall);
      rubbing++;
    }
    IGranularWall*& contacts = Heir::contacts_of(wall);
    if (!watched(wall)) contacts = new WatchedContacts(contacts);
    watched(wall)->forget(this);
    watched(wall)->watchers.push_back(this);
  }
  return rubbing;
}

const Fix* SolidemTouchWatcher::find_tool(Modify* modify, Error* error, Fix* fix,
                                          const std::string& id) {
  const int k = modify->find_fix(id.c_str());
  if (k < 0) error->fix_error(FLERR, fix, ("there is no fix " + id + " for its tool").c_str());
  return modify->fix[k];
}

void SolidemTouchWatcher::leave_walls(Modify* modify) {
  for (int k = 0; k < modify->nfix; k++)
    if (FixWallGran* wall = modify->fix[k] ? granular_wall(modify->fix[k]) : NULL)
      if (WatchedContacts* left = watched(wall)) left->forget(this);
}
