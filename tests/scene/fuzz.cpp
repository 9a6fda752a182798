// SPDX-License-Identifier: GPL-2.0-or-later
//
// Spoilt scenes by the thousand: whatever stands in a scene file, reading it ends with a scene or
// with an InputError that begins with the file's name.
#include <gtest/gtest.h>

#include <random>

#include "scene_text.hpp"

namespace solidem::test::fuzz_test {

/// Words, numbers, strings and single signs, with the blanks between them.
std::vector<std::string> tokens_of(const std::string& text) {
  const auto kind = [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return std::isalnum(u) != 0 || c == '_' || c == '.' ? 0 : std::isspace(u) != 0 ? 1 : 2;
  };
  std::vector<std::string> tokens;
  for (const char c : text) {
    if (!tokens.empty() && kind(c) != 2 && kind(c) == kind(tokens.back().back()))
      tokens.back() += c;
    else
      tokens.emplace_back(1, c);
  }
  return tokens;
}

class Spoiler {
 public:
  explicit Spoiler(unsigned seed) : random_(seed) {}

  std::string spoil(const std::string& text) {
    static const std::string odd[] = {"\"",   "[",       "]]",   "{",  "=",
                                      "-1",   "1e400",   "nan",  "0",  "\n",
                                      ",",    "\\u",     "true", "[[", "9223372036854775808",
                                      "\xff", "\"\"",    "°",    "#",  ".",
                                      "%",    "x = 1\n", "[]"};
    std::vector<std::string> tokens = tokens_of(text);
    const std::size_t changes = 1 + below(3);
    for (std::size_t change = 0; change < changes; ++change) {
      const std::size_t at = below(tokens.size());
      switch (below(6)) {
        case 0:
          tokens[at].clear();
          break;
        case 1:
          tokens[at] += tokens[at];
          break;
        case 2:
          std::swap(tokens[at], tokens[below(tokens.size())]);
          break;
        case 3:
          tokens[at] = odd[below(std::size(odd))];
          break;
        case 4:
          tokens[at] = tokens[below(tokens.size())];
          break;
        default:
          flip_letter(tokens[at]);
      }
    }
    std::string spoilt;
    for (const std::string& token : tokens) spoilt += token;
    return spoilt;
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
  void flip_letter(std::string& token) {
    if (token.empty()) return;
    char& c = token[below(token.size())];
    c = static_cast<char>(c ^ (1 << below(8)));
  }
  std::mt19937 random_;
};

TEST(SceneFuzz, EndsWithASceneOrAnInputError) {
  std::vector<std::string> scenes = {bar_scene, heat_scene};
  for (const auto& entry : std::filesystem::directory_iterator(SOLIDEM_SOURCE_DIR "/docs/examples"))
    if (entry.path().extension() == ".toml") scenes.push_back(file_text(entry.path().string()));
  Spoiler spoiler(1);
  const std::string path = folder().file("fuzz.toml");
  int refused = 0;
  const int trials = 3000;
  for (int trial = 0; trial < trials; ++trial) {
    const std::string text = spoiler.spoil(scenes[static_cast<std::size_t>(trial) % scenes.size()]);
    folder().write("fuzz.toml", text);
    try {
      read_scene(path);
    } catch (const InputError& error) {
      ++refused;
      ASSERT_EQ(std::string(error.what()).rfind(path + ":", 0), 0U) << error.what();
    } catch (const std::exception& error) {
      FAIL() << error.what() << "\n" << text;
    }
  }
  // Most changes hit a word that means something.
  EXPECT_GT(refused, trials / 2);
}

}  // namespace solidem::test::fuzz_test
