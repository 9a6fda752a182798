// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/checkpoint.hpp"

#include <filesystem>

#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/first_difference.hpp"

namespace solidem {

namespace {

constexpr char format_name[] = "solidem checkpoint";
constexpr int format_version = 2;

/// Opens a file and insists that it is a checkpoint that this version reads.
Hdf5File open_checkpoint(const std::string& path) {
  if (!is_there(path)) throw InputError(path + ": there is no checkpoint to resume from");
  Hdf5File file = Hdf5File::open(path, Seal::present);
  if (!file.has_attribute("format") || file.text_attribute("format") != format_name)
    throw InputError(path + ": is no checkpoint of solidem");
  if (const std::int64_t version = file.integer_attribute("version"); version != format_version)
    throw InputError(path + ": is a checkpoint of version " + std::to_string(version) +
                     ", expected version " + std::to_string(format_version));
  return file;
}

}  // namespace

CheckpointContents::CheckpointContents(const Hdf5Group& root)
    : arrays_(root.make_group("arrays")), values_(root.make_group("values")) {}

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
    replace_hdf5_file(
        path,
        [&](const Hdf5File& file) {
          file.set_attribute("format", format_name);
          file.set_attribute("version", format_version);
          file.set_attribute("step", header.step);
          file.set_attribute("time", header.time);
          file.set_attribute("fingerprint", header.fingerprint);
          file.set_attribute("run", header.run);
          file.set_attribute("history_bytes", header.history.bytes);
          file.set_attribute("history_digest", header.history.digest);
          file.set_attribute("frames", header.frames);
          fill(CheckpointContents(file));
        },
        Seal::present);
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
    : header_{file.integer_attribute("step"),
              file.number_attribute("time"),
              file.text_attribute("fingerprint"),
              file.text_attribute("run"),
              {file.integer_attribute("history_bytes"), file.text_attribute("history_digest")},
              file.integer_attribute("frames")},
      arrays_(file.group("arrays")),
      values_(file.group("values")) {}

bool CheckpointReader::has(const std::string& name) const {
  return arrays_.has(name) || values_.has_attribute(name);
}

}  // namespace solidem
