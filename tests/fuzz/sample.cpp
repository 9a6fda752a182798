// SPDX-License-Identifier: GPL-2.0-or-later
//
// A short, fixed sample of what the fuzzers do without end (tests/fuzz/run): good inputs with bytes
// changed, cut out, doubled and exchanged. A crash, or an exception that is none of ours, fails.
// FUZZ_INPUTS asks for another number of them than 400 for each target, FUZZ_SEED for others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "targets.hpp"

namespace solidem::fuzz::sample_test {

std::string mutated(std::string input, std::mt19937& random) {
  const auto below = [&](std::size_t count) { return random() % std::max<std::size_t>(1, count); };
  const std::size_t changes = 1 + below(6);
  for (std::size_t k = 0; k < changes; ++k) {
    const std::size_t place = below(input.size()), length = below(input.size() - place);
    switch (below(5)) {
      case 0:
        input.erase(place, length % 12);
        break;
      case 1:
        input.insert(place, input.substr(below(input.size()), length % 12));
        break;
      case 2:
        input.insert(place, std::to_string(static_cast<std::int64_t>(random()) - (1 << 30)));
        break;
      case 3:
        input.resize(place);
        break;
      default:
        if (!input.empty()) input[place] = static_cast<char>(random());
    }
  }
  return input;
}

long number_of(const char* variable, long otherwise) {
  const char* given = std::getenv(variable);
  return given == nullptr ? otherwise : std::atol(given);
}

class Fuzz : public testing::TestWithParam<Target> {};

TEST_P(Fuzz, accepts_good_inputs_and_survives_others) {
  const Target& target = GetParam();
  std::mt19937 random(static_cast<std::uint32_t>(number_of("FUZZ_SEED", 20)));
  for (const std::string& seed : target.seeds) EXPECT_NO_THROW(target.run(seed));
  const long inputs = number_of("FUZZ_INPUTS", 400);
  for (long k = 0; k < inputs; ++k)
    EXPECT_NO_THROW(target.run(mutated(target.seeds[random() % target.seeds.size()], random))) << k;
}

INSTANTIATE_TEST_SUITE_P(Inputs, Fuzz, testing::ValuesIn(targets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace solidem::fuzz::sample_test
