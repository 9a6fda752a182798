// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/checkpoint.hpp"

#include <filesystem>

#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/first_difference.hpp"
#include "output/replace_file.hpp"

namespace solidem {

namespace {

constexpr char format_name[] = "solidem checkpoint";
constexpr int format_version = 1;
constexpr std::uint64_t room_for_structure = 1 << 14;  // HDF5's own: headers, names, attributes

/// Opens a file and insists that it is a checkpoint that this version reads.
Hdf5File open_checkpoint(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw InputError(path + ": there is no checkpoint to resume from");
  Hdf5File file = Hdf5File::open(path);
  if (!file.has_attribute("format") || file.text_attribute("format") != format_name)
    throw InputError(path + ": is no checkpoint of solidem");
  if (const std::int64_t version = file.integer_attribute("version"); version != format_version)
    throw InputError(path + ": is a checkpoint of version " + std::to_string(version) +
                     ", expected version " + std::to_string(format_version));
  return file;
}

}  // namespace

CheckpointContents::CheckpointContents(const Hdf5Group& root, std::string temporary,
                                       std::string path)
    : arrays_(root.make_group("arrays")),
      values_(root.make_group("values")),
      temporary_(std::move(temporary)),
      path_(std::move(path)) {}

void CheckpointContents::secure(std::uint64_t bytes) const {
  reserve_space(temporary_, bytes + room_for_structure, path_, "");
}

void CheckpointContents::write(const std::string& name, double value) const {
  values_.set_attribute(name, value);
}

void CheckpointContents::write(const std::string& name, std::int64_t value) const {
  values_.set_attribute(name, value);
}

void write_checkpoint(const std::string& path, const CheckpointHeader& header,
                      const std::function<void(const CheckpointContents&)>& fill) {
  insist_on_regular_file(path);
  std::error_code error;
  const bool earlier = std::filesystem::exists(path, error);
  try {
    replace_file(path, [&](const std::string& temporary) {
      reserve_space(temporary, room_for_structure, path, "");
      Hdf5File file = Hdf5File::create(temporary);
      file.set_attribute("format", format_name);
      file.set_attribute("version", format_version);
      file.set_attribute("step", header.step);
      file.set_attribute("time", header.time);
      file.set_attribute("fingerprint", header.fingerprint);
      fill(CheckpointContents(file, temporary, path));
      file.close();
    });
  } catch (const RunError& failure) {
    throw RunError("no checkpoint of step " + std::to_string(header.step) + ": " + failure.what() +
                   (earlier ? "; the checkpoint from before is unchanged" : ""));
  }
}

CheckpointReader::CheckpointReader(const std::string& path, const std::string& fingerprint)
    : CheckpointReader(open_checkpoint(path)) {
  if (header_.fingerprint != fingerprint)
    throw InputError(path + ": was made by another scene: then " +
                     first_difference(header_.fingerprint, fingerprint) +
                     " as now; expected the scene it was made from, where title, duration or "
                     "steps, observe_every and [output] may change, or a run without --resume");
}

CheckpointReader::CheckpointReader(const Hdf5File& file)
    : header_{file.integer_attribute("step"), file.number_attribute("time"),
              file.text_attribute("fingerprint")},
      arrays_(file.group("arrays")),
      values_(file.group("values")) {}

bool CheckpointReader::has(const std::string& name) const {
  return arrays_.has(name) || values_.has_attribute(name);
}

}  // namespace solidem
