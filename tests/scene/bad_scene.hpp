// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bad scenes: each spoils one thing of a good scene, and the complaint must name the file and line,
// the key, the value, and what would be right.
#ifndef SOLIDEM_TESTS_SCENE_BAD_SCENE_HPP
#define SOLIDEM_TESTS_SCENE_BAD_SCENE_HPP

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "scene_text.hpp"

namespace solidem::test {

struct BadScene {
  std::string name;
  const std::string* good;  ///< the scene that is spoilt
  std::string from, to;     ///< what is replaced, by what
  std::string line_of;      ///< text that stands on the line the complaint must name; "" for `to`
  std::vector<std::string> fragments;  ///< of the complaint
};

inline void PrintTo(const BadScene& bad, std::ostream* stream) {
  *stream << "\"" << bad.to << "\" instead of \"" << bad.from << "\"";
}

inline std::string row_name(const testing::TestParamInfo<BadScene>& row) {
  return row.param.name;
}

inline void expect_refused(const BadScene& bad) {
  ASSERT_EQ(complaint(*bad.good), "");
  const std::string text = replaced(*bad.good, bad.from, bad.to);
  const std::string words = complaint(text);
  ASSERT_NE(words, "") << text;
  const int line = line_of(text, bad.line_of.empty() ? bad.to : bad.line_of);
  const std::string place = folder().file("scene.toml") + ":" + std::to_string(line) + ": ";
  EXPECT_EQ(words.substr(0, place.size()), place) << words;
  for (const std::string& fragment : bad.fragments)
    EXPECT_NE(words.find(fragment), std::string::npos) << fragment << "\n  in: " << words;
}

inline const std::string* const bar = &bar_scene;
inline const std::string* const heat = &heat_scene;

}  // namespace solidem::test

#endif
