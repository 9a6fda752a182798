// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <set>
#include <string_view>

#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/read_file.hpp"
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

/// The step that the last row begins with, none if there is no row.
std::optional<std::int64_t> last_step_of(std::string_view rows) {
  if (!rows.empty()) rows.remove_suffix(1);
  const std::string_view row = rows.substr(rows.rfind('\n') + 1);
  std::int64_t step = 0;
  const char* const end = row.data() + row.size();
  const auto [rest, error] = std::from_chars(row.data(), end, step);
  if (error != std::errc{} || rest == end || *rest != ',') return std::nullopt;
  return step;
}

}  // namespace

HistoryWriter::HistoryWriter(std::string path, const std::vector<std::string>& columns)
    : path_(std::move(path)), columns_(columns.size()) {
  const std::string header = header_of(columns);
  replace_text_file(path_, header);
  open();
  digest_.add(header);
}

HistoryWriter HistoryWriter::resume(std::string path, const std::vector<std::string>& columns,
                                    const HistoryMark& mark) {
  HistoryWriter writer;
  writer.path_ = std::move(path);
  writer.columns_ = columns.size();
  const std::string& name = writer.path_;
  if (!is_there(name))
    throw InputError(fmt::format("cannot resume the history {}: no such file", name));

  const std::string content = read_file(name), header = header_of(columns);
  if (content.compare(0, header.size(), header) != 0)
    throw InputError(fmt::format(
        "cannot resume the history {}: its columns are \"{}\", those of this run \"{}\"", name,
        content.substr(0, content.find('\n')), header.substr(0, header.size() - 1)));
  const std::string_view kept =
      std::string_view(content).substr(0, static_cast<std::size_t>(mark.bytes));
  if (kept.size() != static_cast<std::size_t>(mark.bytes) || digest_of(kept) != mark.digest)
    throw InputError(fmt::format(
        "cannot resume the history {}: rows before the checkpoint are missing or are not those "
        "that were written; put the file back as it was, or move it away to go on with a new one",
        name));
  if (kept.size() < content.size()) replace_text_file(name, std::string(kept));
  writer.digest_.add(kept);
  writer.last_step_ = last_step_of(kept.substr(header.size()));
  writer.open();
  return writer;
}

void HistoryWriter::open() {
  file_ = Descriptor(::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  struct stat status {};
  if (!file_.is_open() || ::fstat(file_.get(), &status) != 0) fail_writing();
  size_ = status.st_size;
}

void HistoryWriter::fail_writing() const {
  throw RunError(fmt::format("cannot write {}: {}", path_, std::strerror(errno)));
}

HistoryMark HistoryWriter::mark() const {
  if (!file_.sync()) fail_writing();
  return {size_, digest_.hexadecimal()};
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
  digest_.add(row);
  last_step_ = step;
}

}  // namespace solidem
