// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_TOUCH_H
#define LMP_SOLIDEM_TOUCH_H

#include <string>

#include "laws/algebra.hpp"

namespace LAMMPS_NS {

/// An atom that touches a wall, or has just parted from it but is near.
struct SolidemTouch {
  int i;                            ///< the local atom
  const class Fix* tool;            ///< fix mesh/surface, or the fix wall/gran of a primitive wall
  int type;                         ///< of the wall's contacts in matrices over types of atoms
  bool touches;                     ///< now
  bool slips;                       ///< it has a spring, which was followed in this call
  double overlap;                   ///< m
  solidem::Vector3<double> normal;  ///< unit, from the wall to the atom
  solidem::Vector3<double> before, after;  ///< spring: way of the atom along the wall, m
  solidem::Vector3<double> velocity;       ///< of the atom along the wall, m/s
};

/// Is told of the contacts of all fixes wall/gran in each pose, as they act.
class SolidemTouchWatcher {
 public:
  virtual void see(const SolidemTouch&) = 0;

 protected:
  ~SolidemTouchWatcher() {}

  /// Watches all walls of the script. Those that rub must do so by model hooke/stiffness tangential
  /// history, and all be defined before conduction, for they must have acted when heat steps:
  /// errors of the fix name others. How many rub.
  int watch_walls(class Modify*, class Error*, class Fix*, const class Fix* conduction);
  /// The fix of a tool by its ID; an error of the fix if there is none.
  static const class Fix* find_tool(class Modify*, class Error*, class Fix*, const std::string& id);
  /// Is told of nothing any more by the walls that are left.
  void leave_walls(class Modify*);
};

}  // namespace LAMMPS_NS

#endif
