// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_number.h"

#include <string.h>

#include <limits>
#include <string>

#include "error.h"
#include "fix.h"
#include "force.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

using namespace LAMMPS_NS;

SolidemNumber::SolidemNumber(LAMMPS* liggghts, Fix* owner, const char* word)
    : Pointers(liggghts), owner_(owner), number_(0.0) {
  if (strncmp(word, "v_", 2) == 0)
    variable_ = word + 2;
  else
    number_ = force->numeric(FLERR, word);
}

void SolidemNumber::init() {
  if (variable_.empty()) return;
  const int found = input->variable->find(const_cast<char*>(variable_.c_str()));
  if (found < 0) error->fix_error(FLERR, owner_, ("no variable named " + variable_).c_str());
  if (!input->variable->equalstyle(found))
    error->fix_error(FLERR, owner_, ("variable " + variable_ + " is not of style equal").c_str());
}

double SolidemNumber::value() {
  if (variable_.empty()) return number_;
  modify->clearstep_compute();
  const int found = input->variable->find(const_cast<char*>(variable_.c_str()));
  const double value = input->variable->compute_equal(found);
  modify->addstep_compute_all(update->ntimestep + 1);
  return value;
}

double SolidemNumber::temperature() {
  const double kelvin = value();
  if (!(kelvin >= 0.0 && kelvin <= std::numeric_limits<double>::max()))
    error->fix_error(
        FLERR, owner_,
        ("a temperature is counted from absolute zero and must not be below it, but is " +
         std::to_string(kelvin))
            .c_str());
  return kelvin;
}
