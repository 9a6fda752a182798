// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/calibration/orthotropic_calibration.hpp"
#include "effects/beam_parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "model/error.hpp"
#include "support/specimens.hpp"

namespace solidem::orthotropic_calibration_test {

std::vector<Specimen> cells(int count, const BeamParameters& beams) {
  std::vector<Specimen> specimens;
  for (int k = 0; k < count; ++k) {
    SpecimenRecipe recipe;
    recipe.shape = "box";
    recipe.size = {1e-3, 1e-3, 1e-3};
    recipe.elements = 250;
    recipe.periodic = {true, true, true};
    recipe.seed = static_cast<std::uint64_t>(k + 1);
    specimens.push_back(make_specimen(recipe));
    add_fibres(specimens.back(), beams.fibres->rule);
  }
  return specimens;
}

BeamParameters wooden_beams() {
  BeamParameters beams;
  beams.young_modulus = 20e9;
  beams.shear_modulus = 8e9;
  beams.radius_ratio = 0.45;
  beams.anisotropy = Anisotropy{};
  beams.anisotropy->radial_modulus = 6e9;
  beams.anisotropy->tangential_modulus = 3e9;
  beams.anisotropy->exponent = 2;
  beams.fibres = Fibres{};
  beams.fibres->stiffness_ratio = 3;
  return beams;
}

NineConstants constants_of(const BeamParameters& beams, const Specimen& specimen) {
  return nine_constants(orthotropic_constants(
      effective_stiffness(beam_network(beams, specimen), beams.anisotropy->axes).stiffness));
}

TEST(OrthotropicCalibration, FindsConstantsThatSomeBeamsHave) {
  const BeamParameters hidden = wooden_beams();
  const std::vector<Specimen> specimens = cells(1, hidden);
  const NineConstants wanted = constants_of(hidden, specimens[0]);
  OrthotropicRequest request;
  for (std::size_t c = 0; c < 9; ++c) request.target[c] = wanted[c];
  request.tolerance = 1e-3;
  BeamParameters start = hidden;
  start.young_modulus = 5e9;
  start.shear_modulus = 2e9;  // the ratio G/E is kept
  start.radius_ratio = 0.7;
  start.anisotropy->radial_modulus = start.anisotropy->tangential_modulus = 2e9;
  start.anisotropy->exponent = 4;
  start.fibres->stiffness_ratio = 1;
  const OrthotropicCalibration found = calibrate_orthotropic(request, start, specimens);
  EXPECT_TRUE(found.misses.empty()) << found.misses[0];
  EXPECT_LE(found.trials.size(), 25u);
  for (std::size_t c = 0; c < 9; ++c) EXPECT_NEAR(found.mean[c], wanted[c], 1e-3 * wanted[c]);
  // Nine constants say what the six parameters are.
  EXPECT_NEAR(found.beams.radius_ratio, hidden.radius_ratio, 0.01);
  EXPECT_NEAR(found.beams.fibres->stiffness_ratio * found.beams.young_modulus, 60e9, 1e9);
}

TEST(OrthotropicCalibration, TheMeanOfTheSpecimensMeetsYoungsModuli) {
  const BeamParameters start = wooden_beams();
  const std::vector<Specimen> specimens = cells(2, start);
  OrthotropicRequest request;
  request.target[0] = 14.7e9;
  request.target[1] = 1.0e9;
  request.target[2] = 0.735e9;
  request.tolerance = 5e-3;
  const OrthotropicCalibration found = calibrate_orthotropic(request, start, specimens);
  EXPECT_TRUE(found.misses.empty()) << found.misses[0];
  EXPECT_NEAR(found.mean[0] / found.mean[2], 20, 0.2);
  const NineConstants first = constants_of(found.beams, specimens[0]);
  const NineConstants second = constants_of(found.beams, specimens[1]);
  for (std::size_t c = 0; c < 9; ++c) {
    EXPECT_NEAR(found.mean[c], 0.5 * (first[c] + second[c]), 1e-6 * found.mean[c]);
    EXPECT_NEAR(found.deviation[c], std::abs(first[c] - second[c]) / std::sqrt(2.0),
                1e-6 * found.mean[c]);
  }
}

TEST(OrthotropicCalibration, TellsWhatIsOutOfReach) {
  const BeamParameters start = wooden_beams();
  const std::vector<Specimen> specimens = cells(1, start);
  OrthotropicRequest request;
  request.target[0] = 14.7e9;
  request.target[2] = 0.735e9;
  request.target[5] = 1e6;  // no shear stiffness across the grain, but Young's modulus
  request.iterations = 8;
  const OrthotropicCalibration found = calibrate_orthotropic(request, start, specimens);
  ASSERT_FALSE(found.misses.empty());
  EXPECT_NE(found.misses.back().find("G_RT = 0.001 GPa"), std::string::npos) << found.misses[0];
}

TEST(OrthotropicCalibration, RefusesWhatCannotBegin) {
  BeamParameters beams = wooden_beams();
  const std::vector<Specimen> specimens = cells(1, beams);
  EXPECT_THROW(calibrate_orthotropic({}, beams, specimens), InputError);  // no target
  beams.anisotropy.reset();
  OrthotropicRequest request;
  request.target[0] = 14.7e9;
  EXPECT_THROW(calibrate_orthotropic(request, beams, specimens), InputError);  // no grain
}

}  // namespace solidem::orthotropic_calibration_test
