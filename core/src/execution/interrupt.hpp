// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace tunica::execution {

/// Handles Ctrl-C (SIGINT) and SIGTERM while this object lives. The first signal raises a flag, and the run saves and
/// stops. A second signal has its previous effect and ends the process. A file-size limit is reported as a failed write
/// instead of killing the process. The destructor restores the previous handlers. Only one object may exist at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  [[nodiscard]] static bool interrupted();
  /// Raises the flag as Ctrl-C does, for callers that are asked to stop without a signal.
  static void interrupt();
};

/// While this object lives, a separate thread calls `leave` if the work has not stopped half a second after Ctrl-C, for
/// example in a finite-element simulation. `leave` must end the process. The disk then holds what a killed run leaves,
/// and resuming gives the identical result.
class InterruptLimit {
 public:
  explicit InterruptLimit(std::function<void()> leave);
  ~InterruptLimit();
  InterruptLimit(const InterruptLimit&) = delete;
  InterruptLimit& operator=(const InterruptLimit&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable over_;
  bool ended_ = false;
  std::thread watch_;
};

}  // namespace tunica::execution
