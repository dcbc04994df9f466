// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "text/terminal.hpp"

namespace tunica::app {

/// What a diagnosis is doing, on stderr: on a terminal one line that is redrawn, with the time it took and about takes
/// on; elsewhere a plain line a stage. Any thread may tell it.
class Stages {
 public:
  explicit Stages(bool quiet);
  ~Stages();
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;
  void tell(const std::string& what, double share);

 private:
  void draw() const;  // with the mutex held
  using Clock = std::chrono::steady_clock;
  const text::Terminal terminal_;
  const text::StatusLine line_;
  const bool quiet_;
  const Clock::time_point begin_ = Clock::now();
  mutable std::mutex mutex_;
  std::condition_variable over_;
  std::string what_;
  double share_ = 0;
  bool ended_ = false;
  std::thread clock_;  ///< redraws while nothing is told
};

}  // namespace tunica::app
