// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifndef LMP_SOLIDEM_NUMBER_H
#define LMP_SOLIDEM_NUMBER_H

#include <string>

#include "pointers.h"

namespace LAMMPS_NS {

/// An argument of a fix that is a number, or v_NAME for an equal-style variable.
class SolidemNumber : protected Pointers {
 public:
  SolidemNumber(class LAMMPS* lmp, class Fix* owner, const char* word);

  /// Looks for the variable; call it in the owner's init().
  void init();
  /// The value at the present time step.
  double value();
  /// The same, of which an error is made when it is no absolute temperature.
  double temperature();

 private:
  class Fix* owner_;
  double number_;
  std::string variable_;
};

}  // namespace LAMMPS_NS

#endif
