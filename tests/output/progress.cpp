// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/progress.hpp"

#include <cmath>

#include "conditions.hpp"

namespace solidem::progress_test {

using std::chrono::milliseconds;

/// What a run of `steps` steps, each lasting so long, prints.
std::string printed(ProgressBar::Style style, std::int64_t first, std::int64_t last,
                    milliseconds step_time) {
  std::FILE* const stream = std::tmpfile();
  {
    ProgressBar progress(first, last, style, stream);
    ProgressBar::Clock::time_point now = ProgressBar::Clock::now();
    for (std::int64_t step = first; step <= last; ++step, now += step_time)
      progress.update(step, now);
  }
  std::string text(static_cast<std::size_t>(std::ftell(stream)), '\0');
  std::rewind(stream);
  const std::size_t read = std::fread(text.data(), 1, text.size(), stream);
  EXPECT_EQ(read, text.size());
  std::fclose(stream);
  return text;
}

auto lines_in(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST(Progress, prints_few_plain_lines_however_long_the_run) {
  const std::string text = printed(ProgressBar::Style::lines, 0, 100000, milliseconds(100));
  EXPECT_GT(lines_in(text), 10);
  EXPECT_LE(lines_in(text), 20);
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, tells_the_time_left) {
  // 1000 steps of a second: at step 500 another 500 s are left.
  const std::string text = printed(ProgressBar::Style::lines, 0, 1000, milliseconds(1000));
  EXPECT_TRUE(contains(text, "50 %: step 500 of 1000, 8 min 20 s left\n")) << text;
}

TEST(Progress, of_a_resumed_run_counts_only_its_own_time) {
  const std::string text = printed(ProgressBar::Style::lines, 800, 1000, milliseconds(1000));
  EXPECT_TRUE(contains(text, "90 %: step 900 of 1000, 1 min 40 s left\n")) << text;
}

TEST(Progress, says_nothing_when_quiet_or_when_the_run_is_short) {
  EXPECT_EQ(printed(ProgressBar::Style::quiet, 0, 1000, milliseconds(1000)), "");
  EXPECT_EQ(printed(ProgressBar::Style::lines, 0, 100, milliseconds(1)), "");
  EXPECT_EQ(printed(ProgressBar::Style::bar, 0, 100, milliseconds(1)), "");
}

TEST(Progress, bar_redraws_one_line_and_ends_full) {
  const std::string text = printed(ProgressBar::Style::bar, 0, 1000, milliseconds(50));
  EXPECT_EQ(lines_in(text), 1);
  EXPECT_LE(std::count(text.begin(), text.end(), '\r'), 1 + 1000 * 50 / 200);
  const std::string last = text.substr(text.rfind('\r'));
  EXPECT_TRUE(contains(last, '[' + std::string(30, '=') + "] 100 %  step 1000 of 1000")) << last;
}

TEST(Progress, draws_a_bar_on_terminals_only) {
  std::FILE* const file = std::tmpfile();
  EXPECT_EQ(ProgressBar::style_for(file), ProgressBar::Style::lines);
  std::fclose(file);
}

TEST(DurationText, is_short_and_rounds) {
  EXPECT_EQ(duration_text(7.6), "8 s");
  EXPECT_EQ(duration_text(59.7), "1 min 00 s");
  EXPECT_EQ(duration_text(245), "4 min 05 s");
  EXPECT_EQ(duration_text(3 * 3600 + 7 * 60 + 12), "3 h 07 min");
  EXPECT_EQ(duration_text(2 * 86400 + 4 * 3600), "2 d 04 h");
  EXPECT_EQ(duration_text(-1), "?");
  EXPECT_EQ(duration_text(std::nan("")), "?");
}

TEST(ProgressBar, does_not_end_a_run_when_it_cannot_be_printed) {
  std::FILE* const full = std::fopen("/dev/full", "w");
  for (const auto style : {ProgressBar::Style::bar, ProgressBar::Style::lines}) {
    ProgressBar progress(0, 1000, style, full);
    const auto later = ProgressBar::Clock::now() + std::chrono::hours(1);
    EXPECT_NO_THROW(progress.update(500, later));
  }
  EXPECT_NE(std::ferror(full), 0) << "it must have tried";
  std::fclose(full);
}

}  // namespace solidem::progress_test
