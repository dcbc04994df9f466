// SPDX-License-Identifier: Apache-2.0
#include "stages.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "execution/progress.hpp"
#include "text/aside.hpp"

namespace tunica::app {

namespace {
constexpr auto interval = std::chrono::milliseconds(200);
}

Stages::Stages(bool quiet) : terminal_(text::Terminal::of(STDERR_FILENO)), line_(terminal_), quiet_(quiet) {
  if (quiet_ || !terminal_.redraws) return;
  clock_ = std::thread([this] {
    std::unique_lock lock(mutex_);
    while (!over_.wait_for(lock, interval, [this] { return ended_; })) draw();
  });
}

Stages::~Stages() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  over_.notify_all();
  if (!clock_.joinable()) return;
  clock_.join();
  line_.clear();
}

void Stages::draw() const {
  if (what_.empty()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  std::string text = fmt::format("{:3.0f} %  {}  {}", 100 * share_, what_, text::clock_text(seconds));
  // The shares are those of typical diagnoses; early ones would promise too much.
  constexpr double telling = 0.2;
  if (share_ >= telling) text += fmt::format(", about {} left", text::clock_text(seconds * (1 - share_) / share_));
  line_.draw(text, share_);
}

void Stages::tell(const std::string& what, double share) {
  if (quiet_ || share >= 1) return;
  const std::lock_guard lock(mutex_);
  if (share < share_) return;  // what is done a second time, or was told late by another thread
  const bool new_stage = what != what_;
  what_ = what;
  share_ = share;
  if (new_stage && terminal_.redraws) draw();
  if (new_stage && !terminal_.redraws) text::aside("{:3.0f} %  {}\n", 100 * share, what);
}

}  // namespace tunica::app
