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

Stages::Stages(bool quiet, Clock::duration patience)
    : terminal_(text::Terminal::of(STDERR_FILENO)), line_(terminal_), quiet_(quiet), patience_(patience) {
  if (quiet_ || (!terminal_.redraws && patience_ == Clock::duration{})) return;
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
  if (terminal_.redraws) line_.clear();
}

double Stages::seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

void Stages::draw() {
  if (what_.empty() || Clock::now() - begin_ < patience_) return;
  std::string text = share_ ? fmt::format("{:3.0f} %  {}", 100 * *share_, what_) : what_;
  if (!terminal_.redraws) {
    if (what_ != said_) text::aside("{}\n", text);
    said_ = what_;
    return;
  }
  text += "  " + text::clock_text(seconds());
  // The shares are those of typical work; early ones would promise too much.
  constexpr double telling = 0.2;
  if (share_ && *share_ >= telling)
    text += fmt::format(", about {} left", text::clock_text(seconds() * (1 - *share_) / *share_));
  line_.draw(text, share_);
}

void Stages::tell(const std::string& what, std::optional<double> share) {
  if (quiet_ || share.value_or(0) >= 1) return;
  const std::lock_guard lock(mutex_);
  if (share && share_ && *share < *share_) return;  // what is done a second time, or was told late by another thread
  const bool new_stage = what != what_;
  what_ = what;
  share_ = share;
  if (new_stage) draw();
}

}  // namespace tunica::app
