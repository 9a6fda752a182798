// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace solidem {

namespace {

constexpr double seconds_between_bars = 0.2;
constexpr double seconds_between_lines = 2.0;
constexpr int lines_in_a_run = 20;
constexpr int bar_width = 30;

/// Nobody needs to see it: that it cannot be printed is no reason to end a run.
void print(std::FILE* stream, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fflush(stream);
}

double seconds(ProgressBar::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

std::string duration_text(double seconds) {
  if (!(seconds >= 0) || !std::isfinite(seconds)) return "?";
  const auto total = static_cast<std::int64_t>(std::llround(seconds));
  constexpr std::int64_t minute = 60, hour = 60 * minute, day = 24 * hour;
  if (total < minute) return fmt::format("{} s", total);
  if (total < hour) return fmt::format("{} min {:02} s", total / minute, total % minute);
  if (total < day) return fmt::format("{} h {:02} min", total / hour, total % hour / minute);
  return fmt::format("{} d {:02} h", total / day, total % day / hour);
}

ProgressBar::Style ProgressBar::style_for(std::FILE* stream) {
  return ::isatty(::fileno(stream)) != 0 ? Style::bar : Style::lines;
}

ProgressBar::ProgressBar(std::int64_t first_step, std::int64_t last_step, Style style,
                         std::FILE* stream)
    : first_step_(first_step),
      last_step_(last_step),
      style_(style),
      stream_(stream),
      start_(Clock::now()),
      printed_(start_) {}

ProgressBar::~ProgressBar() {
  if (bar_shown_) print(stream_, "\n");
}

void ProgressBar::update(std::int64_t step, Clock::time_point now) {
  if (style_ == Style::quiet || last_step_ <= first_step_) return;
  const bool at_end = step >= last_step_;
  const double pause = style_ == Style::bar ? seconds_between_bars : seconds_between_lines;
  if (seconds(now - printed_) < pause && !(at_end && bar_shown_)) return;

  const auto done = static_cast<double>(step - first_step_);
  const double rest = static_cast<double>(last_step_ - step);
  const double seconds_left = done > 0 ? seconds(now - start_) * rest / done : -1;
  if (style_ == Style::bar) {
    print_bar(step, seconds_left);
  } else {
    const int twentieths =
        static_cast<int>(lines_in_a_run * done / static_cast<double>(last_step_ - first_step_));
    if (twentieths <= twentieths_) return;
    twentieths_ = twentieths;
    print_line(step, seconds_left);
  }
  printed_ = now;
}

void ProgressBar::print_bar(std::int64_t step, double seconds_left) {
  const double fraction =
      std::clamp(static_cast<double>(step) / static_cast<double>(last_step_), 0.0, 1.0);
  const int filled = static_cast<int>(bar_width * fraction);
  print(stream_, fmt::format("\r[{:=<{}}{: <{}}] {:3.0f} %  step {} of {}  {} left\033[K", "",
                             filled, "", bar_width - filled, std::floor(100 * fraction), step,
                             last_step_, duration_text(seconds_left)));
  bar_shown_ = true;
}

void ProgressBar::print_line(std::int64_t step, double seconds_left) {
  const double fraction = static_cast<double>(step) / static_cast<double>(last_step_);
  print(stream_, fmt::format("{:.0f} %: step {} of {}, {} left\n", std::floor(100 * fraction), step,
                             last_step_, duration_text(seconds_left)));
}

}  // namespace solidem
