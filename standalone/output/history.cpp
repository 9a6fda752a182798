// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "model/error.hpp"
#include "output/replace_file.hpp"

namespace solidem {

namespace {

std::string header_of(const std::vector<std::string>& columns) {
  std::string header = "step,time";
  std::set<std::string> seen{"step", "time"};
  for (const std::string& column : columns) {
    if (column.empty() || column.find_first_of(",\"\n\r") != std::string::npos)
      throw InputError(fmt::format(
          "history column \"{}\": a name must not be empty nor hold a comma, a quotation mark or a "
          "line break",
          column));
    if (!seen.insert(column).second)
      throw InputError(fmt::format("history column \"{}\" is there twice", column));
    header += ',' + column;
  }
  return header + '\n';
}

/// The step that a row begins with, none if it does not.
std::optional<std::int64_t> step_of(const std::string& row) {
  std::int64_t step = 0;
  const char* const end = row.data() + row.size();
  const auto [rest, error] = std::from_chars(row.data(), end, step);
  if (error != std::errc{} || rest == end || *rest != ',') return std::nullopt;
  return step;
}

}  // namespace

HistoryWriter::HistoryWriter(std::string path, const std::vector<std::string>& columns)
    : path_(std::move(path)), columns_(columns.size()) {
  replace_text_file(path_, header_of(columns));
  open();
}

HistoryWriter HistoryWriter::resume(std::string path, const std::vector<std::string>& columns,
                                    std::int64_t step) {
  HistoryWriter writer;
  writer.path_ = std::move(path);
  writer.columns_ = columns.size();
  const std::string& name = writer.path_;
  std::ifstream file(writer.path_, std::ios::binary);
  if (!file) throw InputError(fmt::format("cannot resume the history {}: no such file", name));

  std::string kept = header_of(columns), line;
  std::getline(file, line);
  if (file.eof() || line + '\n' != kept)
    throw InputError(fmt::format(
        "cannot resume the history {}: its columns are \"{}\", those of this run \"{}\"", name,
        line, kept.substr(0, kept.size() - 1)));
  for (int number = 2; std::getline(file, line) && !file.eof(); ++number) {
    const std::optional<std::int64_t> row_step = step_of(line);
    if (!row_step)
      throw InputError(
          fmt::format("cannot resume the history {}: line {} does not begin with a step: \"{}\"",
                      name, number, line));
    if (*row_step > step) break;
    kept += line + '\n';
    writer.last_step_ = row_step;
  }
  std::error_code error;
  if (std::filesystem::file_size(writer.path_, error) != kept.size())
    replace_text_file(writer.path_, kept);
  writer.open();
  return writer;
}

void HistoryWriter::open() {
  file_ = Descriptor(::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  struct stat status {};
  if (!file_.is_open() || ::fstat(file_.get(), &status) != 0)
    throw RunError(fmt::format("cannot write {}: {}", path_, std::strerror(errno)));
  size_ = status.st_size;
}

void HistoryWriter::write_row(std::int64_t step, double time, const std::vector<double>& values) {
  if (values.size() != columns_)
    throw std::logic_error(fmt::format("history {}: a row of {} values for {} columns", path_,
                                       values.size(), columns_));
  std::string row = fmt::format("{},{:.17g}", step, time);
  for (const double value : values) fmt::format_to(std::back_inserter(row), ",{:.17g}", value);
  row += '\n';
  if (!file_.write_all(row)) {
    const std::string reason = std::strerror(errno);
    const bool whole = ::ftruncate(file_.get(), size_) == 0;
    throw RunError(fmt::format("cannot write {}, step {}: {}; {}{}", path_, step, reason,
                               last_step_
                                   ? fmt::format("the rows up to step {} are safe", *last_step_)
                                   : "it has no row yet",
                               whole ? "" : ", the last line is cut short"));
  }
  size_ += static_cast<std::int64_t>(row.size());
  last_step_ = step;
}

}  // namespace solidem
