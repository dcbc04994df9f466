// SPDX-License-Identifier: Apache-2.0
#include "execution/interrupt.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <utility>

namespace tunica::execution {

namespace {

std::atomic<bool> raised = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void on_signal(int number) {
  raised.store(true, std::memory_order_relaxed);
  std::signal(number, SIG_DFL);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  raised = false;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGXFSZ, SIG_IGN);
}

InterruptWatch::~InterruptWatch() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
}

bool InterruptWatch::interrupted() { return raised.load(std::memory_order_relaxed); }

InterruptLimit::InterruptLimit(std::function<void()> leave) {
  if (!leave) return;
  watch_ = std::thread([this, leave = std::move(leave)] {
    constexpr std::chrono::milliseconds heartbeat{100};
    constexpr int patience = 5;  // heartbeats; rows reach the disk within one
    int waited = 0;
    for (std::unique_lock lock(mutex_); !over_.wait_for(lock, heartbeat, [this] { return ended_; });) {
      waited = InterruptWatch::interrupted() ? waited + 1 : 0;
      if (waited > patience) return leave();
    }
  });
}

InterruptLimit::~InterruptLimit() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  over_.notify_all();
  if (watch_.joinable()) watch_.join();
}

}  // namespace tunica::execution
