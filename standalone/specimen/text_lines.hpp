// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SPECIMEN_TEXT_LINES_HPP
#define SOLIDEM_SPECIMEN_TEXT_LINES_HPP

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace solidem {

/// With how many digits numbers were written, and so how far off they may be.
class DecimalPrecision {
 public:
  /// A number as it was written, and its value.
  void note(std::string_view text, double value);

  /// By how much a number of this size may be off. Where all numbers noted could have come from
  /// single precision, they are taken to: few digits do not say that a number is exact.
  double round_off(double size) const;

 private:
  int digits_ = 0;         // significant ones of the longest number
  bool is_single_ = true;  // each is the shortest text of a number of single precision
};

/// Walks through a text line by line; every complaint carries file and line. Blanks and commas
/// stand between words, and # begins a comment.
class TextLines {
 public:
  TextLines(std::string_view text, const std::string& path) : rest_(text), path_(path) {}

  /// The next line that has words; false at the end.
  bool next();
  /// The next line that is a comment (and nothing else); `words` are those after the #.
  bool next_comment();

  const std::vector<std::string_view>& words() const { return words_; }
  /// Of the comment after the words of this line.
  const std::vector<std::string_view>& comment() const { return comment_; }

  /// Whether the line begins with a letter, as the name of a section does.
  bool begins_with_letter() const;

  double number(std::size_t word) const;
  std::int64_t integer(std::size_t word) const;
  /// A number above zero, times a factor.
  double radius(std::size_t word, double factor = 1.0) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool next_line(std::string_view& line);

  std::string_view rest_;
  const std::string& path_;
  std::vector<std::string_view> words_, comment_;
  int number_ = 0;
};

}  // namespace solidem

#endif
