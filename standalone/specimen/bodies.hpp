// SPDX-License-Identifier: GPL-2.0-or-later
//
// Several bodies as one specimen: each is made on its own, then turned and moved to its place. They
// are bonded within, and with each other only where that is asked for.
#ifndef SOLIDEM_SPECIMEN_BODIES_HPP
#define SOLIDEM_SPECIMEN_BODIES_HPP

#include <string>
#include <vector>

#include "specimen/recipe.hpp"

namespace solidem {

/// How one of several bodies comes to be, and where it is put.
struct BodyRecipe {
  std::string name;
  SpecimenRecipe recipe;
  Quaternion<double> turned{};         ///< about the recipe's origin
  Vector shift{};                      ///< after that, m
  std::vector<std::string> bonded_to;  ///< other bodies that its elements are bonded with
};

/// Makes all bodies and joins them: elements body by body, bonds of tolerance 0 (of a file: its
/// own), the domain a box around all of the shape "bodies", its volume the sum. The same for the
/// same recipes on any number of threads. Throws InputError when a body cannot be made, is
/// periodic, is to be bonded with one that there is not, or overlaps with another one: by how much,
/// and which elements.
Specimen make_bodies(const std::vector<BodyRecipe>& recipes, const ReportProgress& progress = {});

/// Throws InputError when elements of two bodies that are not bonded stand nearer than `reach` (R_i
/// + R_j) at the start, within which central forces would act.
void check_apart(const Specimen& specimen, double reach);

}  // namespace solidem

#endif
