// SPDX-License-Identifier: GPL-2.0-or-later
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <sstream>

#include "model/error.hpp"
#include "output/hdf5.hpp"
#include "specimen/recipe.hpp"
#include "specimen/specimen_file.hpp"

namespace solidem::files_test {

namespace fs = std::filesystem;

class SpecimenFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = fs::temp_directory_path() /
                 ("solidem_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  void write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }

  fs::path directory_;
};

const Specimen& small_packing() {
  static const Specimen specimen = [] {
    SpecimenRecipe recipe;
    recipe.shape = "cylinder";
    recipe.axis = "y";
    recipe.length = 1e-3;
    recipe.radius = 0.25e-3;
    recipe.elements = 200;
    recipe.periodic = {false, true, false};
    Specimen made = make_specimen(recipe);
    made.sets["grip.left"] = {0, 5, 199};
    return made;
  }();
  return specimen;
}

void copy_attributes(const Hdf5Group& from, const Hdf5Group& to) {
  for (const std::string& name : from.attribute_names()) try {
      to.set_attribute(name, from.text_attribute(name));
    } catch (const InputError&) {
      to.set_attribute(name, from.numbers_attribute(name));
    }
}

/// Copies all of a group but the objects of some paths.
void copy_group(const Hdf5Group& from, const Hdf5Group& to, const std::set<std::string>& without,
                const std::string& above = "") {
  copy_attributes(from, to);
  for (const std::string& name : from.names()) {
    const std::string place = above + name;
    if (without.count(place) > 0) continue;
    std::vector<std::size_t> shape;
    try {
      shape = from.shape(name);
    } catch (const InputError&) {  // no dataset
      copy_group(from.group(name), to.make_group(name), without, place + "/");
      continue;
    }
    const std::size_t columns = shape.size() > 1 ? shape[1] : 0;
    to.write(name, from.read<double>(name, shape.at(0), columns).data(), shape);
    copy_attributes(from.object(name), to.object(name));
  }
}

/// What another program might make of a specimen: the small packing without some objects, and with
/// others.
void write_changed(const std::string& path, const std::set<std::string>& without,
                   const std::function<void(const Hdf5File&)>& change) {
  write_specimen(path, small_packing());
  const Hdf5File sealed = Hdf5File::open(path);
  replace_hdf5_file(path, [&](const Hdf5File& file) {
    copy_group(sealed, file, without);
    change(file);
  });
}

// Bit for bit.
void expect_same_spheres(const Specimen& a, const Specimen& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.position.data(), b.position.data(), a.size() * sizeof(Vector)), 0);
  EXPECT_EQ(std::memcmp(a.radius.data(), b.radius.data(), a.size() * sizeof(double)), 0);
}

template <class Act>
void expect_input_error(Act act, const std::vector<std::string>& texts) {
  try {
    act();
    ADD_FAILURE() << "no error; expected one with: " << texts[0];
  } catch (const InputError& error) {
    for (const std::string& text : texts)
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos)
          << "\"" << text << "\" is not in: " << error.what();
  }
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST_F(SpecimenFile, Hdf5KeepsEverything) {
  const Specimen& specimen = small_packing();
  write_specimen(path("a.h5"), specimen);
  const Specimen read = read_specimen(path("a.h5"));
  expect_same_spheres(read, specimen);
  EXPECT_EQ(read.bonds, specimen.bonds);
  EXPECT_EQ(read.bond_tolerance, specimen.bond_tolerance);
  EXPECT_EQ(read.sets, specimen.sets);
  EXPECT_EQ(read.report, specimen.report);
  EXPECT_EQ(read.domain.shape, "cylinder");
  EXPECT_EQ(read.domain.axis, 1);
  EXPECT_EQ(read.domain.radius, specimen.domain.radius);
  EXPECT_EQ(read.domain.volume, specimen.domain.volume);
  EXPECT_EQ(read.domain.periodic, specimen.domain.periodic);
  EXPECT_EQ(read.domain.lower.x, specimen.domain.lower.x);
  EXPECT_EQ(read.domain.upper.z, specimen.domain.upper.z);
}

TEST_F(SpecimenFile, Hdf5KeepsTheOutlineOfAWedge) {
  SpecimenRecipe recipe;
  recipe.shape = "wedge";
  recipe.axis = "z";
  recipe.length = recipe.radius = 1e-3;
  recipe.inner_radius = 0.3e-3;
  recipe.angle = 1.25;
  recipe.elements = 100;
  Specimen specimen = make_specimen(recipe);
  write_specimen(path("a.h5"), specimen);
  const Domain read = read_specimen(path("a.h5")).domain;
  EXPECT_EQ(read.shape, "wedge");
  EXPECT_EQ(read.inner_radius, 0.3e-3);
  EXPECT_EQ(read.angle, 1.25);
  specimen.domain.angle = 3.5;
  expect_input_error([&] { write_specimen(path("b.h5"), specimen); }, {"angle 3.5 rad", "< pi"});
  specimen.domain.angle = 1.25;
  specimen.domain.inner_radius = 2e-3;
  expect_input_error([&] { write_specimen(path("b.h5"), specimen); }, {"inner radius 0.002 m"});
}

TEST_F(SpecimenFile, Hdf5HasTheNamesOtherCodesRead) {
  write_specimen(path("a.h5"), small_packing());
  const Hdf5File file = Hdf5File::open(path("a.h5"));
  EXPECT_EQ(file.text_attribute("format"), "solidem specimen");
  EXPECT_EQ(file.integer_attribute("version"), 1);
  EXPECT_EQ(file.shape("elements/position"), (std::vector<std::size_t>{200, 3}));
  EXPECT_EQ(file.shape("elements/radius"), (std::vector<std::size_t>{200}));
  EXPECT_EQ(file.shape("bonds/pairs"), (std::vector<std::size_t>{small_packing().bonds.size(), 2}));
  EXPECT_EQ(file.object("bonds/pairs").number_attribute("tolerance"), 0.0);
  EXPECT_EQ(file.group("report").numbers_attribute("fabric", 3).size(), 3u);
}

TEST_F(SpecimenFile, TextFormatsKeepEveryBitOfTheSpheres) {
  const Specimen& specimen = small_packing();
  for (const char* name : {"a.data", "a.txt", "a.csv"}) {
    SCOPED_TRACE(name);
    write_specimen(path(name), specimen);
    const Specimen read = read_specimen(path(name));
    expect_same_spheres(read, specimen);
    EXPECT_EQ(read.domain.shape, "cylinder");
    EXPECT_EQ(read.domain.volume, specimen.domain.volume);
  }
  EXPECT_EQ(read_specimen(path("a.data")).bonds, specimen.bonds);
}

TEST_F(SpecimenFile, ImportedDomainIsAroundTheSpheres) {
  write_text("two.txt", "# x y z r\n0 0 0 1\n\n3 0 0 2\n");
  const Specimen specimen = read_specimen(path("two.txt"));
  EXPECT_EQ(specimen.domain.lower.x, -1);
  EXPECT_EQ(specimen.domain.upper.x, 5);
  EXPECT_EQ(specimen.domain.upper.y, 2);
  // More than the spheres, less than the box around each.
  EXPECT_GT(specimen.domain.volume, sphere_volume(specimen));
  EXPECT_LT(specimen.domain.volume, 8 + 64);
}

TEST_F(SpecimenFile, UnknownAndMissingFiles) {
  expect_input_error([&] { read_specimen(path("none.h5")); }, {"none.h5", "no such file"});
  expect_input_error([&] { read_specimen(path("none.txt")); }, {"none.txt", "no such file"});
  expect_input_error([&] { read_specimen(path("a.stl")); }, {"a.stl", ".h5", ".csv"});
  expect_input_error([&] { write_specimen(path("a.stl"), small_packing()); }, {"a.stl", ".data"});
  write_text("empty.h5", "");
  expect_input_error([&] { read_specimen(path("empty.h5")); }, {"empty.h5", "no HDF5 file"});
  write_text("text.h5", "I am a text, not what the name says, and long enough to look at.\n");
  expect_input_error([&] { read_specimen(path("text.h5")); }, {"text.h5", "no HDF5 file"});
  write_text("empty.csv", "");
  expect_input_error([&] { read_specimen(path("empty.csv")); }, {"empty.csv", "empty"});
}

TEST_F(SpecimenFile, CutShortAtAnyPlace) {
  write_specimen(path("whole.h5"), small_packing());
  const auto size = fs::file_size(path("whole.h5"));
  for (int part = 0; part < 40; ++part) {
    fs::copy_file(path("whole.h5"), path("cut.h5"), fs::copy_options::overwrite_existing);
    fs::resize_file(path("cut.h5"), size * part / 40);
    expect_input_error([&] { read_specimen(path("cut.h5")); }, {"cut.h5"});
  }
  expect_input_error([&] { read_specimen(path("cut.h5")); }, {"cut short"});
}

TEST_F(SpecimenFile, AFlippedBitIsRefusedOrHarmless) {
  const Specimen& specimen = small_packing();
  write_specimen(path("whole.h5"), specimen);
  ASSERT_EQ(read_specimen(path("whole.h5")).bonds, specimen.bonds);
  std::string bytes = content(path("whole.h5"));
  int refused = 0, harmless = 0;
  for (std::size_t k = 0; k < 1500; ++k) {
    const std::size_t at = k * 7919 % bytes.size();
    const auto bit = static_cast<char>(1U << (k % 8));
    bytes[at] = static_cast<char>(bytes[at] ^ bit);
    std::ofstream(path("flipped.h5"), std::ios::binary) << bytes;
    bytes[at] = static_cast<char>(bytes[at] ^ bit);
    try {
      const Specimen read = read_specimen(path("flipped.h5"));
      expect_same_spheres(read, specimen);
      ASSERT_TRUE(read.bonds == specimen.bonds && read.sets == specimen.sets &&
                  read.report == specimen.report && read.domain.volume == specimen.domain.volume)
          << "byte " << at;
      ++harmless;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1400);
  EXPECT_LT(harmless, 20);  // in the line of the checksum
}

TEST_F(SpecimenFile, FilesWithoutSealAreRead) {
  replace_hdf5_file(path("old.h5"), [](const Hdf5File& file) {
    file.set_attribute("format", "solidem specimen");
    file.set_attribute("version", 1);
    const std::vector<float> position{0.1F, 0, 0, 0.3F, 0, 0}, radius{0.1F, 0.1F};
    file.make_group("elements").write("position", position.data(), {2, 3});
    file.write("elements/radius", radius);
    const Hdf5Group domain = file.make_group("domain");
    domain.set_attribute("shape", "box");
    domain.set_attribute("lower", std::vector<double>{0, -0.1, -0.1});
    domain.set_attribute("upper", std::vector<double>{0.4, 0.1, 0.1});
    domain.set_attribute("periodic", std::vector<std::uint8_t>{0, 0, 0});
    domain.set_attribute("volume", 0.016);
    domain.set_attribute("axis", -1);
    domain.set_attribute("radius", 0.0);
  });
  const Specimen read = read_specimen(path("old.h5"));
  EXPECT_EQ(read.size(), 2u);
  EXPECT_GT(read.contact_margin, 1e-8);  // single precision
}

TEST_F(SpecimenFile, AFileTellsWhetherItIsSealed) {
  write_specimen(path("a.h5"), small_packing());
  EXPECT_TRUE(Hdf5File::open(path("a.h5")).is_sealed());
  write_changed(path("b.h5"), {},
                [](const Hdf5File& f) { f.group("domain").set_attribute("volume", 1e-9); });
  EXPECT_FALSE(Hdf5File::open(path("b.h5")).is_sealed());
  const Specimen changed = read_specimen(path("b.h5"));
  EXPECT_EQ(changed.domain.volume, 1e-9);
  expect_same_spheres(changed, small_packing());
  EXPECT_EQ(changed.bonds, small_packing().bonds);
}

TEST_F(SpecimenFile, AByteOrderMarkIsNoPartOfTheText) {
  write_text("a.csv", "\xEF\xBB\xBFx,y,z,radius\n0,0,0,1\n2,0,0,1\n");
  EXPECT_EQ(read_specimen(path("a.csv")).size(), 2u);
}

TEST_F(SpecimenFile, OtherHdf5Files) {
  replace_hdf5_file(path("other.h5"),
                    [](const Hdf5File& file) { file.set_attribute("format", "weather"); });
  expect_input_error([&] { read_specimen(path("other.h5")); }, {"no solidem specimen", "weather"});
  write_changed(path("future.h5"), {}, [](const Hdf5File& f) { f.set_attribute("version", 7); });
  expect_input_error([&] { read_specimen(path("future.h5")); }, {"version 7", "version 1"});
}

TEST_F(SpecimenFile, MissingAndMisshapenData) {
  const std::vector<double> numbers(200, 1.0);
  const auto nothing = [](const Hdf5File&) {};
  const auto read = [&] { read_specimen(path("bad.h5")); };
  write_changed(path("bad.h5"), {"elements/radius"}, nothing);
  expect_input_error(read, {"radius", "missing"});
  write_changed(path("bad.h5"), {"elements/position"}, [&](const Hdf5File& f) {
    f.write("elements/position", numbers.data(), {100, 2});
  });
  expect_input_error(read, {"position", "(100, 2)", "3"});
  write_changed(path("bad.h5"), {"elements/radius"},
                [&](const Hdf5File& f) { f.write("elements/radius", numbers.data(), {150}); });
  expect_input_error(read, {"radius", "(150)", "200"});
  write_changed(path("bad.h5"), {"domain"}, nothing);
  expect_input_error(read, {"domain", "missing"});
}

TEST_F(SpecimenFile, ImpossibleValuesAreNamed) {
  const auto with = [&](auto change) { write_changed(path("bad.h5"), {}, change); };
  const auto with_other = [&](const std::string& name, const std::vector<double>& values,
                              const std::vector<std::size_t>& shape) {
    write_changed(path("bad.h5"), {name},
                  [&](const Hdf5File& f) { f.write(name, values.data(), shape); });
  };
  const auto with_bonds = [&](const std::vector<std::int32_t>& values) {
    write_changed(path("bad.h5"), {"bonds/pairs"}, [&](const Hdf5File& f) {
      f.write("bonds/pairs", values.data(), {values.size() / 2, 2});
    });
  };
  const auto read = [&] { read_specimen(path("bad.h5")); };

  std::vector<double> radius = small_packing().radius;
  radius[17] = -0.25;
  with_other("elements/radius", radius, {200});
  expect_input_error(read, {"bad.h5", "element 17", "-0.25"});
  radius[17] = std::numeric_limits<double>::quiet_NaN();
  with_other("elements/radius", radius, {200});
  expect_input_error(read, {"element 17", "nan"});
  std::vector<double> position(600, 0.0);
  position[3 * 42 + 1] = std::numeric_limits<double>::infinity();
  with_other("elements/position", position, {200, 3});
  expect_input_error(read, {"element 42", "inf"});

  with_bonds({0, 1, 3, 200});
  expect_input_error(read, {"bond 1", "3 and 200", "< 200"});
  with_bonds({-1, 1});
  expect_input_error(read, {"bond 0", "-1"});
  with_bonds({4, 4});
  expect_input_error(read, {"bond 0", "4 and 4"});
  with_bonds({0, 1, 2, 3, 2, 3});
  expect_input_error(read, {"2 and 3", "twice"});
  with_bonds({2, 3, 0, 1});
  expect_input_error(read, {"bond 1", "rising order"});

  with([](const Hdf5File& f) { f.group("domain").set_attribute("volume", -1.0); });
  expect_input_error(read, {"volume", "-1"});
  with([](const Hdf5File& f) { f.group("domain").set_attribute("shape", "blob"); });
  expect_input_error(read, {"blob"});
  with([](const Hdf5File& f) { f.write("sets/far", std::vector<std::int32_t>{3, 900}); });
  expect_input_error(read, {"\"far\"", "900"});
}

TEST_F(SpecimenFile, TextErrorsNameTheLine) {
  write_text("a.txt", "0 0 0 1\n2 0 0\n");
  expect_input_error([&] { read_specimen(path("a.txt")); },
                     {"a.txt:2", "3 values", "x y z radius"});
  write_text("b.txt", "0 0 0 1\n\n2 zero 0 1\n");
  expect_input_error([&] { read_specimen(path("b.txt")); }, {"b.txt:3", "\"zero\""});
  write_text("c.csv", "x,y,z,radius\n0,0,0,1\n0,1,0,-3\n");
  expect_input_error([&] { read_specimen(path("c.csv")); }, {"c.csv:3", "-3"});
  write_text("d.csv", "0,0,0,1\n");
  expect_input_error([&] { read_specimen(path("d.csv")); }, {"d.csv:1", "x,y,z,radius"});
  write_text("e.csv", "x,y,z,radius\n");
  expect_input_error([&] { read_specimen(path("e.csv")); }, {"no spheres"});
  write_text("f.txt", "0 0 nan 1\n");
  expect_input_error([&] { read_specimen(path("f.txt")); }, {"element 0", "nan"});

  const std::string header = "title\n\n2 atoms\n1 bonds\n1 atom types\n\nAtoms\n\n";
  const std::string atoms = "1 1 0 0 0 2 1000 1\n2 1 2 0 0 2 1000 1\n";
  write_text("g.data", header + atoms + "\nBonds\n\n1 1 1 2\n");
  EXPECT_EQ(read_specimen(path("g.data")).bonds, (std::vector<Pair>{{0, 1}}));
  write_text("h.data", header + "1 1 0 0 0 2 1000 1\n");
  expect_input_error([&] { read_specimen(path("h.data")); }, {"1 of 2 atoms"});
  write_text("i.data", header + "1 1 0 0 0 2 1000 1\n1 1 2 0 0 2 1000 1\n");
  expect_input_error([&] { read_specimen(path("i.data")); }, {"i.data:10", "twice"});
  write_text("j.data", header + atoms + "\nBonds\n\n1 1 1 3\n");
  expect_input_error([&] { read_specimen(path("j.data")); }, {"j.data:14", "1 and 3"});
  write_text("k.data", "title\n\n3 balls\n");
  expect_input_error([&] { read_specimen(path("k.data")); }, {"no section Atoms"});
}

TEST_F(SpecimenFile, FailedWriteKeepsTheOldFile) {
  // A limit on the size of files stands for a full disk: the system refuses to write further.
  struct SmallFiles {
    rlimit before{};
    SmallFiles() {
      getrlimit(RLIMIT_FSIZE, &before);
      const rlimit limit{6000, before.rlim_max};
      std::signal(SIGXFSZ, SIG_IGN);
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SmallFiles() { setrlimit(RLIMIT_FSIZE, &before); }
  };
  for (const char* name : {"a.h5", "a.csv", "a.data"}) {
    SCOPED_TRACE(name);
    write_specimen(path(name), small_packing());
    const std::string before = content(path(name));
    {
      const SmallFiles limit;
      EXPECT_THROW(write_specimen(path(name), small_packing()), RunError);
    }
    EXPECT_EQ(content(path(name)), before);
  }
  // Nothing is left lying about.
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()), 3);
}

TEST_F(SpecimenFile, WriteWithoutDirectory) {
  EXPECT_THROW(write_specimen(path("nowhere/a.h5"), small_packing()), RunError);
  EXPECT_THROW(write_specimen(path("nowhere/a.csv"), small_packing()), RunError);
}

TEST_F(SpecimenFile, ImpossibleSpecimensAreNotWritten) {
  Specimen specimen = small_packing();
  specimen.radius[3] = 0;
  expect_input_error([&] { write_specimen(path("a.h5"), specimen); }, {"element 3"});
  EXPECT_FALSE(fs::exists(path("a.h5")));
}

}  // namespace solidem::files_test
