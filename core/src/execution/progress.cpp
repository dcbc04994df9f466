// SPDX-License-Identifier: Apache-2.0
#include "execution/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>

namespace tunica::execution {

namespace {

constexpr double bar_interval = 0.1, line_interval = 5;  // s
constexpr std::size_t shortest_bar = 5;                  // columns

std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20) return size.ws_col;
  return 80;
}

std::string rate_text(double rate) {
  if (rate >= 1e6) return fmt::format("{:.1f} M", rate / 1e6);
  if (rate >= 1e4) return fmt::format("{:.0f} k", rate / 1e3);
  return fmt::format("{:.3g} ", rate);
}

}  // namespace

Meter::Meter() : best(std::numeric_limits<double>::infinity()) {}

void Meter::count(const calibration::Record& record) {
  evaluations.store(record.index + 1, std::memory_order_relaxed);
  if (record.status.ok() && record.objective < best.load(std::memory_order_relaxed))
    best.store(record.objective, std::memory_order_relaxed);
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(0.0, seconds)));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

Progress::Style Progress::style_of_stderr() {
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = ::isatty(STDERR_FILENO) == 1 && terminal && std::string_view(terminal) != "dumb";
  return can_redraw ? Style::bar : Style::lines;
}

Progress::Progress(Style style, const Plan& plan, const std::vector<Meter>& meters)
    : style_(style), colour_(false), plan_(plan), meters_(meters) {
  const char* no_colour = std::getenv("NO_COLOR");
  colour_ = style == Style::bar && !(no_colour && *no_colour);
}

std::string Progress::text(double seconds) const {
  std::uint64_t evaluations = 0, budget = 0;
  std::size_t finished = 0, current = meters_.size();
  std::vector<double> best(plan_.runs.size(), std::numeric_limits<double>::infinity());
  for (std::size_t task = 0; task < meters_.size(); ++task) {
    const auto& meter = meters_[task];
    const auto done = meter.evaluations.load(std::memory_order_relaxed);
    const bool over = meter.finished.load(std::memory_order_relaxed);
    const std::size_t run = plan_.tasks[task].run;
    evaluations += done;
    budget += over ? done : std::max(done, plan_.runs[run].entry->stop.max_evaluations);
    finished += over;
    best[run] = std::min(best[run], meter.best.load(std::memory_order_relaxed));
    if (current == meters_.size() && !over && meter.running.load(std::memory_order_relaxed)) current = task;
  }
  const double rate = seconds > 0 ? static_cast<double>(evaluations) / seconds : 0;
  const double share = budget > 0 ? static_cast<double>(evaluations) / static_cast<double>(budget) : 1;
  std::string line =
      fmt::format("{:3.0f} %  {}/{} searches  {}/s", 100 * share, finished, meters_.size(), rate_text(rate));
  if (current < meters_.size()) {
    const auto run = plan_.tasks[current].run;
    line += fmt::format("  {}: ", plan_.runs[run].label);
    line += std::isfinite(best[run]) ? fmt::format("best {:.6g}", best[run]) : "no success yet";
  }
  // The budget is an upper bound, for a search may converge before it is spent; so is the time.
  if (rate > 0) line += fmt::format("  max {} left", clock_text(static_cast<double>(budget - evaluations) / rate));
  return line;
}

void Progress::draw(bool last) {
  if (style_ == Style::none) return;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  if (style_ == Style::lines) {
    if (last || seconds - drawn_ < line_interval) return;
    drawn_ = seconds;
    fmt::print(stderr, "{}\n", text(seconds));
    return;
  }
  if (last) {
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
    return;
  }
  if (seconds - drawn_ < bar_interval) return;
  drawn_ = seconds;
  std::string line = text(seconds);
  const std::size_t width = terminal_width() - 1;
  if (line.size() + 3 + shortest_bar <= width) {
    const std::size_t length = std::min<std::size_t>(width - line.size() - 3, 30);
    const auto full =
        static_cast<std::size_t>(std::lround(std::strtod(line.c_str(), nullptr) / 100 * static_cast<double>(length)));
    const std::string bar = std::string(full, '#') + std::string(length - std::min(full, length), '.');
    line = fmt::format("[{}{}{}] {}", colour_ ? "\033[36m" : "", bar, colour_ ? "\033[0m" : "", line);
  } else {
    line.resize(std::min(line.size(), width));
  }
  fmt::print(stderr, "\r{}\033[K", line);
  std::fflush(stderr);
}

}  // namespace tunica::execution
