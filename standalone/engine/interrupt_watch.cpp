// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/interrupt_watch.hpp"

#include <chrono>
#include <utility>

namespace solidem {

InterruptWatch::InterruptWatch(const std::atomic<bool>* interrupted, std::function<void()> answer)
    : interrupted_(interrupted), answer_(std::move(answer)) {
  if (interrupted_ != nullptr) thread_ = std::thread([this] { watch(); });
}

InterruptWatch::~InterruptWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void InterruptWatch::while_busy(const std::function<void()>& work) {
  const auto set_busy = [this](bool busy) {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_busy_ = busy;
  };
  set_busy(true);
  try {
    work();
  } catch (...) {
    set_busy(false);
    throw;
  }
  set_busy(false);
}

void InterruptWatch::watch() {
  constexpr auto look = std::chrono::milliseconds(50);
  constexpr int patience = 10;  // looks
  int looks = 0;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!wake_.wait_for(lock, look, [this] { return is_over_; })) {
    if (!*interrupted_ || ++looks < patience || !is_busy_) continue;
    // The lock is held: whoever is busy waits when done, so that both never write.
    answer_();
  }
}

}  // namespace solidem
