// SPDX-License-Identifier: GPL-2.0-or-later
//
// Specimens that other programs wrote, and what text formats keep of a body.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/error.hpp"
#include "specimen/bonds.hpp"
#include "specimen/cut_cells.hpp"
#include "specimen/pieces.hpp"
#include "specimen/recipe.hpp"
#include "specimen/specimen_file.hpp"
#include "specimen/text_formats.hpp"
#include "specimen/walls.hpp"

namespace solidem::files_of_others_test {

template <class Act>
void expect_refusal(Act act, const std::vector<std::string>& texts) {
  try {
    act();
    ADD_FAILURE() << "no error; expected one with: " << texts[0];
  } catch (const InputError& error) {
    for (const std::string& text : texts)
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos)
          << "\"" << text << "\" is not in: " << error.what();
  }
}

Specimen read_data(const std::string& text) {
  return specimen_of_liggghts_text(text, "a.data");
}

/// A data file of a chain of three spheres of 2 mm at x = 10, 12 and 14 mm.
std::string chain(const std::string& title, const std::string& style, const std::string& rows) {
  return title + "\n\n3 atoms\n2 bonds\n1 atom types\n1 bond types\n" +
         "0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms" + style + "\n\n" + rows +
         "\nBonds\n\n1 1 1 2\n2 1 2 3\n";
}

/// Rows in which words stand before and after the place.
std::string rows(const std::string& format) {
  std::string text;
  for (int k = 0; k < 3; ++k)
    text += fmt::format(format, fmt::arg("id", k + 1),
                        fmt::arg("place", fmt::format("0.01{} 0.005 0.05", 2 * k))) +
            "\n";
  return text;
}

void expect_chain(const Specimen& specimen) {
  ASSERT_EQ(specimen.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_DOUBLE_EQ(specimen.position[k].x, 0.01 + 0.002 * k);
    EXPECT_DOUBLE_EQ(specimen.position[k].z, 0.05);
    EXPECT_DOUBLE_EQ(specimen.radius[k], 0.001);
  }
  EXPECT_EQ(specimen.bonds, (std::vector<Pair>{{0, 1}, {1, 2}}));
}

TEST(DataFiles, TheAtomStyleDecidesTheColumns) {
  const std::string sphere = rows("{id} 1 0.002 2500 {place}");
  const std::string bpm = rows("{id} 1 1 0.002 2500 {place}");
  const std::string bond_sphere = rows("{id} 1 {place} 1 0.002 2500");
  const std::string granular_molecular = rows("{id} 1 {place} 0.002 2500 1");
  for (const auto& [style, lines] : std::vector<std::pair<std::string, std::string>>{
           {" # sphere", sphere},
           {" # granular", sphere},
           {"", sphere},
           {" # bpm/sphere", bpm},
           {" # hybrid bond sphere", bond_sphere},
           {" # hybrid granular molecular", granular_molecular},
           {" # molecular-granular", granular_molecular},
           {"", granular_molecular},
           {" # hybrid bpm/sphere bond", rows("{id} 1 {place} 1 0.002 2500 1")},
           {" # sphere", rows("{id} 1 0.002 2500 {place} 0 0 0")},
           {" # bpm/sphere", rows("{id} 1 1 0.002 2500 {place} 0 0 0")}}) {
    SCOPED_TRACE(style);
    expect_chain(read_data(chain("title", style, lines)));
  }
  // A hybrid whose styles the title tells.
  expect_chain(read_data(chain("of atom_style hybrid bond sphere", " # hybrid", bond_sphere)));
  expect_chain(read_data(chain("of atom_style bpm/sphere: a chain", "", bpm)));
}

TEST(DataFiles, WhatTheStyleDoesNotTellIsRefused) {
  const std::string bpm = rows("{id} 1 1 0.002 2500 {place}");
  expect_refusal([&] { read_data(chain("title", "", bpm)); },
                 {"a.data:13", "molecule", "bpm/sphere"});
  expect_refusal([&] { read_data(chain("title", " # hybrid", bpm)); },
                 {"a.data:13", "hybrid bond"});
  expect_refusal([&] { read_data(chain("title", " # ellipsoid", bpm)); },
                 {"a.data:11", "ellipsoid"});
  expect_refusal([&] { read_data(chain("title", " # sphere", bpm)); },
                 {"a.data:13", "8 values", "7 ("});
  expect_refusal([&] { read_data(chain("title", " # bond", rows("{id} 1 1 {place}"))); },
                 {"a.data:13", "no diameter", "hybrid bond sphere"});
  // Eight values that both of two styles could mean.
  const std::string either = "1 1 1 2 2500 1 1 0\n2 1 1 2 2500 3 1 0\n3 1 1 2 2500 5 1 0\n";
  expect_refusal([&] { read_data(chain("title", "", either)); }, {"bpm/sphere or hybrid granular"});
  expect_refusal([&] { read_data(chain("made, units = cgs", " # bpm/sphere", bpm)); },
                 {"cgs", "si"});
}

TEST(DataFiles, TheHeaderCountsWhatFollows) {
  const std::string good = chain("title", " # sphere", rows("{id} 1 0.002 2500 {place}"));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  expect_refusal([&] { read_data(with("3 atoms", "2 atoms")); },
                 {"a.data:15", "more than the 2 atoms"});
  expect_refusal([&] { read_data(with("2 bonds", "1 bonds")); },
                 {"a.data:20", "more than the 1 bonds"});
  expect_refusal([&] { read_data(with("3 atoms", "4 atoms")); }, {"a.data:17", "3 of 4 atoms"});
  expect_refusal([&] { read_data(with("2 bonds", "3 bonds")); }, {"2 of 3 bonds"});
  expect_refusal([&] { read_data(with("\nBonds\n\n1 1 1 2\n2 1 2 3\n", "")); },
                 {"no section Bonds"});
  expect_refusal([&] { read_data(good + "\nAngles\n\n1 1 1 2 3\n"); }, {"Angles"});
  expect_chain(read_data(good + "\nVelocities\n\n1 0 0 0 0 0 0\n"));
}

TEST(DataFiles, NumbersOfAtomsMayHaveGaps) {
  const Specimen specimen = read_data(
      "title\n\n2 atoms\n1 bonds\n\nAtoms # sphere\n\n90 1 2 1 3 0 0\n7 1 2 1 1 0 0\n\nBonds\n\n"
      "1 1 90 7\n");
  EXPECT_EQ(specimen.position[0].x, 1);  // in the order of their numbers
  EXPECT_EQ(specimen.bonds, (std::vector<Pair>{{0, 1}}));
}

const char* const ring =
    "title{}\n\n3 atoms\n3 bonds\n\n0 6 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\nAtoms # sphere\n\n"
    "1 1 2 1 1 5 5{}\n2 1 2 1 3 5 5{}\n3 1 2 1 5 5 5{}\n\nBonds\n\n1 1 1 2\n2 1 2 3\n3 1 3 1\n";

TEST(DataFiles, BondsAcrossPeriodicSides) {
  // Without a word on the sides the bond of the first and the last spans the body.
  for (const auto& [title, flags] : std::vector<std::pair<const char*, const char*>>{
           {", boundary p f f", ""}, {"\n# boundary p f f", ""}, {"", " 1 0 0"}}) {
    const Specimen specimen =
        read_data(fmt::format(fmt::runtime(ring), title, flags, flags, flags));
    EXPECT_EQ(specimen.domain.periodic, (std::array<bool, 3>{true, false, false}));
    EXPECT_EQ(specimen.domain.upper.x, 6);
    for (const Pair& pair : specimen.bonds) EXPECT_DOUBLE_EQ(norm(rest_chord(specimen, pair)), 2);
  }
  std::string longer = fmt::format(fmt::runtime(ring), "", "", "", "");
  longer.replace(longer.find("1 5 5\n"), 6, "-5 5 5\n");
  expect_refusal([&] { read_data(longer); }, {"atoms 1 and 2", "8 m long", "boundary p p p"});
}

/// Two elements of radius 1, so many times the sum of their radii apart, and bonded.
Specimen stretched(double ratio) {
  return read_data(fmt::format(
      "title\n\n2 atoms\n1 bonds\n\nAtoms # sphere\n\n1 1 2 1 0 0 0\n2 1 2 1 {} 0 0\n\nBonds\n\n"
      "1 1 1 2\n",
      2 * ratio));
}

std::string notes_in_one(const Specimen& specimen) {
  std::string all;
  for (const std::string& note : notes_on(specimen, specimen.bonds)) all += note + "\n";
  return all;
}

TEST(DataFiles, LongBondsAreTold) {
  EXPECT_EQ(notes_in_one(stretched(1.5)).find("bonds are"), std::string::npos);
  EXPECT_NE(notes_in_one(stretched(2.25))
                .find("1 of 1 bonds are more than 1.5 times as long as the sum of their radii, the "
                      "longest, of elements 0 and 1, 2.25 times"),
            std::string::npos);
  EXPECT_NO_THROW(stretched(3));
  expect_refusal([] { stretched(3.01); }, {"atoms 1 and 2", "6.02 m long", "3.01 times"});
  // Whoever says which tolerance made them means it.
  Specimen told = stretched(2.25);
  told.bond_tolerance = 1.25;
  EXPECT_EQ(notes_in_one(told).find("bonds are"), std::string::npos);
  told.position[1].x = 7;
  told.domain.upper.x = 8;
  EXPECT_NO_THROW(check_specimen(told, "here"));
  told.bond_tolerance = -1;
  expect_refusal([&] { check_specimen(told, "here"); },
                 {"here: the bond of elements 0 and 1", "3.5 times"});
}

TEST(YadeFiles, ColumnsAndPeriods) {
  const auto read = [](const std::string& text) { return specimen_of_yade_text(text, "a.txt"); };
  const Specimen periodic = read("##PERIODIC:: 4 4 8\n#format x_y_z_r\n1 1 1 1\n3 1 1 1\n");
  EXPECT_EQ(periodic.domain.periodic, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(periodic.domain.upper.z, 8);
  EXPECT_EQ(periodic.domain.lower.z, 0);
  for (const char* text :
       {"#format x_y_z_r_clumpId\n1 2 3 0.5 -1\n4 2 3 0.5 0\n", "1 2 3 0.5 -1\n4 2 3 0.5 0\n",
        "#format id_x_y_z_r_matId\n7 1 2 3 0.5 0\n8 4 2 3 0.5 0\n",
        "#format x_y_z_r_attrs\n1 2 3 0.5 9 9 9\n4 2 3 0.5 9 9\n"}) {
    SCOPED_TRACE(text);
    const Specimen specimen = read(text);
    ASSERT_EQ(specimen.size(), 2u);
    EXPECT_EQ(specimen.position[1].x, 4);
    EXPECT_EQ(specimen.radius[0], 0.5);
  }
  expect_refusal([&] { read("1 2 3 0.5 0.25\n"); }, {"a.txt:1", "\"0.25\""});
  expect_refusal([&] { read("#format x_y_r\n1 2 3\n"); }, {"a.txt:1", "x_y_z_r_clumpId"});
  expect_refusal([&] { read("##PERIODIC:: 4 4\n1 1 1 1\n"); }, {"a.txt:1", "PERIODIC"});
}

/// A packing as others would write it: spheres alone.
Specimen bare(const Specimen& specimen, const char* format) {
  std::string text = "x,y,z,radius\n";
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    text += fmt::format(fmt::runtime(format), p.x, p.y, p.z, specimen.radius[i]) + "\n";
  }
  return specimen_of_csv_text(text, "bare.csv");
}

Specimen packing(const char* shape, std::array<bool, 3> periodic) {
  SpecimenRecipe recipe;
  recipe.shape = shape;
  recipe.length = 1e-3;
  recipe.radius = 0.25e-3;
  recipe.axis = "y";
  recipe.size = {1e-3, 0.9e-3, 1.1e-3};
  recipe.origin = {1e-4, -2e-4, 3e-4};
  recipe.elements = 400;
  recipe.periodic = periodic;
  return make_specimen(recipe);
}

TEST(TextFormats, TheBodyTravels) {
  for (const Specimen& specimen :
       {packing("cylinder", {false, true, false}), packing("box", {true, true, true}),
        packing("box", {true, false, false})}) {
    for (const Specimen& read : {specimen_of_liggghts_text(liggghts_text(specimen), "a.data"),
                                 specimen_of_yade_text(yade_text(specimen), "a.txt"),
                                 specimen_of_csv_text(csv_text(specimen), "a.csv")}) {
      EXPECT_EQ(read.domain.shape, specimen.domain.shape);
      EXPECT_EQ(read.domain.periodic, specimen.domain.periodic);
      EXPECT_EQ(read.domain.volume, specimen.domain.volume);
      EXPECT_EQ(read.domain.lower.x, specimen.domain.lower.x);
      EXPECT_EQ(read.domain.upper.z, specimen.domain.upper.z);
      EXPECT_EQ(read.domain.axis, specimen.domain.axis);
      EXPECT_EQ(read.domain.radius, specimen.domain.radius);
      EXPECT_EQ(find_bonds(read, 0), specimen.bonds);
    }
    EXPECT_EQ(read_data(liggghts_text(specimen)).bonds, specimen.bonds);
  }
}

TEST(Precision, TouchingFollowsTheDigitsOfTheFile) {
  // 6 x 6 x 6 touching spheres whose coordinates went through single precision.
  Specimen grid;
  for (int k = 0; k < 216; ++k) {
    const auto at = [](int n) { return static_cast<double>(static_cast<float>(0.1 * n)); };
    grid.position.push_back({at(k / 36), at(k / 6 % 6), at(k % 6)});
    grid.radius.push_back(0.05);
  }
  EXPECT_EQ(find_bonds(bare(grid, "{:.9g},{:.9g},{:.9g},{:.9g}"), 0).size(), 540u);
  EXPECT_EQ(find_bonds(bare(grid, "{:.17g},{:.17g},{:.17g},{:.9g}"), 0).size(), 540u);
  // Six digits, as YADE writes them; few digits are no sign of a coarse file.
  const Specimen cube = packing("box", {false, false, false});
  const Specimen six = bare(cube, "{:.6g},{:.6g},{:.6g},{:.6g}");
  const std::vector<Pair> found = find_bonds(six, 0);
  EXPECT_TRUE(std::includes(found.begin(), found.end(), cube.bonds.begin(), cube.bonds.end()));
  EXPECT_LT(found.size(), cube.bonds.size() + 25);
  EXPECT_LT(specimen_of_csv_text("x,y,z,radius\n0,0,0,0.1\n0.2,0,0,0.1\n", "a").contact_margin,
            1e-6);
  EXPECT_EQ(bare(cube, "{:.17g},{:.17g},{:.17g},{:.17g}").contact_margin, 1e-12);
}

TEST(ImportedBodies, TheirVolumeIsThatOfTheirCells) {
  const auto volume = [](const Specimen& specimen) {
    return cut_cell_volume(bare(specimen, "{:.17g},{:.17g},{:.17g},{:.17g}"));
  };
  const Specimen cylinder = packing("cylinder", {false, false, false});
  EXPECT_NEAR(volume(cylinder) / cylinder.domain.volume, 1, 0.03);
  const Specimen box = packing("box", {false, false, false});
  EXPECT_NEAR(volume(box) / box.domain.volume, 1, 0.03);
  const Specimen periodic = packing("box", {true, true, true});
  EXPECT_NEAR(cut_cell_volume(periodic) / periodic.domain.volume, 1, 1e-9);
  // All that lies within a ball.
  Specimen ball;
  const Vector centre = 0.5 * (box.domain.lower + box.domain.upper);
  const double radius = 0.45e-3;
  for (std::size_t i = 0; i < box.size(); ++i)
    if (norm(box.position[i] - centre) < radius) {
      ball.position.push_back(box.position[i]);
      ball.radius.push_back(box.radius[i]);
    }
  EXPECT_NEAR(volume(ball) / (4.0 / 3.0 * M_PI * std::pow(radius, 3)), 1, 0.15);
}

TEST(ImportedBodies, HaveNoWalls) {
  const Specimen bare_box =
      bare(packing("box", {false, false, false}), "{:.17g},{:.17g},{:.17g},{:.17g}");
  EXPECT_TRUE(walls_of(bare_box.domain).empty());
}

TEST(Pieces, AreNamed) {
  Specimen specimen;
  for (const double x : {0.0, 2.0, 10.0, 12.0, 14.0, 30.0}) {
    specimen.position.push_back({x, 0, 0});
    specimen.radius.push_back(1);
  }
  const std::vector<std::string> notes = notes_on(specimen, find_bonds({specimen}, 0));
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].rfind("1 elements have no bond", 0), 0u);
  EXPECT_NE(notes[1].find("2 pieces"), std::string::npos);
  EXPECT_NE(notes[1].find("3 elements with element 2 at (10, 0, 0) m"), std::string::npos);
}

TEST(Pieces, TwoElementsInOnePlaceAreRefused) {
  Specimen specimen = specimen_of_csv_text(
      "x,y,z,radius\n4,0,0,1\n0,0,0,1\n2,0,0,1\n2.0000001,0,0,1\n", "twice.csv");
  expect_refusal([&] { check_specimen(specimen, "twice.csv"); },
                 {"twice.csv", "elements 2 and 3", "(2, 0, 0) m"});
}

}  // namespace solidem::files_of_others_test
