// SPDX-License-Identifier: GPL-2.0-or-later
//
// Work on several threads. All parallel regions of the core are here: what is thrown in one is kept
// and thrown after it, as an exception that leaves a region ends the program.
#ifndef SOLIDEM_MODEL_BLOCKS_HPP
#define SOLIDEM_MODEL_BLOCKS_HPP

#include <omp.h>

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>

namespace solidem {

/// Of the exceptions that parts of a work throw, the one of the part with the lowest number.
class FirstException {
 public:
  /// Does a part's work and keeps what it throws.
  template <class Work>
  void guard(std::size_t part, const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      keep(part);
    }
  }

  /// Throws what was kept, if anything was.
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  void keep(std::size_t part) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (exception_ && part >= part_) return;
    part_ = part;
    exception_ = std::current_exception();
  }

  std::mutex mutex_;
  std::size_t part_ = 0;
  std::exception_ptr exception_;
};

/// Blocks of elements from which on a second thread pays in a loop that moves them.
inline constexpr std::size_t least_blocks_moving = 600;

/// Calls work(first, last) on all threads for ranges that together hold each block once. Below
/// `least_blocks` a thread would cost more than it saves, and one thread does it all.
template <class Work>
void for_blocks(std::size_t blocks, std::size_t least_blocks, const Work& work) {
  if (blocks < least_blocks || omp_get_max_threads() == 1) {
    work(0, blocks);
    return;
  }
  FirstException thrown;
#pragma omp parallel
  {
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    thrown.guard(thread, [&] { work(blocks * thread / threads, blocks * (thread + 1) / threads); });
  }
  thrown.rethrow();
}

/// Calls work(own, part) for each part below a count, on all threads as they become free, or on
/// this one alone; `own` is what make() made for the thread.
template <class Make, class Work>
void for_each_part_with(std::size_t parts, bool on_all_threads, const Make& make,
                        const Work& work) {
  if (!on_all_threads) {
    auto own = make();
    for (std::size_t part = 0; part < parts; ++part) work(own, part);
    return;
  }
  std::atomic<std::size_t> next{0};
  FirstException thrown;
#pragma omp parallel
  thrown.guard(parts, [&] {
    auto own = make();
    for (std::size_t part = next++; part < parts; part = next++)
      thrown.guard(part, [&] { work(own, part); });
  });
  thrown.rethrow();
}

/// The same for work(part), which needs nothing of its own.
template <class Work>
void for_each_part(std::size_t parts, bool on_all_threads, const Work& work) {
  for_each_part_with(
      parts, on_all_threads, [] { return nullptr; },
      [&](std::nullptr_t, std::size_t part) { work(part); });
}

}  // namespace solidem

#endif
