// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_beam_words.h"

#include <cmath>
#include <cstdio>

#include "error.h"
#include "force.h"

namespace LAMMPS_NS {

namespace {

// The words of one bond_coeff command, taken one after the other.
class Words {
 public:
  Words(LAMMPS* liggghts, int narg, char** arg)
      : liggghts_(liggghts), narg_(narg), arg_(arg), at_(1) {}

  bool any() const { return at_ < narg_; }

  std::string word(const std::string& what) {
    if (!any()) fail("'" + what + "' is missing at the end");
    return arg_[at_++];
  }

  double number(const std::string& what) {
    if (!any()) fail("'" + what + "' is missing at the end");
    return liggghts_->force->numeric(FLERR, arg_[at_++]);
  }

  double positive(const std::string& what) {
    const double value = number(what);
    if (!(value > 0.0)) fail(what + " must be positive, not " + arg_[at_ - 1]);
    return value;
  }

  double not_negative(const std::string& what) {
    const double value = number(what);
    if (!(value >= 0.0)) fail(what + " must not be negative, not " + arg_[at_ - 1]);
    return value;
  }

  void fail(const std::string& why) const {
    liggghts_->error->all(FLERR, ("Bond style solidem/beam: " + why).c_str());
  }

 private:
  LAMMPS* liggghts_;
  int narg_;
  char** arg_;
  int at_;
};

void read_law(Words& words, SolidemBeam& beam) {
  const std::string law = words.word("law");
  if (law == "euler-bernoulli") {
    beam.law = SolidemBeam::EULER_BERNOULLI;
  } else if (law == "timoshenko") {
    beam.law = SolidemBeam::TIMOSHENKO;
    beam.shear_coefficient = words.positive("the shear coefficient");
    if (beam.shear_modulus == 0.0) words.fail("law timoshenko needs a shear modulus above zero");
  } else if (law == "spring") {
    beam.law = SolidemBeam::SPRING;
  } else {
    words.fail("unknown law '" + law + "'; known are euler-bernoulli, timoshenko KAPPA, spring");
  }
}

void read_plasticity(Words& words, SolidemBeam& beam) {
  const std::string law = words.word("plasticity");
  if (law == "radial-return")
    beam.plasticity = SolidemBeam::RADIAL_RETURN;
  else if (law == "scaled-offset")
    beam.plasticity = SolidemBeam::SCALED_OFFSET;
  else
    words.fail("unknown plasticity '" + law + "'; known are radial-return, scaled-offset");
  beam.yield.yield_strain = words.positive("the yield stress") / beam.young_modulus;
  beam.yield.hardening_ratio = words.not_negative("the hardening modulus") / beam.young_modulus;
}

// A number with all its digits.
std::string full(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace

SolidemBeam solidem_read_beam(LAMMPS* liggghts, int narg, char** arg) {
  SolidemBeam beam;
  Words words(liggghts, narg, arg);
  if (narg < 5)
    words.fail(
        "bond_coeff wants TYPES YOUNG_MODULUS SHEAR_MODULUS and either 'radius R' or 'pair RATIO'");
  beam.young_modulus = words.positive("Young's modulus");
  beam.shear_modulus = words.not_negative("the shear modulus");
  const std::string thickness = words.word("radius");
  if (thickness != "radius" && thickness != "pair")
    words.fail("'radius' or 'pair' must follow the moduli, not '" + thickness + "'");
  (thickness == "radius" ? beam.radius : beam.ratio) = words.positive("radius or ratio");

  while (words.any()) {
    const std::string key = words.word("keyword");
    if (key == "law")
      read_law(words, beam);
    else if (key == "plasticity")
      read_plasticity(words, beam);
    else if (key == "rupture_stress")
      beam.rupture.elastic_strain = words.positive(key) / beam.young_modulus;
    else if (key == "rupture_strain")
      beam.rupture.strain = words.positive(key);
    else if (key == "contact")
      beam.contact_ratio = words.positive("the contact's stiffness ratio");
    else if (key == "rebonding_pressure")
      beam.rebonding_pressure = words.positive(key);
    else
      words.fail("unknown keyword '" + key +
                 "'; known are law, plasticity, rupture_stress, rupture_strain, contact, "
                 "rebonding_pressure");
  }
  if (beam.contact_ratio > 0.0 && !beam.may_break())
    words.fail("contact needs rupture_stress or rupture_strain: only broken bonds have contacts");
  if (std::isfinite(beam.rebonding_pressure) && beam.contact_ratio == 0.0)
    words.fail("rebonding_pressure needs contact: only contacts make bonds anew");
  if (std::isfinite(beam.rebonding_pressure) && beam.plasticity == SolidemBeam::SCALED_OFFSET)
    words.fail("rebonding_pressure goes with plasticity radial-return or none, not scaled-offset");
  return beam;
}

std::string solidem_write_beam(const SolidemBeam& beam) {
  const double stiffness = beam.young_modulus;
  std::string line = full(beam.young_modulus) + " " + full(beam.shear_modulus);
  line += beam.radius > 0.0 ? " radius " + full(beam.radius) : " pair " + full(beam.ratio);
  if (beam.law == SolidemBeam::TIMOSHENKO)
    line += " law timoshenko " + full(beam.shear_coefficient);
  if (beam.law == SolidemBeam::SPRING) line += " law spring";
  if (beam.plasticity != SolidemBeam::NONE)
    line += (beam.plasticity == SolidemBeam::RADIAL_RETURN ? " plasticity radial-return "
                                                           : " plasticity scaled-offset ") +
            full(beam.yield.yield_strain * stiffness) + " " +
            full(beam.yield.hardening_ratio * stiffness);
  if (std::isfinite(beam.rupture.elastic_strain))
    line += " rupture_stress " + full(beam.rupture.elastic_strain * stiffness);
  if (std::isfinite(beam.rupture.strain)) line += " rupture_strain " + full(beam.rupture.strain);
  if (beam.contact_ratio > 0.0) line += " contact " + full(beam.contact_ratio);
  if (std::isfinite(beam.rebonding_pressure))
    line += " rebonding_pressure " + full(beam.rebonding_pressure);
  return line;
}

}  // namespace LAMMPS_NS
