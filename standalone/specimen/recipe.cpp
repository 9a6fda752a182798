// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/recipe.hpp"

#include "model/error.hpp"
#include "specimen/bonds.hpp"
#include "specimen/crystal.hpp"
#include "specimen/ordering.hpp"
#include "specimen/packing.hpp"
#include "specimen/report.hpp"
#include "specimen/shape.hpp"
#include "specimen/specimen_file.hpp"

namespace solidem {

namespace {

// What a scene says of the body of a file.
std::optional<Domain> body_of(const SpecimenRecipe& recipe) {
  if (!recipe.shape.empty()) return shape_of(recipe);
  if (!(recipe.volume > 0)) return {};
  Domain body;
  body.volume = recipe.volume;
  return body;
}

Specimen read_file_of(const SpecimenRecipe& recipe) {
  const std::optional<Domain> body = body_of(recipe);
  try {
    return read_specimen(recipe.file, body);
  } catch (const InputError& error) {
    throw InputError(std::string("[specimen] file: ") + error.what());
  }
}

}  // namespace

Specimen make_specimen(const SpecimenRecipe& recipe, const ReportProgress& progress) {
  if (!recipe.file.empty()) {
    Specimen specimen = read_file_of(recipe);
    cut_out(specimen, recipe.cuts);
    return specimen;
  }
  const bool crystal = recipe.shape == "crystal";
  std::shared_ptr<const FacetTree> surface;
  if (recipe.shape == "mesh") surface = std::make_shared<const FacetTree>(surface_of(recipe));
  Specimen specimen =
      crystal ? make_crystal(recipe) : make_packing(recipe, progress, surface.get());
  if (surface != nullptr) specimen.outline = std::make_shared<const Outline>(Outline{surface, {}});
  cut_out(specimen, recipe.cuts, surface);
  make_bonds(specimen, 0.0);
  sort_elements(specimen);
  measure_specimen(specimen);
  if (!crystal) specimen.report["seed"] = static_cast<double>(recipe.seed);
  if (progress) progress(1.0, "specimen made");
  return specimen;
}

}  // namespace solidem
