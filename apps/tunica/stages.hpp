// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "text/terminal.hpp"

namespace tunica::app {

/// What long work is doing, on stderr: on a terminal one line that is redrawn, with the time it took and about takes
/// on; elsewhere a plain line a stage. Any thread may tell it. Work that ends within `patience` says nothing.
class Stages {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Stages(bool quiet, Clock::duration patience = {});
  ~Stages();
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;
  /// `share` of the whole that is done, from 0 to 1; none if it is unknown.
  void tell(const std::string& what, std::optional<double> share);

 private:
  void draw();  // with the mutex held
  [[nodiscard]] double seconds() const;
  const text::Terminal terminal_;
  const text::StatusLine line_;
  const bool quiet_;
  const Clock::duration patience_;
  const Clock::time_point begin_ = Clock::now();
  mutable std::mutex mutex_;
  std::condition_variable over_;
  std::string what_, said_;  ///< the stage; the last one that has a plain line
  std::optional<double> share_;
  bool ended_ = false;
  std::thread clock_;  ///< redraws while nothing is told
};

}  // namespace tunica::app
