// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_ARCHIVE_HPP
#define SOLIDEM_MODEL_ARCHIVE_HPP

#include <array>
#include <cstddef>
#include <cstdint>
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
  /// To read from.
  explicit Archive(std::vector<double> values) : values_(std::move(values)), reading_(true) {}

  bool is_reading() const { return reading_; }
  const std::vector<double>& values() const { return values_; }

  /// Writes or reads each of them. Reading beyond the end throws std::out_of_range.
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
    value = static_cast<Number>(as_double);
  }
  void visit(bool& value) { number(value); }
  void visit(std::int32_t& value) { number(value); }
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

  /// A list cannot have more entries than there are numbers left.
  std::size_t checked(std::size_t size) const;

  std::vector<double> values_;
  std::size_t at_ = 0;
  bool reading_ = false;
};

}  // namespace solidem

#endif
