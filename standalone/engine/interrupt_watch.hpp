// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_INTERRUPT_WATCH_HPP
#define SOLIDEM_ENGINE_INTERRUPT_WATCH_HPP

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace solidem {

/// Answers an interrupt that a long step would keep waiting: a thread that looks every 50 ms and,
/// when the asked has been busy for half a second since, answers in its place.
class InterruptWatch {
 public:
  /// `interrupted`: set from outside; null: nobody interrupts. `answer` is called by the watching
  /// thread while the other is busy, and returns only where nothing can be done.
  InterruptWatch(const std::atomic<bool>* interrupted, std::function<void()> answer);
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// Does work during which the answer may be given.
  void while_busy(const std::function<void()>& work);

 private:
  void watch();

  const std::atomic<bool>* interrupted_;
  std::function<void()> answer_;
  std::mutex mutex_;  ///< of all below
  std::condition_variable wake_;
  bool is_busy_ = false, is_over_ = false;
  std::thread thread_;
};

}  // namespace solidem

#endif
