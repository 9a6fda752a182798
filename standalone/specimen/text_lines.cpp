// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "model/error.hpp"

namespace solidem {

namespace {

// Programs write six digits or more; shorter numbers say nothing of how exact they are.
constexpr int fewest_digits = 6;
constexpr double single_round_off = 1.0 / (1 << 24), double_round_off = 0x1p-53;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Significant digits of a number, and the value of one unit of the last.
struct Written {
  int digits = 0;
  double unit = 1;
};

Written written(std::string_view text) {
  const std::size_t exponent_at = std::min(text.find_first_of("eE"), text.size());
  const std::string_view mantissa = text.substr(0, exponent_at);
  const std::size_t point = mantissa.find('.');
  const std::size_t first = mantissa.find_first_of("123456789");
  Written result;
  if (first != std::string_view::npos)
    result.digits =
        static_cast<int>(std::count_if(mantissa.begin() + first, mantissa.end(), is_digit));
  int exponent = 0;
  if (exponent_at < text.size()) {
    std::string_view sign = text.substr(exponent_at + 1);
    if (!sign.empty() && sign.front() == '+') sign.remove_prefix(1);
    std::from_chars(sign.data(), sign.data() + sign.size(), exponent);
  }
  if (point != std::string_view::npos) exponent -= static_cast<int>(mantissa.size() - point - 1);
  result.unit = std::pow(10.0, exponent);
  return result;
}

std::vector<std::string_view> split(std::string_view line) {
  static constexpr std::string_view separators = " \t\r,";
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return words;
}

}  // namespace

void DecimalPrecision::note(std::string_view text, double value) {
  const Written as = written(text);
  digits_ = std::max(digits_, as.digits);
  if (is_single_)
    is_single_ = std::abs(static_cast<double>(static_cast<float>(value)) - value) <= 0.5 * as.unit;
}

double DecimalPrecision::round_off(double size) const {
  if (!(size > 0)) return 0;
  const double binary = size * (is_single_ ? single_round_off : double_round_off);
  if (digits_ < fewest_digits) return binary;
  return std::max(binary, 0.5 * std::pow(10.0, std::floor(std::log10(size)) + 1 - digits_));
}

bool TextLines::next_line(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
  ++number_;
  return true;
}

bool TextLines::next() {
  for (std::string_view line; next_line(line);) {
    const std::size_t hash = std::min(line.find('#'), line.size());
    words_ = split(line.substr(0, hash));
    comment_ = split(line.substr(std::min(hash + 1, line.size())));
    if (!words_.empty()) return true;
  }
  return false;
}

bool TextLines::next_comment() {
  for (std::string_view line; next_line(line);) {
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string_view::npos || line[hash] != '#') continue;
    words_ = split(line.substr(hash + 1));
    if (!words_.empty()) return true;
  }
  return false;
}

bool TextLines::begins_with_letter() const {
  return std::isalpha(static_cast<unsigned char>(words_[0][0])) != 0;
}

double TextLines::number(std::size_t word) const {
  double value = 0;
  std::string_view text = words_[word];
  if (text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    fail(fmt::format("\"{}\" is no number", words_[word]));
  return value;
}

std::int64_t TextLines::integer(std::size_t word) const {
  std::int64_t value = 0;
  const std::string_view text = words_[word];
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    fail(fmt::format("\"{}\" is no whole number", text));
  return value;
}

double TextLines::radius(std::size_t word, double factor) const {
  const double value = factor * number(word);
  if (!(value > 0) || value > std::numeric_limits<double>::max())
    fail(fmt::format("radius {} m: expected a number above zero", value));
  return value;
}

void TextLines::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", path_, number_, what));
}

}  // namespace solidem
