// SPDX-License-Identifier: Apache-2.0
#include "execution/interrupt.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <utility>

#include "plugins/casualties.hpp"
#include "plugins/interrupted.hpp"

namespace tunica::execution {

namespace {

/// A signal and its previous handler: a program ends by default, while an interpreter has its own handler.
struct Watched {
  int number;
  struct sigaction before;
};
std::array<Watched, 3> watched{{{SIGINT, {}}, {SIGTERM, {}}, {SIGXFSZ, {}}}};

void restore(const Watched& signal) { ::sigaction(signal.number, &signal.before, nullptr); }

/// A supervisor kills a child that does not stop at the second signal. Without a supervisor, any second signal ends the
/// process.
void on_signal(int) {
  plugins::interrupted.store(true, std::memory_order_relaxed);
  if (plugins::casualties != nullptr) return;
  for (const Watched& signal : watched)
    if (signal.number != SIGXFSZ) restore(signal);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  plugins::interrupted = false;
  for (Watched& signal : watched) {
    struct sigaction now = {};
    now.sa_handler = signal.number == SIGXFSZ ? SIG_IGN : on_signal;
    now.sa_flags = SA_RESTART;
    ::sigaction(signal.number, &now, &signal.before);
  }
}

InterruptWatch::~InterruptWatch() {
  for (const Watched& signal : watched) restore(signal);
}

bool InterruptWatch::interrupted() { return plugins::interrupted.load(std::memory_order_relaxed); }

void InterruptWatch::interrupt() { plugins::interrupted.store(true, std::memory_order_relaxed); }

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
