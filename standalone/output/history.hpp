// SPDX-License-Identifier: GPL-2.0-or-later
//
// Histories: one row of figures for each observed step, as CSV.
#ifndef SOLIDEM_OUTPUT_HISTORY_HPP
#define SOLIDEM_OUTPUT_HISTORY_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "output/descriptor.hpp"
#include "output/digest.hpp"

namespace solidem {

/// How far a history was when a checkpoint was taken.
struct HistoryMark {
  std::int64_t bytes = 0;
  std::string digest;  ///< of these bytes
};

/// Writes a history. The first line names the columns: step, time, then those given. Numbers have
/// 17 digits, so that reading gives the same doubles. Every row is in the file when write_row
/// returns, and a row that does not fit on the disk leaves no half of itself behind.
class HistoryWriter {
 public:
  /// Starts a new file in the place of any earlier one. InputError for a name that is empty, twice
  /// there, or holds a comma, a quotation mark or a line break; RunError if the file cannot be
  /// written.
  HistoryWriter(std::string path, const std::vector<std::string>& columns);

  /// Goes on with the file of an earlier run after the rows that a checkpoint knows: what follows
  /// them is dropped. InputError if there is no such file, its columns differ, or these rows are
  /// not there as they were written.
  static HistoryWriter resume(std::string path, const std::vector<std::string>& columns,
                              const HistoryMark& mark);

  /// Adds a row: the step, the time in s and one value for each column given. RunError names the
  /// file, the reason and the last step that is safe.
  void write_row(std::int64_t step, double time, const std::vector<double>& values);

  /// The step of the last row, none before the first.
  std::optional<std::int64_t> last_step() const { return last_step_; }

  /// Waits until every row is on the disk and says how far the history is. RunError.
  HistoryMark mark() const;

 private:
  HistoryWriter() = default;
  void open();
  [[noreturn]] void fail_writing() const;

  std::string path_;
  std::size_t columns_ = 0;
  Descriptor file_;
  std::int64_t size_ = 0;  // bytes of whole rows
  Digest digest_;          // of these
  std::optional<std::int64_t> last_step_;
};

}  // namespace solidem

#endif
