// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_ARCHIVE_HPP
#define SOLIDEM_MODEL_ARCHIVE_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// A list of numbers that a state is written to or read from: whoever has a state visits it once,
/// archive(a, b, c), and both directions agree by construction.
class Archive {
 public:
  /// To write to.
  Archive() = default;
  /// To read from the state of a body of so many elements.
  Archive(std::vector<double> values, std::size_t elements)
      : values_(std::move(values)), elements_(elements), reading_(true) {}

  bool is_reading() const { return reading_; }
  const std::vector<double>& values() const { return values_; }

  /// Whether all that was written has been read.
  bool is_at_end() const { return at_ == values_.size(); }

  /// Writes or reads each of them. Reading throws std::out_of_range beyond the end, for a number
  /// that its type cannot hold, and for a std::int32_t, always the number of an element, that none
  /// has.
  template <class... Values>
  void operator()(Values&... values) {
    (visit(values), ...);
  }

 private:
  void visit(double& value) {
    if (reading_)
      value = values_.at(at_++);
    else
      values_.push_back(value);
  }
  template <class Number>
  void number(Number& value) {
    auto as_double = static_cast<double>(value);
    visit(as_double);
    using Limits = std::numeric_limits<Number>;
    if (reading_)
      insist_on_integer(as_double, static_cast<double>(Limits::lowest()),
                        static_cast<double>(Limits::max()));
    value = static_cast<Number>(as_double);
  }
  void visit(bool& value) { number(value); }
  void visit(std::int32_t& value) {
    number(value);
    if (reading_) insist_on_element(value);
  }
  void visit(std::int64_t& value) { number(value); }
  void visit(std::size_t& value) { number(value); }
  void visit(char& value) { number(value); }
  void visit(Vector& value) { (*this)(value.x, value.y, value.z); }
  void visit(Pair& value) { (*this)(value.i, value.j); }

  template <class Value, std::size_t size>
  void visit(std::array<Value, size>& values) {
    for (Value& value : values) visit(value);
  }
  template <class Value>
  void visit(std::vector<Value>& values) {
    std::size_t size = values.size();
    number(size);
    if (reading_) values.resize(checked(size));
    for (Value& value : values) visit(value);
  }
  template <class Key, class Value>
  void visit(std::map<Key, Value>& values) {
    std::vector<std::pair<Key, Value>> entries(values.begin(), values.end());
    visit(entries);
    values = {entries.begin(), entries.end()};
  }
  template <class Value>
  void visit(std::set<Value>& values) {
    std::vector<Value> entries(values.begin(), values.end());
    visit(entries);
    values = {entries.begin(), entries.end()};
  }
  template <class First, class Second>
  void visit(std::pair<First, Second>& value) {
    (*this)(value.first, value.second);
  }
  /// Anything with a state of its own.
  template <class Value>
  auto visit(Value& value) -> decltype(value.state(*this)) {
    value.state(*this);
  }

  static void insist_on_integer(double value, double lowest, double highest);
  void insist_on_element(std::int32_t value) const;
  /// A list cannot have more entries than there are numbers left.
  std::size_t checked(std::size_t size) const;

  std::vector<double> values_;
  std::size_t at_ = 0, elements_ = 0;
  bool reading_ = false;
};

}  // namespace solidem

#endif
