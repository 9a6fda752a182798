// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_OUTPUT_PROGRESS_HPP
#define SOLIDEM_OUTPUT_PROGRESS_HPP

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace solidem {

/// A duration for people: "8 s", "4 min 05 s", "3 h 07 min", "2 d 04 h". Negative or not finite:
/// "?".
std::string duration_text(double seconds);

/// Tells how far a run is and how long it will still take: a bar that redraws itself on a terminal,
/// elsewhere a plain line now and then, at most 20 a run.
class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Style { quiet, lines, bar };

  /// Bar if the stream is a terminal, else lines.
  static Style style_for(std::FILE* stream);

  /// A run from first_step (more than 0 after a resume) to last_step.
  ProgressBar(std::int64_t first_step, std::int64_t last_step, Style style,
              std::FILE* stream = stderr);

  /// Ends the line of a bar.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Says that `step` is done. Cheap; prints seldom. `now` is for tests.
  void update(std::int64_t step, Clock::time_point now = Clock::now());

 private:
  void print_bar(std::int64_t step, double seconds_left);
  void print_line(std::int64_t step, double seconds_left);

  std::int64_t first_step_, last_step_;
  Style style_;
  std::FILE* stream_;
  Clock::time_point start_, printed_;
  int twentieths_ = 0;  // of the run, at the line before
  bool bar_shown_ = false;
};

}  // namespace solidem

#endif
