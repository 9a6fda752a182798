// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_CONTACT_LIST_H
#define LMP_SOLIDEM_CONTACT_LIST_H

#include <vector>

#include "pointers.h"

namespace LAMMPS_NS {

/// The list of neighbours of a granular pair style, from which pairs of atoms can be hidden and
/// shown again. A hidden pair stands behind the end of its atom's list, so that nobody sees it; the
/// list of contact history goes along. A pair that is shown has no history.
class SolidemContactList : protected Pointers {
 public:
  explicit SolidemContactList(class LAMMPS* liggghts) : Pointers(liggghts), list_(NULL) {}

  /// Takes the list as it was just built: nothing is hidden.
  void begin(class NeighList* list);
  /// Hides or shows a pair of atoms, in whichever order the list has it, if it has.
  void hide(int i, int j);
  void show(int i, int j);

 private:
  class NeighList* list_;
  std::vector<int> hidden_;  ///< pairs of each atom of this rank

  void swap(int i, int a, int b);
  int find(int i, int j, int begin, int end) const;
  bool hide_at(int i, int j);
  bool show_at(int i, int j);
};

}  // namespace LAMMPS_NS

#endif
