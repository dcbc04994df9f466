// SPDX-License-Identifier: Apache-2.0
#include "execution/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>
#include <unistd.h>

#include "text/aside.hpp"
#include "text/wrapping.hpp"

namespace tunica::execution {

namespace {

constexpr double bar_interval = 0.1, line_interval = 5;  // s

std::string rate_text(double rate) {
  if (rate >= 1e6) return fmt::format("{:.1f} M", rate / 1e6);
  if (rate >= 1e4) return fmt::format("{:.0f} k", rate / 1e3);
  return fmt::format("{:.3g} ", rate);
}

}  // namespace

Meter::Meter() : best(std::numeric_limits<double>::infinity()) {}

void Meter::count(const search::Record& record) {
  evaluations.store(record.index + 1, std::memory_order_relaxed);
  if (record.status.ok() && !record.ended_early && record.objective < best.load(std::memory_order_relaxed))
    best.store(record.objective, std::memory_order_relaxed);
}

Progress::Style Progress::style_of_stderr() {
  return text::Terminal::of(STDERR_FILENO).redraws ? Style::bar : Style::lines;
}

Progress::Progress(Style style, const Plan& plan, const std::vector<Meter>& meters, const Share& part)
    : style_(style), line_(text::Terminal::of(STDERR_FILENO)), plan_(plan), meters_(meters), part_(part) {}

void Progress::Spent::add(const Meter& meter, std::uint64_t most) {
  const auto done = meter.evaluations.load(std::memory_order_relaxed);
  evaluations += done;
  budget += meter.finished.load(std::memory_order_relaxed) ? done : std::max(done, most);
}

double Progress::share() const {
  Spent spent;
  for (std::size_t task = 0; task < meters_.size(); ++task)
    if (part_.holds(task)) spent.add(meters_[task], plan_.runs[plan_.tasks[task].run].entry->stop.max_evaluations);
  return spent.share();
}

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::string Progress::text(double seconds, std::size_t columns) const {
  Spent spent;
  std::size_t finished = 0, count = 0, current = meters_.size();
  std::vector<double> best(plan_.runs.size(), std::numeric_limits<double>::infinity());
  for (std::size_t task = 0; task < meters_.size(); ++task) {
    if (!part_.holds(task)) continue;
    ++count;
    const auto& meter = meters_[task];
    const bool over = meter.finished.load(std::memory_order_relaxed);
    const std::size_t run = plan_.tasks[task].run;
    spent.add(meter, plan_.runs[run].entry->stop.max_evaluations);
    finished += over;
    best[run] = std::min(best[run], meter.best.load(std::memory_order_relaxed));
    if (current == meters_.size() && !over && meter.running.load(std::memory_order_relaxed)) current = task;
  }
  const double rate = seconds > 0 ? static_cast<double>(spent.evaluations) / seconds : 0;
  const std::string head =
      fmt::format("{:3.0f} %  {}/{} searches  {}/s", 100 * spent.share(), finished, count, rate_text(rate));
  std::string label, value, left;
  if (current < meters_.size()) {
    const auto run = plan_.tasks[current].run;
    label = plan_.runs[run].label;
    value = std::isfinite(best[run]) ? fmt::format("best {:.6g}", best[run]) : "no success yet";
  }
  // Budget and time are upper bounds, because a search may converge earlier.
  if (rate > 0)
    left = fmt::format("  max {} left", text::clock_text(static_cast<double>(spent.budget - spent.evaluations) / rate));
  if (value.empty()) return head + left;
  // The figures take precedence over the name of the run.
  constexpr std::size_t shortest_label = 4;
  const std::size_t figures = text::columns(head + value + left) + 4;
  const std::size_t room = columns > figures ? columns - figures : 0;
  label = room >= shortest_label ? text::shortened(label, room) + ": " : std::string();
  return fmt::format("{}  {}{}{}", head, label, value, left);
}

void Progress::draw(bool last) {
  if (style_ == Style::none) return;
  const double now = seconds();
  if (style_ == Style::lines) {
    if (last || now - drawn_ < line_interval) return;
    drawn_ = now;
    text::aside("{}\n", text(now));
    return;
  }
  if (last) return line_.clear();
  if (now - drawn_ < bar_interval) return;
  drawn_ = now;
  const std::string line = text(now, line_.room());
  line_.draw(line, std::strtod(line.c_str(), nullptr) / 100);
}

}  // namespace tunica::execution
