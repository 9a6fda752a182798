// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <tuple>

#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/replace_file.hpp"
#include "output/seal.hpp"

namespace solidem {

namespace fs = std::filesystem;

namespace {

constexpr char format_name[] = "solidem trajectory";
constexpr int format_version = 2;
constexpr char rest_name[] = "rest";

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

std::string xml_text(const std::string& text) {
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

constexpr char real[] = "NumberType=\"Float\" Precision=\"8\"";
constexpr char integer_type[] = "NumberType=\"Int\" Precision=\"4\"";

/// Where an XDMF index finds an array of a file in the trajectory's folder.
std::string data_item(const std::string& folder, const std::string& source,
                      const std::string& where, const std::vector<std::size_t>& shape,
                      const char* type) {
  return fmt::format("<DataItem Format=\"HDF\" Dimensions=\"{}\" {}>{}/{}.h5:/{}</DataItem>",
                     numbers(shape), type, xml_text(fs::path(folder).filename().string()), source,
                     xml_text(where));
}

std::size_t lines_to_draw(const Specimen& specimen) {
  const auto& periodic = specimen.domain.periodic;
  const bool across = std::any_of(periodic.begin(), periodic.end(), [](bool yes) { return yes; });
  return across ? 0 : specimen.bonds.size();  // a bond to an image would be drawn across the body
}

void write_rest(const Hdf5File& file, const Specimen& specimen) {
  file.write("elements/position", coordinates(specimen.position), {specimen.size(), 3});
  file.write("elements/radius", specimen.radius);
  if (!specimen.bodies.empty()) file.write("elements/body", body_of_elements(specimen));
  if (!specimen.bonds.empty())
    file.write("bonds/pairs", &specimen.bonds.front().i, {specimen.bonds.size(), 2});
  if (lines_to_draw(specimen) == 0) {
    // ParaView's newer readers want the points named one by one.
    std::vector<std::int32_t> index(specimen.size());
    std::iota(index.begin(), index.end(), 0);
    file.write("elements/index", index);
  }
}

/// "trajectory" for "trajectory.h5".
std::string folder_beside(const std::string& path) {
  return fs::path(path).replace_extension("").string();
}

/// Names of the frames in a folder, without extension, in the order of their numbers.
std::vector<std::string> frames_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path file = entry->path().filename();
    const std::string name = file.stem().string();
    const bool is_number = name.find_first_not_of("0123456789") == std::string::npos;
    if (file.extension() == ".h5" && is_number && name.size() >= 6 && name.size() < 19)
      names.push_back(name);
  }
  if (error && error != std::errc::no_such_file_or_directory)
    throw RunError(fmt::format("cannot look into the folder {}: {}", folder, error.message()));
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return names;
}

void remove_file(const std::string& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw RunError(fmt::format("cannot remove {}: {}", path, error.message()));
}

}  // namespace

TrajectoryWriter::TrajectoryWriter(Continuation, const std::string& path, const Specimen& specimen,
                                   std::string run)
    : path_(path),
      folder_(folder_beside(path)),
      run_(std::move(run)),
      elements_(specimen.size()),
      bonds_(specimen.bonds.size()),
      lines_(lines_to_draw(specimen)),
      has_bodies_(!specimen.bodies.empty()) {}

TrajectoryWriter::TrajectoryWriter(const std::string& path, const Specimen& specimen,
                                   std::string run)
    : TrajectoryWriter(Continuation{}, path, specimen, std::move(run)) {
  insist_on_regular_file(path_);
  prepare_directory(folder_);
  start(specimen);
  // The index never names a file that is not there.
  write_index();
  for (const std::string& name : frames_in(folder_)) remove_file(file_of(name));
}

void TrajectoryWriter::start(const Specimen& specimen) const {
  replace_hdf5_file(
      file_of(rest_name), [&](const Hdf5File& file) { write_rest(file, specimen); }, Seal::present);
}

TrajectoryWriter TrajectoryWriter::resume(const std::string& path, const Specimen& specimen,
                                          std::int64_t step, std::string run) {
  TrajectoryWriter writer(Continuation{}, path, specimen, std::move(run));
  insist_on_regular_file(path);
  prepare_directory(writer.folder_);
  writer.insist_on_same(specimen);
  std::vector<std::string> later;
  for (const std::string& name : frames_in(writer.folder_))
    if (writer.take_frame(name) && writer.frames_.back().step > step) {
      writer.frames_.pop_back();
      later.push_back(name);
    }
  if (!writer.frames_.empty()) writer.next_ = std::stoul(writer.frames_.back().name) + 1;
  writer.write_index();
  for (const std::string& name : later) remove_file(writer.file_of(name));
  return writer;
}

bool TrajectoryWriter::take_frame(const std::string& name) {
  const SealState seal = check_seal(file_of(name));
  if (seal != SealState::holds) {
    set_aside(name, file_of(name) + (seal == SealState::broken ? " is damaged" : " is cut short"));
    return false;
  }
  const Hdf5File file = Hdf5File::open(file_of(name));
  if (file.text_attribute("run") != run_) {
    set_aside(name, file_of(name) + " is a frame of another run");
    return false;
  }
  frames_.push_back(read_frame(file, name));
  return true;
}

void TrajectoryWriter::set_aside(const std::string& name, const std::string& reason) {
  const std::string aside = file_of(name) + ".aside";
  std::error_code error;
  fs::rename(file_of(name), aside, error);
  if (error) throw RunError(fmt::format("{}; it cannot be renamed: {}", reason, error.message()));
  notes_.push_back(fmt::format("{}; it now stands aside as {}", reason, aside));
}

TrajectoryWriter::Frame TrajectoryWriter::read_frame(const Hdf5Group& group,
                                                     const std::string& name) const {
  Frame frame{name, group.integer_attribute("step"), group.number_attribute("time"), {}, {}};
  const auto read = [&](const Hdf5Group& from, const std::string& field, bool of_bonds) {
    const std::vector<std::size_t> shape = from.shape(field);
    FrameField found{field, shape.size() == 2 ? shape[1] : 1, of_bonds};
    if (shape.empty() || shape.size() > 2 || shape.front() != rows(found))
      throw InputError(fmt::format("{}/{}: has shape ({}), expected {} rows", from.where(), field,
                                   numbers(shape), rows(found)));
    frame.fields.push_back(std::move(found));
  };
  for (const std::string& field : group.names()) {
    if (field == "tools") {
      const Hdf5Group tools = group.group(field);
      for (const std::string& tool : tools.names())
        frame.surfaces.push_back(
            {tool, tools.shape(tool + "/vertices").at(0), tools.shape(tool + "/facets").at(0)});
      continue;
    }
    if (field != "bonds") {
      read(group, field, false);
      continue;
    }
    const Hdf5Group of_bonds = group.group(field);
    for (const std::string& bond_field : of_bonds.names()) read(of_bonds, bond_field, true);
  }
  frame.sort();
  return frame;
}

void TrajectoryWriter::insist_on_same(const Specimen& specimen) {
  const std::string path = file_of(rest_name);
  std::vector<double> found;
  try {
    found = Hdf5File::open(path, Seal::present)
                .read<double>("elements/position", Hdf5Group::any_rows, 3);
  } catch (const InputError& error) {
    // It says nothing that the specimen does not.
    notes_.push_back(fmt::format("{}; it was written anew", error.what()));
    return start(specimen);
  }
  const double* const wanted = coordinates(specimen.position);
  if (found.size() != 3 * specimen.size() || !std::equal(found.begin(), found.end(), wanted))
    throw InputError(fmt::format(
        "{}: cannot go on with this trajectory, it is of another specimen ({} elements, this run "
        "has {}{})",
        path, found.size() / 3, specimen.size(),
        found.size() == 3 * specimen.size() ? " at other places" : ""));
}

void TrajectoryWriter::Frame::sort() {
  std::sort(fields.begin(), fields.end(), [](const FrameField& a, const FrameField& b) {
    return std::tie(a.of_bonds, a.name) < std::tie(b.of_bonds, b.name);
  });
  std::sort(surfaces.begin(), surfaces.end(),
            [](const FrameSurface& a, const FrameSurface& b) { return a.name < b.name; });
}

std::string TrajectoryWriter::what_is_safe() const {
  if (frames_.empty()) return "no frame was written yet";
  return fmt::format("the {} up to step {} {} safe",
                     frames_.size() == 1 ? "frame" : fmt::format("{} frames", frames_.size()),
                     frames_.back().step, frames_.size() == 1 ? "is" : "are");
}

void TrajectoryWriter::write_frame(std::int64_t step, double time, const std::vector<Field>& fields,
                                   const std::vector<DrawnSurface>& surfaces) {
  Frame frame{fmt::format("{:06}", next_), step, time, {}, {}};
  for (const DrawnSurface& surface : surfaces)
    frame.surfaces.push_back({surface.name, surface.vertices.size(), surface.facets.size()});
  for (const Field& field : fields)
    frame.fields.push_back(
        {field.name, static_cast<std::size_t>(field.components), field.of_bonds});
  try {
    replace_hdf5_file(
        file_of(frame.name),
        [&](const Hdf5File& file) {
          file.set_attribute("run", run_);
          file.set_attribute("step", step);
          file.set_attribute("time", time);
          for (std::size_t k = 0; k < fields.size(); ++k)
            file.write((fields[k].of_bonds ? "bonds/" : "") + fields[k].name, fields[k].values,
                       shape_of(rows(frame.fields[k]), frame.fields[k].components));
          for (const DrawnSurface& surface : surfaces) {
            const std::string group = "tools/" + surface.name;
            file.write(group + "/vertices", coordinates(surface.vertices),
                       {surface.vertices.size(), 3});
            file.write(group + "/facets", surface.facets.front().data(),
                       {surface.facets.size(), 3});
          }
        },
        Seal::present);
  } catch (const RunError& error) {
    throw RunError(fmt::format("{}; {}", error.what(), what_is_safe()));
  }
  frame.sort();
  frames_.push_back(std::move(frame));
  ++next_;
  write_index();
}

std::string TrajectoryWriter::xdmf_of(const Frame& frame) const {
  const auto item_of = [&](const std::string& source, const std::string& where,
                           const std::vector<std::size_t>& shape, const char* type) {
    return data_item(folder_, source, where, shape, type);
  };
  const auto at_rest = [&](const std::string& where, const std::vector<std::size_t>& shape,
                           const char* type) { return item_of(rest_name, where, shape, type); };

  const std::string grid =
      frame.surfaces.empty() ? fmt::format("step {}", frame.step) : std::string("body");
  std::string text = fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n", grid);
  text += fmt::format("        <Time Value=\"{:.17g}\"/>\n", frame.time);
  if (lines_ > 0)
    text += fmt::format(
        "        <Topology TopologyType=\"Polyline\" NodesPerElement=\"2\" "
        "NumberOfElements=\"{}\">{}</Topology>\n",
        lines_, at_rest("bonds/pairs", {lines_, 2}, integer_type));
  else
    text += fmt::format(
        "        <Topology TopologyType=\"Polyvertex\" NodesPerElement=\"1\" "
        "NumberOfElements=\"{}\">{}</Topology>\n",
        elements_, at_rest("elements/index", {elements_}, integer_type));

  std::string place = at_rest("elements/position", {elements_, 3}, real);
  std::string attributes = fmt::format(
      "        <Attribute Name=\"radius\" AttributeType=\"Scalar\" "
      "Center=\"Node\">{}</Attribute>\n",
      at_rest("elements/radius", {elements_}, real));
  if (has_bodies_)
    attributes += fmt::format(
        "        <Attribute Name=\"body\" AttributeType=\"Scalar\" "
        "Center=\"Node\">{}</Attribute>\n",
        at_rest("elements/body", {elements_}, integer_type));
  for (const FrameField& field : frame.fields) {
    if (field.name == "position") {
      place = item_of(frame.name, field.name, {elements_, 3}, real);
      continue;
    }
    if (field.of_bonds && lines_ == 0) continue;  // there is nothing to draw them on
    const char* const type = field.components == 1   ? "Scalar"
                             : field.components == 3 ? "Vector"
                             : field.components == 9 ? "Tensor"
                                                     : "Matrix";
    attributes += fmt::format(
        "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
        xml_text((field.of_bonds ? "bond " : "") + field.name), type,
        field.of_bonds ? "Cell" : "Node",
        item_of(frame.name, (field.of_bonds ? "bonds/" : "") + field.name,
                shape_of(rows(field), field.components), real));
  }
  text += fmt::format("        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n", place);
  text += attributes + "      </Grid>\n";
  if (frame.surfaces.empty()) return text;
  // The body and the tools of one moment side by side.
  std::string together = fmt::format(
      "      <Grid Name=\"step {}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
      "        <Time Value=\"{:.17g}\"/>\n",
      frame.step, frame.time);
  together += text;
  for (const FrameSurface& surface : frame.surfaces) together += xdmf_of(frame, surface);
  return together + "      </Grid>\n";
}

std::string TrajectoryWriter::xdmf_of(const Frame& frame, const FrameSurface& surface) const {
  const std::string group = "tools/" + surface.name;
  return fmt::format(
      "      <Grid Name=\"{}\" GridType=\"Uniform\">\n"
      "        <Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n      </Grid>\n",
      xml_text(surface.name), surface.facets,
      data_item(folder_, frame.name, group + "/facets", {surface.facets, 3}, integer_type),
      data_item(folder_, frame.name, group + "/vertices", {surface.vertices, 3}, real));
}

void TrajectoryWriter::write_index() const {
  const std::string folder = fs::path(folder_).filename().string() + '/';
  const std::string rest = folder + rest_name + ".h5";
  replace_hdf5_file(
      path_,
      [&](const Hdf5File& file) {
        file.set_attribute("format", format_name);
        file.set_attribute("version", format_version);
        file.set_attribute("run", run_);
        file.link("elements", rest, "/elements");
        if (bonds_ > 0) file.link("bonds", rest, "/bonds");
        file.make_group("frames");
        for (const Frame& frame : frames_)
          file.link("frames/" + frame.name, folder + frame.name + ".h5", "/");
      },
      Seal::present);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"solidem\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const Frame& frame : frames_) text += xdmf_of(frame);
  text += "    </Grid>\n  </Domain>\n</Xdmf>\n";
  replace_text_file(fs::path(path_).replace_extension(".xdmf").string(), text);
}

}  // namespace solidem
