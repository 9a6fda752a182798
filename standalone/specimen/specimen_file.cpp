// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/specimen_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/hdf5.hpp"
#include "output/read_file.hpp"
#include "output/replace_file.hpp"
#include "specimen/body_lines.hpp"
#include "specimen/cut_cells.hpp"
#include "specimen/domain_file.hpp"
#include "specimen/outline_file.hpp"
#include "specimen/report.hpp"
#include "specimen/shape.hpp"
#include "specimen/text_formats.hpp"
#include "specimen/walls.hpp"

namespace solidem {

namespace {

constexpr const char* format_name = "solidem specimen";
constexpr int format_version = 1;

static_assert(sizeof(Vector) == 3 * sizeof(double), "positions are rows of three numbers");
static_assert(sizeof(Pair) == 2 * sizeof(std::int32_t), "pairs are rows of two numbers");

// In their order: groups come back by name.
void write_bodies(const Hdf5File& file, const Specimen& specimen) {
  if (specimen.bodies.empty()) return;
  const Hdf5Group bodies = file.make_group("bodies");
  for (std::size_t b = 0; b < specimen.bodies.size(); ++b) {
    const Body& body = specimen.bodies[b];
    const Hdf5Group group = bodies.make_group(fmt::format("{:06}", b));
    group.set_attribute("name", body.name);
    group.set_attribute("shape", body.shape);
    group.set_attribute("lower", row_of(body.lower));
    group.set_attribute("upper", row_of(body.upper));
    group.set_attribute("volume", body.volume);
    group.write("elements", body.elements);
    if (!body.bonded_to.empty()) group.write("bonded_to", body.bonded_to);
  }
}

std::vector<Body> read_bodies(const Hdf5File& file) {
  std::vector<Body> found;
  if (!file.has("bodies")) return found;
  const Hdf5Group bodies = file.group("bodies");
  for (const std::string& number : bodies.names()) {
    const Hdf5Group group = bodies.group(number);
    Body body;
    body.name = group.text_attribute("name");
    body.shape = group.text_attribute("shape");
    body.lower = read_vector(group, "lower");
    body.upper = read_vector(group, "upper");
    body.volume = group.number_attribute("volume");
    body.elements = group.read<std::int32_t>("elements");
    if (group.has("bonded_to")) body.bonded_to = group.read<std::int32_t>("bonded_to");
    found.push_back(std::move(body));
  }
  return found;
}

void write_hdf5(const Hdf5File& file, const Specimen& specimen) {
  file.set_attribute("format", format_name);
  file.set_attribute("version", format_version);

  const Hdf5Group elements = file.make_group("elements");
  elements.write("position", &specimen.position[0].x, {specimen.size(), 3});
  elements.write("radius", specimen.radius);
  elements.object("position").set_attribute("margin", specimen.contact_margin);

  if (!specimen.bonds.empty()) {
    const Hdf5Group bonds = file.make_group("bonds");
    bonds.write("pairs", &specimen.bonds[0].i, {specimen.bonds.size(), 2});
    bonds.object("pairs").set_attribute("tolerance", specimen.bond_tolerance);
  }

  write_domain(file.make_group("domain"), specimen.domain);

  const Hdf5Group report = file.make_group("report");
  const auto& figures = specimen.report;
  for (const auto& [name, value] : figures)
    if (name.rfind("fabric_", 0) != 0) report.set_attribute(name, value);
  if (figures.count("fabric_x"))
    report.set_attribute("fabric",
                         std::vector<double>{figures.at("fabric_x"), figures.at("fabric_y"),
                                             figures.at("fabric_z")});

  for (const auto& [name, members] : specimen.sets) file.write("sets/" + name, members);
  write_bodies(file, specimen);
  if (specimen.outline != nullptr) write_outline(file, *specimen.outline);
}

// Whether positions came from a program that keeps them in single precision.
bool is_single_precision(const Specimen& specimen) {
  const auto is_single = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
  return std::all_of(specimen.position.begin(), specimen.position.end(), [&](const Vector& p) {
    return is_single(p.x) && is_single(p.y) && is_single(p.z);
  });
}

void check_format(const Hdf5File& file, const std::string& path) {
  if (!file.has_attribute("format") || file.text_attribute("format") != format_name)
    throw InputError(path + ": is an HDF5 file, but no solidem specimen (attribute format is " +
                     (file.has_attribute("format") ? '"' + file.text_attribute("format") + '"'
                                                   : std::string("missing")) +
                     ", expected \"" + format_name + "\")");
  const std::int64_t version = file.integer_attribute("version");
  if (version != format_version)
    throw InputError(fmt::format("{}: specimen format version {}, this program reads version {}",
                                 path, version, format_version));
}

Specimen read_hdf5(const std::string& path) {
  const Hdf5File file = Hdf5File::open(path);
  check_format(file, path);
  Specimen specimen;
  const Hdf5Group elements = file.group("elements");
  const std::vector<double> position = elements.read<double>("position", Hdf5Group::any_rows, 3);
  specimen.position.resize(position.size() / 3);
  for (std::size_t i = 0; i < specimen.size(); ++i)
    specimen.position[i] = {position[3 * i], position[3 * i + 1], position[3 * i + 2]};
  specimen.radius = elements.read<double>("radius", specimen.size());
  const Hdf5Group places = elements.object("position");
  if (places.has_attribute("margin"))
    specimen.contact_margin = places.number_attribute("margin");
  else if (!specimen.radius.empty() && is_single_precision(specimen))
    specimen.contact_margin = contact_margin(0x1p-24 * largest_coordinate(specimen), specimen);

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

  specimen.domain = read_domain(file.group("domain"));
  specimen.outline = read_outline(file, specimen.domain);

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
  specimen.bodies = read_bodies(file);
  check_specimen(specimen, path);
  // Earlier versions wrote no seal, and took bare spheres for the box around them.
  Domain& body = specimen.domain;
  if (!file.is_sealed() && body.shape == "imported" && body.volume == volume_of(body))
    body.volume = 0;
  return specimen;
}

// What no file tells of bare spheres.
void settle_body(Specimen& specimen, const std::optional<Domain>& given, const std::string& path) {
  Domain& body = specimen.domain;
  if (body.shape == "imported" && body.periodic[0] && body.periodic[1] && body.periodic[2]) {
    body.shape = "box";
    body.volume = volume_of(body);
  }
  if (given && body.shape != "imported")
    throw InputError(
        fmt::format("{}: the file tells its body (a {}); expected a scene that gives "
                    "it neither shape nor volume",
                    path, body.shape));
  if (given && given->shape == "imported") {
    body.volume = given->volume;
  } else if (given) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (body.periodic[axis] && !given->periodic[axis])
        throw InputError(
            fmt::format("{}: is periodic along {}: expected [specimen] periodic to "
                        "say so, too",
                        path, "xyz"[axis]));
    body = *given;
  }
  if (given) specimen.report.erase(estimated_volume);
  if (body.shape != "imported" && !(body.volume > 0)) body.volume = volume_of(body);
}

void check_inside(const Specimen& specimen, const std::string& path) {
  for (const Wall& wall : walls_of(specimen.domain))
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      const double distance = wall.distance(specimen.position[i]);
      if (distance > 0) continue;
      const Vector& p = specimen.position[i];
      throw InputError(fmt::format(
          "{}: element {} at ({:.6g}, {:.6g}, {:.6g}) m lies {:.3g} m beyond the wall {} of the {} "
          "that the scene says it is: expected measures and an origin with all centres inside",
          path, i, p.x, p.y, p.z, -distance, wall.name, specimen.domain.shape));
    }
}

void estimate_volume(Specimen& specimen) {
  specimen.domain.volume = cut_cell_volume(specimen);
  specimen.report[estimated_volume] = specimen.domain.volume;
}

std::string read_text(const std::string& path) {
  if (!is_there(path)) throw InputError(path + ": there is no such file");
  if (is_folder(path)) throw InputError(path + ": is a directory");
  // A byte order mark, which some editors put before the text.
  std::string content = read_file(path);
  if (content.compare(0, 3, "\xEF\xBB\xBF") == 0) content.erase(0, 3);
  return content;
}

std::string extension_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

void insist_on_one_body(const Specimen& specimen, const std::string& path) {
  if (specimen.bodies.empty()) return;
  throw InputError(
      fmt::format("{}: text has no place for several bodies ({}); expected a file that "
                  "ends with .h5",
                  path, specimen.bodies.size()));
}

[[noreturn]] void fail_extension(const std::string& path) {
  throw InputError(path +
                   ": the extension says the format of a specimen; expected .h5 (solidem), .data "
                   "(LIGGGHTS), .txt (YADE: x y z r) or .csv (x,y,z,radius)");
}

}  // namespace

Specimen read_specimen(const std::string& path, const std::optional<Domain>& body) {
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
  settle_body(specimen, body, path);
  if (extension != ".h5") check_specimen(specimen, path);
  if (body) check_inside(specimen, path);
  if (specimen.domain.volume == 0) estimate_volume(specimen);
  return specimen;
}

void write_specimen(const std::string& path, const Specimen& specimen) {
  const std::string extension = extension_of(path);
  check_specimen(specimen, "specimen for " + path);
  if (extension != ".h5") insist_on_one_body(specimen, path);
  if (extension == ".h5")
    replace_hdf5_file(
        path, [&](const Hdf5File& file) { write_hdf5(file, specimen); }, Seal::present);
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
