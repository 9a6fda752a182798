// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_central.h"

#include <cstdio>
#include <cstdlib>
#include <variant>

#include "error.h"
#include "laws/central_interaction.hpp"

namespace LAMMPS_NS {

using solidem::CentralLaws;
using solidem::LawQuantity;

namespace {

std::string full(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

const char* const OPTIONS =
    "range, tolerance, equilibrium, neighbours, interpenetration, dissipation";

// The words of one pair_style command, taken one after the other.
class Words {
 public:
  Words(LAMMPS* liggghts, const std::vector<std::string>& words)
      : liggghts_(liggghts), words_(words) {}

  bool any() const { return at_ < words_.size(); }

  std::string word(const std::string& what) {
    if (!any()) fail("'" + what + "' has no value at the end");
    return words_[at_++];
  }

  double number(const std::string& what) {
    const std::string text = word(what);
    char* end;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value))
      fail(what + " must be a number, not '" + text + "'");
    return value;
  }

  double positive(const std::string& what) {
    const double value = number(what);
    if (!(value > 0.0)) fail(what + " must be above 0, not " + words_[at_ - 1]);
    return value;
  }

  // One of two words; whether it is the second.
  bool second_of(const std::string& what, const std::string& first, const std::string& second) {
    const std::string text = word(what);
    if (text != first && text != second)
      fail(what + " must be " + first + " or " + second + ", not '" + text + "'");
    return text == second;
  }

  const std::string& last() const { return words_[at_ - 1]; }

  void fail(const std::string& why) const {
    liggghts_->error->all(FLERR, ("Pair style solidem/central: " + why).c_str());
  }

 private:
  LAMMPS* liggghts_;
  const std::vector<std::string>& words_;
  size_t at_ = 0;
};

void read_law_name(Words& words, SolidemCentral& central) {
  const std::string name = words.word("the law");
  std::string known;
  bool found = false;
  CentralLaws::for_each([&](auto law) {
    known += (known.empty() ? "" : ", ") + std::string(law.name);
    if (name != law.name) return;
    central.law = law;
    found = true;
  });
  if (!found) words.fail("unknown law '" + name + "'; known are " + known);
}

// Takes a parameter of the law by its name; whether there is such a one.
bool read_parameter(Words& words, const std::string& name, SolidemCentral& central) {
  return std::visit(
      [&](auto& law) {
        for (const auto& parameter : law.parameters()) {
          if (name != parameter.name) continue;
          const double value = words.positive(name);
          if (parameter.quantity == LawQuantity::exponent && value != std::floor(value))
            words.fail(name + " must be a whole number from 1, not " + words.last());
          law.*parameter.place = value;
          return true;
        }
        return false;
      },
      central.law);
}

bool read_option(Words& words, const std::string& name, SolidemCentral& central) {
  if (name == "range") {
    central.range = words.number(name);
    if (!(central.range > 1.0)) words.fail("range must be above 1, not " + words.last());
  } else if (name == "tolerance") {
    central.tolerance = words.number(name);
    if (!(central.tolerance >= 0.0))
      words.fail("tolerance must not be negative, but is " + words.last());
  } else if (name == "equilibrium") {
    central.initial_distance = !words.second_of(name, "initial", "radii");
  } else if (name == "neighbours") {
    central.fixed_neighbours = words.second_of(name, "changing", "fixed");
  } else if (name == "interpenetration") {
    central.interpenetration = words.number(name);
    if (!(central.interpenetration > 0.0 && central.interpenetration < 1.0))
      words.fail("interpenetration must be above 0 and below 1, not " + words.last());
  } else if (name == "dissipation") {
    central.dissipation = words.number(name);
    if (!(central.dissipation >= 0.0))
      words.fail("dissipation must not be negative, but is " + words.last());
  } else {
    return false;
  }
  return true;
}

// Names of a law's parameters; those without a value alone, if so wanted.
std::string parameters(const SolidemCentral& central, bool missing_alone) {
  std::string names;
  std::visit(
      [&](const auto& law) {
        for (const auto& parameter : law.parameters())
          if (!missing_alone || law.*parameter.place == 0.0)
            names += (names.empty() ? "" : ", ") + std::string(parameter.name);
      },
      central.law);
  return names;
}

std::string law_name(const SolidemCentral& central) {
  return std::visit([](const auto& law) { return std::string(law.name); }, central.law);
}

}  // namespace

SolidemCentral solidem_read_central(LAMMPS* liggghts, const std::vector<std::string>& given) {
  SolidemCentral central;
  Words words(liggghts, given);
  read_law_name(words, central);
  central.tolerance = -1.0;
  while (words.any()) {
    const std::string name = words.word("a word");
    if (!read_parameter(words, name, central) && !read_option(words, name, central))
      words.fail("unknown word '" + name + "'; law " + law_name(central) + " has " +
                 parameters(central, false) + ", every law has " + OPTIONS);
  }
  const std::string missing = parameters(central, true);
  if (!missing.empty()) words.fail("law " + law_name(central) + " needs " + missing);
  if (central.range == 0.0) words.fail("needs range, above 1, such as range 1.2");
  if (central.tolerance < 0.0) central.tolerance = central.range - 1.0;
  const char* complaint = std::visit([](const auto& law) { return law.complaint(); }, central.law);
  if (complaint) words.fail(complaint);
  const bool repels = std::visit(
      [&](const auto& law) { return repels_down_to(law, central.interpenetration); }, central.law);
  if (!repels)
    words.fail("interpenetration " + full(central.interpenetration) +
               ": the law has a pole before; expected a smaller one");
  return central;
}

std::string solidem_write_central(const SolidemCentral& central) {
  std::string words = law_name(central);
  std::visit(
      [&](const auto& law) {
        for (const auto& parameter : law.parameters())
          words += std::string(" ") + parameter.name + " " + full(law.*parameter.place);
      },
      central.law);
  words += " range " + full(central.range) + " tolerance " + full(central.tolerance);
  words += std::string(" equilibrium ") + (central.initial_distance ? "initial" : "radii");
  words += std::string(" neighbours ") + (central.fixed_neighbours ? "fixed" : "changing");
  words += " interpenetration " + full(central.interpenetration);
  return words + " dissipation " + full(central.dissipation);
}

}  // namespace LAMMPS_NS
