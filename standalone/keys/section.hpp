// SPDX-License-Identifier: GPL-2.0-or-later
//
// How a scene file is taken apart. A section lists the keys it may have, each with a rule that
// reads the value into its target:
//
//   section.read({
//       must_have("young_modulus", quantity(beams.young_modulus, dimension::modulus, positive)),
//       may_have("radius_from", choice(beams.radius_from, {{"mean", ...}, {"pair", ...}})),
//   });
//
// Everything that is not in the list is refused, so a list is the whole grammar of its section.
// Every error is an InputError that reads `file:line: [section] key = value: problem; expected
// ...`.
#ifndef SOLIDEM_KEYS_SECTION_HPP
#define SOLIDEM_KEYS_SECTION_HPP

#include <toml++/toml.h>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "keys/record.hpp"

namespace solidem {

/// A value of a scene file: its TOML node, and where it stands.
class Value {
 public:
  /// `label` is the value's name for messages: "[beams]", "[beams] young_modulus", "[run] x[2]";
  /// empty for the file as a whole. `record` collects what is read.
  Value(const toml::node& node, const std::string& file, const std::string& label,
        std::shared_ptr<Record> record)
      : node_(node), file_(file), label_(label), record_(std::move(record)) {}

  const toml::node& node() const { return node_; }
  /// The scene file that it stands in.
  const std::string& file() const { return file_; }

  /// The value of a table under a key; null when there is none.
  const toml::node* find(const std::string& key) const;
  Value child(const std::string& key) const;

  /// The entries of an array; refused when it is none or when their number is not `size` (−1: any).
  std::vector<Value> entries(int size, const std::string& expected) const;

  /// Enters what was understood of the value into the record.
  void note(const std::string& meaning) const { record_->emplace_back(label_, meaning); }

  /// Throws InputError. `problem` says what is wrong with the value, `expected` what would be
  /// right.
  [[noreturn]] void refuse(const std::string& problem, const std::string& expected) const;

  /// Throws InputError about a key that is not there.
  [[noreturn]] void refuse_missing(const std::string& key, const std::string& expected) const;

 private:
  std::string place() const;
  std::string child_label(const std::string& key) const;

  const toml::node& node_;
  std::string file_, label_;
  std::shared_ptr<Record> record_;
};

/// A value as it stands in its target: none where nothing was given.
using Shown =
    std::variant<std::monostate, double, std::int64_t, bool, std::string, std::array<double, 3>>;

/// How one value is read into its target, and what it must be, in words.
struct Rule {
  std::string expected;
  std::function<void(const Value&)> read;  ///< refuses what does not follow the rule
  std::function<Shown()> show{};           ///< the value in its target; null: it is no single value
};

/// A key that a section knows.
struct Key {
  std::string name;
  Rule rule;
  bool is_required;
  std::string reason;       ///< why a required key is required, when it is not always
  std::string meaning{};    ///< what it says, for the pages
  std::string otherwise{};  ///< what holds without it, where that is no value of its target

  Key means(const std::string& words) const {
    Key key = *this;
    key.meaning = words;
    return key;
  }
  Key without(const std::string& words) const {
    Key key = *this;
    key.otherwise = words;
    return key;
  }
};

inline Key must_have(const std::string& name, const Rule& rule, const std::string& reason = "") {
  return {name, rule, true, reason};
}

inline Key may_have(const std::string& name, const Rule& rule) {
  return {name, rule, false, ""};
}

/// A table of a scene file.
class Section {
 public:
  /// Refuses a value that is no table.
  explicit Section(const Value& value);

  bool has(const std::string& key) const { return value_.find(key) != nullptr; }

  /// Refuses unknown keys, then reads the known ones in the order given. `kind` says in messages
  /// about unknown keys what the list belongs to ("a box"); the default is the section's name.
  void read(const std::vector<Key>& keys, const std::string& kind = "") const;

  /// Reads one key, whatever the others are: for keys that decide which others there may be.
  void read_one(const Key& key) const;

  /// For keys that are names of the user's choice.
  void for_each(const std::function<void(const std::string& key, const Value&)>& visit) const;

  /// Refuses two of these keys together.
  void at_most_one_of(const std::vector<std::string>& keys) const;

  /// Refuses two of these keys together, and none of them.
  void exactly_one_of(const std::vector<std::string>& keys) const;

  /// Refuses the value of a key for a reason that its rule cannot know; if the key is absent, the
  /// section.
  [[noreturn]] void refuse(const std::string& key, const std::string& problem,
                           const std::string& expected) const;
  [[noreturn]] void refuse(const std::string& problem, const std::string& expected) const {
    value_.refuse(problem, expected);
  }

 private:
  Value value_;
};

/// A section with its own list of keys.
Rule table(const std::function<void(const Section&)>& read);

/// A section that stands once for each of several things: [[name]].
Rule tables(const std::function<void(const Section&)>& read_each);

}  // namespace solidem

#endif
