// SPDX-License-Identifier: GPL-2.0-or-later
//
// Checkpoints: everything a run needs to go on, in one HDF5 file. This container knows names and
// numbers only; what they mean is the engine's affair.
//
//   /        attributes format, version, step, time, fingerprint, run, frames, history_bytes,
//            history_digest
//   /arrays  one dataset for each named array
//   /values  attributes: single numbers
//
// The file ends with a seal (output/seal.hpp): one that is damaged is refused.
#ifndef SOLIDEM_OUTPUT_CHECKPOINT_HPP
#define SOLIDEM_OUTPUT_CHECKPOINT_HPP

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "output/hdf5.hpp"
#include "output/history.hpp"

namespace solidem {

/// When a checkpoint was taken, and of what.
struct CheckpointHeader {
  std::int64_t step = 0;
  double time = 0;          ///< s
  std::string fingerprint;  ///< same scene and specimen, same fingerprint
  std::string run;          ///< identity of the run
  HistoryMark history{};    ///< as far as it was then; it is on the disk
  std::int64_t frames = 0;  ///< of the trajectory then; they are on the disk
};

/// A checkpoint that is being written.
class CheckpointContents {
 public:
  /// Adds an array; T is double, std::int64_t, std::int32_t or std::uint8_t.
  template <class T>
  void write(const std::string& name, const std::vector<T>& values) const {
    arrays_.write(name, values);
  }
  /// Adds a single number.
  void write(const std::string& name, double value) const;
  void write(const std::string& name, std::int64_t value) const;

 private:
  friend void write_checkpoint(const std::string&, const CheckpointHeader&,
                               const std::function<void(const CheckpointContents&)>&);
  explicit CheckpointContents(const Hdf5Group& root);

  Hdf5Group arrays_, values_;
};

/// Writes a checkpoint: `fill` writes the contents. The file takes its name when it is whole and on
/// the disk; until then, and if anything fails (RunError), an earlier checkpoint stays as it was.
void write_checkpoint(const std::string& path, const CheckpointHeader& header,
                      const std::function<void(const CheckpointContents&)>& fill);

/// A checkpoint to go on from.
class CheckpointReader {
 public:
  /// Opens a checkpoint. InputError if it is not there, damaged anywhere, none of ours, of another
  /// version, or its fingerprint is not this one.
  CheckpointReader(const std::string& path, const std::string& fingerprint);

  const CheckpointHeader& header() const { return header_; }

  /// Is there an array, or a number, of this name?
  bool has(const std::string& name) const;

  /// Reads an array of `count` values. InputError if it is not there or of another size.
  template <class T>
  std::vector<T> read(const std::string& name, std::size_t count = Hdf5Group::any_rows) const {
    return arrays_.read<T>(name, count);
  }
  /// Reads a single number. InputError if it is not there.
  double read_number(const std::string& name) const { return values_.number_attribute(name); }
  std::int64_t read_integer(const std::string& name) const {
    return values_.integer_attribute(name);
  }

 private:
  explicit CheckpointReader(const Hdf5File& file);

  CheckpointHeader header_;
  Hdf5Group arrays_, values_;
};

}  // namespace solidem

#endif
