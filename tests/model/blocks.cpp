// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/blocks.hpp"

#include <gtest/gtest.h>

#include <new>
#include <string>
#include <vector>

#include "model/error.hpp"

namespace solidem::blocks_test {

/// More threads than the machine may have, as long as this lives.
class SeveralThreads {
 public:
  SeveralThreads() : before_(omp_get_max_threads()) { omp_set_num_threads(3); }
  ~SeveralThreads() { omp_set_num_threads(before_); }
  SeveralThreads(const SeveralThreads&) = delete;
  SeveralThreads& operator=(const SeveralThreads&) = delete;

 private:
  int before_;
};

TEST(Blocks, are_each_worked_on_once) {
  const SeveralThreads threads;
  for (const std::size_t least : {1u, 1000u}) {
    std::vector<int> visits(100, 0);
    for_blocks(visits.size(), least, [&](std::size_t first, std::size_t last) {
      for (std::size_t block = first; block < last; ++block) ++visits[block];
    });
    EXPECT_EQ(visits, std::vector<int>(100, 1));
  }
}

TEST(Blocks, few_of_them_need_one_thread_and_no_parallel_region) {
  const SeveralThreads threads;
  for_blocks(10, 11, [&](std::size_t first, std::size_t last) {
    EXPECT_EQ(first, 0u);
    EXPECT_EQ(last, 10u);
    EXPECT_FALSE(omp_in_parallel());
  });
}

TEST(Blocks, an_error_in_any_range_comes_out_as_it_was_thrown) {
  const SeveralThreads threads;
  for (const std::size_t wrong : {0u, 50u, 99u}) try {
      for_blocks(100, 1, [&](std::size_t first, std::size_t last) {
        if (first <= wrong && wrong < last) throw InputError("block " + std::to_string(wrong));
      });
      ADD_FAILURE() << "nothing came out";
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), "block " + std::to_string(wrong));
    }
  EXPECT_THROW(for_blocks(100, 1, [](std::size_t, std::size_t) { throw std::bad_alloc(); }),
               std::bad_alloc);
}

TEST(Parts, are_each_worked_on_once_with_what_their_thread_made) {
  const SeveralThreads threads;
  for (const bool on_all : {false, true}) {
    std::vector<int> visits(200, 0);
    for_each_part_with(
        visits.size(), on_all, [] { return std::vector<int>{41}; },
        [&](std::vector<int>& own, std::size_t part) { visits[part] += own.at(0) - 40; });
    EXPECT_EQ(visits, std::vector<int>(200, 1));
  }
}

TEST(Parts, of_several_errors_the_first_comes_out_whatever_the_threads_do) {
  const SeveralThreads threads;
  for (const bool on_all : {false, true})
    for (int again = 0; again < 20; ++again) try {
        for_each_part(100, on_all, [&](std::size_t part) {
          if (part % 7 == 3) throw RunError("part " + std::to_string(part));
        });
        ADD_FAILURE() << "nothing came out";
      } catch (const RunError& error) {
        EXPECT_STREQ(error.what(), "part 3");
      }
}

TEST(Parts, an_error_of_what_a_thread_needs_comes_out) {
  const SeveralThreads threads;
  const auto fails = []() -> int { throw std::bad_alloc(); };
  for (const bool on_all : {false, true})
    EXPECT_THROW(for_each_part_with(100, on_all, fails, [](int, std::size_t) {}), std::bad_alloc);
}

}  // namespace solidem::blocks_test
