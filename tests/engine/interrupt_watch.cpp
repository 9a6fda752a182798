// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/interrupt_watch.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace solidem::interrupt_watch_test {

using Clock = std::chrono::steady_clock;

TEST(InterruptWatch, answers_within_a_long_step) {
  std::atomic<bool> interrupted{false}, answered{false};
  InterruptWatch watch(&interrupted, [&] { answered = true; });
  const auto start = Clock::now();
  watch.while_busy([&] {
    interrupted = true;
    while (!answered && Clock::now() - start < std::chrono::seconds(20)) std::this_thread::yield();
  });
  EXPECT_TRUE(answered);
}

TEST(InterruptWatch, leaves_the_answer_to_whoever_is_not_busy) {
  std::atomic<bool> interrupted{true}, answered{false};
  {
    InterruptWatch watch(&interrupted, [&] { answered = true; });
    watch.while_busy([] {});
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
  }
  EXPECT_FALSE(answered);
}

TEST(InterruptWatch, lets_an_error_through) {
  std::atomic<bool> interrupted{false};
  InterruptWatch watch(&interrupted, [] {});
  EXPECT_THROW(watch.while_busy([] { throw 1; }), int);
}

}  // namespace solidem::interrupt_watch_test
