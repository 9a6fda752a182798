// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>

#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/replace_file.hpp"

namespace solidem {

namespace {

constexpr char format_name[] = "solidem trajectory";
constexpr int format_version = 1;
constexpr std::uint64_t room_for_structure = 1 << 16;  // HDF5's own: headers, names, attributes

const double* coordinates(const std::vector<Vector>& vectors) {
  static_assert(sizeof(Vector) == 3 * sizeof(double), "vectors are written as rows of three");
  return vectors.empty() ? nullptr : &vectors.front().x;
}

std::vector<std::size_t> shape_of(std::size_t elements, std::size_t components) {
  return components == 1 ? std::vector<std::size_t>{elements}
                         : std::vector<std::size_t>{elements, components};
}

std::string numbers(const std::vector<std::size_t>& shape) {
  return fmt::format("{}", fmt::join(shape, " "));
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    if (letter == '&')
      safe += "&amp;";
    else if (letter == '<')
      safe += "&lt;";
    else if (letter == '>')
      safe += "&gt;";
    else if (letter == '"')
      safe += "&quot;";
    else
      safe += letter;
  }
  return safe;
}

std::size_t lines_to_draw(const Specimen& specimen) {
  const auto& periodic = specimen.domain.periodic;
  const bool across = std::any_of(periodic.begin(), periodic.end(), [](bool yes) { return yes; });
  return across ? 0 : specimen.bonds.size();  // a bond to an image would be drawn across the body
}

std::uint64_t bytes_at_rest(const Specimen& specimen) {
  return specimen.size() * 5 * sizeof(double) + specimen.bonds.size() * sizeof(Pair) +
         room_for_structure;
}

void write_rest(const std::string& path, const Specimen& specimen) {
  const Hdf5File file = Hdf5File::create(path);
  file.set_attribute("format", format_name);
  file.set_attribute("version", format_version);
  file.write("elements/position", coordinates(specimen.position), {specimen.size(), 3});
  file.write("elements/radius", specimen.radius);
  if (!specimen.bonds.empty())
    file.write("bonds/pairs", &specimen.bonds.front().i, {specimen.bonds.size(), 2});
  if (lines_to_draw(specimen) == 0) {
    // ParaView's newer readers want the points named one by one.
    std::vector<std::int32_t> index(specimen.size());
    std::iota(index.begin(), index.end(), 0);
    file.write("elements/index", index);
  }
  file.make_group("frames");
  file.flush();
}

/// Makes the file of a new run and opens it for the frames.
Hdf5File start(const std::string& path, const Specimen& specimen) {
  insist_on_regular_file(path);
  replace_file(path, [&](const std::string& temporary) {
    reserve_space(temporary, bytes_at_rest(specimen), path, "no frame was written yet");
    write_rest(temporary, specimen);
  });
  return Hdf5File::open_for_writing(path);
}

/// Tells what is wrong with a file that is no trajectory.
void insist_on_trajectory(const std::string& path) {
  const Hdf5File file = Hdf5File::open(path);
  if (!file.has_attribute("format") || file.text_attribute("format") != format_name)
    throw InputError(path + ": is no trajectory of solidem");
  if (const std::int64_t version = file.integer_attribute("version"); version != format_version)
    throw InputError(fmt::format("{}: is a trajectory of version {}, expected version {}", path,
                                 version, format_version));
}

Hdf5File reopen(const std::string& path) {
  insist_on_trajectory(path);
  return Hdf5File::open_for_writing(path);
}

}  // namespace

TrajectoryWriter::TrajectoryWriter(const std::string& path, const Specimen& specimen)
    : path_(path),
      elements_(specimen.size()),
      bonds_(specimen.bonds.size()),
      lines_(lines_to_draw(specimen)),
      file_(start(path, specimen)) {
  write_index();
}

TrajectoryWriter::TrajectoryWriter(Continuation, const std::string& path, const Specimen& specimen)
    : path_(path),
      elements_(specimen.size()),
      bonds_(specimen.bonds.size()),
      lines_(lines_to_draw(specimen)),
      file_(reopen(path)) {}

TrajectoryWriter TrajectoryWriter::resume(const std::string& path, const Specimen& specimen,
                                          std::int64_t step) {
  TrajectoryWriter writer(Continuation{}, path, specimen);
  writer.insist_on_same(specimen);
  const Hdf5Group group = writer.file_.group("frames");
  for (const std::string& name : group.names()) {
    Frame frame = writer.read_frame(group.group(name), name);
    if (frame.step <= step)
      writer.frames_.push_back(std::move(frame));
    else
      group.remove(name);
  }
  writer.file_.flush();
  writer.write_index();
  return writer;
}

TrajectoryWriter::Frame TrajectoryWriter::read_frame(const Hdf5Group& group,
                                                     const std::string& name) const {
  Frame frame{name, group.integer_attribute("step"), group.number_attribute("time"), {}};
  const auto read = [&](const Hdf5Group& from, const std::string& field, bool of_bonds) {
    const std::vector<std::size_t> shape = from.shape(field);
    FrameField found{field, shape.size() == 2 ? shape[1] : 1, of_bonds};
    if (shape.empty() || shape.size() > 2 || shape.front() != rows(found))
      throw InputError(fmt::format("{}/{}: has shape ({}), expected {} rows", from.where(), field,
                                   numbers(shape), rows(found)));
    frame.fields.push_back(std::move(found));
  };
  for (const std::string& field : group.names()) {
    if (field != "bonds") {
      read(group, field, false);
      continue;
    }
    const Hdf5Group of_bonds = group.group(field);
    for (const std::string& bond_field : of_bonds.names()) read(of_bonds, bond_field, true);
  }
  return frame;
}

void TrajectoryWriter::insist_on_same(const Specimen& specimen) const {
  const auto found = file_.read<double>("elements/position", Hdf5Group::any_rows, 3);
  const double* const wanted = coordinates(specimen.position);
  if (found.size() != 3 * specimen.size() || !std::equal(found.begin(), found.end(), wanted))
    throw InputError(fmt::format(
        "{}: cannot go on with this trajectory, it is of another specimen ({} elements, this run "
        "has {}{})",
        path_, found.size() / 3, specimen.size(),
        found.size() == 3 * specimen.size() ? " at other places" : ""));
}

std::string TrajectoryWriter::what_is_safe() const {
  if (frames_.empty()) return "no frame was written yet";
  return fmt::format("the {} up to step {} {} safe",
                     frames_.size() == 1 ? "frame" : fmt::format("{} frames", frames_.size()),
                     frames_.back().step, frames_.size() == 1 ? "is" : "are");
}

void TrajectoryWriter::write_frame(std::int64_t step, double time,
                                   const std::vector<Field>& fields) {
  const std::size_t number = frames_.empty() ? 0 : std::stoul(frames_.back().name) + 1;
  Frame frame{fmt::format("{:06}", number), step, time, {}};
  std::uint64_t bytes = room_for_structure;
  for (const Field& field : fields) {
    frame.fields.push_back(
        {field.name, static_cast<std::size_t>(field.components), field.of_bonds});
    bytes += rows(frame.fields.back()) * frame.fields.back().components * sizeof(double);
  }
  reserve_space(path_, bytes, path_, what_is_safe());
  try {
    const Hdf5Group group = file_.make_group("frames/" + frame.name);
    group.set_attribute("step", step);
    group.set_attribute("time", time);
    std::optional<Hdf5Group> of_bonds;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (fields[k].of_bonds && !of_bonds) of_bonds.emplace(group.make_group("bonds"));
      (fields[k].of_bonds ? *of_bonds : group)
          .write(fields[k].name, fields[k].values,
                 shape_of(rows(frame.fields[k]), frame.fields[k].components));
    }
    file_.flush();
  } catch (const RunError& error) {
    throw RunError(fmt::format("{}; {}", error.what(), what_is_safe()));
  }
  frames_.push_back(std::move(frame));
  write_index();
}

std::string TrajectoryWriter::xdmf_of(const Frame& frame) const {
  const std::string source = escaped(std::filesystem::path(path_).filename().string());
  const auto item = [&](const std::string& where, const std::vector<std::size_t>& shape,
                        const char* type) {
    return fmt::format("<DataItem Format=\"HDF\" Dimensions=\"{}\" {}>{}:/{}</DataItem>",
                       numbers(shape), type, source, escaped(where));
  };
  constexpr char real[] = "NumberType=\"Float\" Precision=\"8\"";
  constexpr char integer[] = "NumberType=\"Int\" Precision=\"4\"";
  const std::string folder = "frames/" + frame.name + '/';

  std::string text =
      fmt::format("      <Grid Name=\"step {}\" GridType=\"Uniform\">\n", frame.step);
  text += fmt::format("        <Time Value=\"{:.17g}\"/>\n", frame.time);
  if (lines_ > 0)
    text += fmt::format(
        "        <Topology TopologyType=\"Polyline\" NodesPerElement=\"2\" "
        "NumberOfElements=\"{}\">{}</Topology>\n",
        lines_, item("bonds/pairs", {lines_, 2}, integer));
  else
    text += fmt::format(
        "        <Topology TopologyType=\"Polyvertex\" NodesPerElement=\"1\" "
        "NumberOfElements=\"{}\">{}</Topology>\n",
        elements_, item("elements/index", {elements_}, integer));

  std::string place = "elements/position";
  std::string attributes = fmt::format(
      "        <Attribute Name=\"radius\" AttributeType=\"Scalar\" "
      "Center=\"Node\">{}</Attribute>\n",
      item("elements/radius", {elements_}, real));
  for (const FrameField& field : frame.fields) {
    if (field.name == "position") {
      place = folder + field.name;
      continue;
    }
    if (field.of_bonds && lines_ == 0) continue;  // there is nothing to draw them on
    const char* const type = field.components == 1   ? "Scalar"
                             : field.components == 3 ? "Vector"
                             : field.components == 9 ? "Tensor"
                                                     : "Matrix";
    attributes += fmt::format(
        "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
        escaped((field.of_bonds ? "bond " : "") + field.name), type,
        field.of_bonds ? "Cell" : "Node",
        item(folder + (field.of_bonds ? "bonds/" : "") + field.name,
             shape_of(rows(field), field.components), real));
  }
  text += fmt::format("        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                      item(place, {elements_, 3}, real));
  return text + attributes + "      </Grid>\n";
}

void TrajectoryWriter::write_index() const {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"solidem\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const Frame& frame : frames_) text += xdmf_of(frame);
  text += "    </Grid>\n  </Domain>\n</Xdmf>\n";
  replace_text_file(std::filesystem::path(path_).replace_extension(".xdmf").string(), text);
}

}  // namespace solidem
