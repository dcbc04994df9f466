// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "execution/plan.hpp"
#include "execution/share.hpp"
#include "text/terminal.hpp"

namespace tunica::execution {

/// Counters of one realisation, written by the thread that runs it and read by the display.
struct alignas(64) Meter {
  std::atomic<std::uint64_t> evaluations = 0;
  std::atomic<double> best;  ///< infinity until something succeeded
  std::atomic<bool> running = false, finished = false;
  Meter();
  void count(const search::Record& record);
};

/// The progress display on stderr: one redrawn line on a terminal, elsewhere a plain line every few seconds. Only one
/// thread calls it.
class Progress {
 public:
  enum class Style { none, lines, bar };
  /// The style for the current stderr: a bar on a terminal that can redraw a line, else lines.
  static Style style_of_stderr();

  Progress(Style style, const Plan& plan, const std::vector<Meter>& meters, const Share& part = {});
  /// Draws if it is due; `last` removes the bar from the screen.
  void draw(bool last = false);
  /// The line after this many seconds: share of the budget, finished searches, rate, best value, time left. If it would
  /// be wider than `columns`, the name of the run is shortened.
  [[nodiscard]] std::string text(double seconds, std::size_t columns = 1000) const;
  /// The share of the budget that is spent, from 0 to 1.
  [[nodiscard]] double share() const;
  /// Since the beginning, s.
  [[nodiscard]] double seconds() const;

 private:
  struct Spent {
    std::uint64_t evaluations = 0, budget = 0;
    [[nodiscard]] double share() const {
      return budget > 0 ? static_cast<double>(evaluations) / static_cast<double>(budget) : 1;
    }
    void add(const Meter& meter, std::uint64_t most);
  };
  Style style_;
  text::StatusLine line_;
  const Plan& plan_;
  const std::vector<Meter>& meters_;
  const Share part_;  ///< of the searches that this process runs
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double drawn_ = 0;  ///< s since the beginning
};

}  // namespace tunica::execution
