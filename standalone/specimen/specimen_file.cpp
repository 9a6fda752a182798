// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/specimen_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "model/error.hpp"
#include "output/hdf5.hpp"
#include "output/read_file.hpp"
#include "output/replace_file.hpp"
#include "specimen/text_formats.hpp"

namespace solidem {

namespace {

constexpr const char* format_name = "solidem specimen";
constexpr int format_version = 1;

static_assert(sizeof(Vector) == 3 * sizeof(double), "positions are rows of three numbers");
static_assert(sizeof(Pair) == 2 * sizeof(std::int32_t), "pairs are rows of two numbers");

std::vector<double> numbers(const Vector& v) {
  return {v.x, v.y, v.z};
}

Vector vector_attribute(const Hdf5Group& group, const std::string& name) {
  const std::vector<double> v = group.numbers_attribute(name, 3);
  return {v[0], v[1], v[2]};
}

void write_hdf5(const Hdf5File& file, const Specimen& specimen) {
  file.set_attribute("format", format_name);
  file.set_attribute("version", format_version);

  const Hdf5Group elements = file.make_group("elements");
  elements.write("position", &specimen.position[0].x, {specimen.size(), 3});
  elements.write("radius", specimen.radius);

  if (!specimen.bonds.empty()) {
    const Hdf5Group bonds = file.make_group("bonds");
    bonds.write("pairs", &specimen.bonds[0].i, {specimen.bonds.size(), 2});
    bonds.object("pairs").set_attribute("tolerance", specimen.bond_tolerance);
  }

  const Domain& body = specimen.domain;
  const Hdf5Group domain = file.make_group("domain");
  domain.set_attribute("shape", body.shape);
  domain.set_attribute("lower", numbers(body.lower));
  domain.set_attribute("upper", numbers(body.upper));
  domain.set_attribute(
      "periodic", std::vector<std::uint8_t>{body.periodic[0], body.periodic[1], body.periodic[2]});
  domain.set_attribute("volume", body.volume);
  domain.set_attribute("axis", body.axis);
  domain.set_attribute("radius", body.radius);
  domain.set_attribute("inner_radius", body.inner_radius);
  domain.set_attribute("angle", body.angle);

  const Hdf5Group report = file.make_group("report");
  const auto& figures = specimen.report;
  for (const auto& [name, value] : figures)
    if (name.rfind("fabric_", 0) != 0) report.set_attribute(name, value);
  if (figures.count("fabric_x"))
    report.set_attribute("fabric",
                         std::vector<double>{figures.at("fabric_x"), figures.at("fabric_y"),
                                             figures.at("fabric_z")});

  for (const auto& [name, members] : specimen.sets) file.write("sets/" + name, members);
}

Specimen read_hdf5(const std::string& path) {
  const Hdf5File file = Hdf5File::open(path);
  if (!file.has_attribute("format") || file.text_attribute("format") != format_name)
    throw InputError(path + ": is an HDF5 file, but no solidem specimen (attribute format is " +
                     (file.has_attribute("format") ? '"' + file.text_attribute("format") + '"'
                                                   : std::string("missing")) +
                     ", expected \"" + format_name + "\")");
  const std::int64_t version = file.integer_attribute("version");
  if (version != format_version)
    throw InputError(fmt::format("{}: specimen format version {}, this program reads version {}",
                                 path, version, format_version));

  Specimen specimen;
  const Hdf5Group elements = file.group("elements");
  const std::vector<double> position = elements.read<double>("position", Hdf5Group::any_rows, 3);
  specimen.position.resize(position.size() / 3);
  for (std::size_t i = 0; i < specimen.size(); ++i)
    specimen.position[i] = {position[3 * i], position[3 * i + 1], position[3 * i + 2]};
  specimen.radius = elements.read<double>("radius", specimen.size());

  if (file.has("bonds/pairs")) {
    const Hdf5Group bonds = file.group("bonds");
    const std::vector<std::int32_t> pairs =
        bonds.read<std::int32_t>("pairs", Hdf5Group::any_rows, 2);
    specimen.bonds.resize(pairs.size() / 2);
    for (std::size_t b = 0; b < specimen.bonds.size(); ++b)
      specimen.bonds[b] = {pairs[2 * b], pairs[2 * b + 1]};
    const Hdf5Group set = bonds.object("pairs");
    if (set.has_attribute("tolerance")) specimen.bond_tolerance = set.number_attribute("tolerance");
  }

  const Hdf5Group domain = file.group("domain");
  Domain& body = specimen.domain;
  body.shape = domain.text_attribute("shape");
  body.lower = vector_attribute(domain, "lower");
  body.upper = vector_attribute(domain, "upper");
  const std::vector<double> periodic = domain.numbers_attribute("periodic", 3);
  for (int axis = 0; axis < 3; ++axis) body.periodic[axis] = periodic[axis] != 0;
  body.volume = domain.number_attribute("volume");
  body.axis = static_cast<int>(domain.integer_attribute("axis"));
  body.radius = domain.number_attribute("radius");
  if (domain.has_attribute("inner_radius"))
    body.inner_radius = domain.number_attribute("inner_radius");
  if (domain.has_attribute("angle")) body.angle = domain.number_attribute("angle");

  if (file.has("report")) {
    const Hdf5Group report = file.group("report");
    for (const std::string& name : report.attribute_names()) {
      const std::vector<double> values = report.numbers_attribute(name);
      if (values.size() == 1) specimen.report[name] = values[0];
      if (values.size() == 3)
        for (int axis = 0; axis < 3; ++axis)
          specimen.report[name + "_" + "xyz"[axis]] = values[axis];
    }
  }
  if (file.has("sets")) {
    const Hdf5Group sets = file.group("sets");
    for (const std::string& name : sets.names())
      specimen.sets[name] = sets.read<std::int32_t>(name);
  }
  return specimen;
}

std::string read_text(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(path + ": there is no such file");
  if (std::filesystem::is_directory(path, error)) throw InputError(path + ": is a directory");
  return read_file(path);
}

std::string extension_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

[[noreturn]] void fail_extension(const std::string& path) {
  throw InputError(path +
                   ": the extension says the format of a specimen; expected .h5 (solidem), .data "
                   "(LIGGGHTS), .txt (YADE: x y z r) or .csv (x,y,z,radius)");
}

}  // namespace

Specimen read_specimen(const std::string& path) {
  const std::string extension = extension_of(path);
  Specimen specimen;
  if (extension == ".h5")
    specimen = read_hdf5(path);
  else if (extension == ".data")
    specimen = specimen_of_liggghts_text(read_text(path), path);
  else if (extension == ".txt")
    specimen = specimen_of_yade_text(read_text(path), path);
  else if (extension == ".csv")
    specimen = specimen_of_csv_text(read_text(path), path);
  else
    fail_extension(path);
  check_specimen(specimen, path);
  return specimen;
}

void write_specimen(const std::string& path, const Specimen& specimen) {
  const std::string extension = extension_of(path);
  check_specimen(specimen, "specimen for " + path);
  if (extension == ".h5")
    replace_hdf5_file(path, [&](const Hdf5File& file) { write_hdf5(file, specimen); });
  else if (extension == ".data")
    replace_text_file(path, liggghts_text(specimen));
  else if (extension == ".txt")
    replace_text_file(path, yade_text(specimen));
  else if (extension == ".csv")
    replace_text_file(path, csv_text(specimen));
  else
    fail_extension(path);
}

void put_specimen(const Hdf5File& file, const Specimen& specimen) {
  write_hdf5(file, specimen);
}

}  // namespace solidem
