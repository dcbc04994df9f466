// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace tunica::execution {

/// Ctrl-C (SIGINT) and SIGTERM while this object lives: the first one raises a flag, so that the run can save and
/// leave; a second one does what it would have done without us, and ends the process. A file-size limit is reported as
/// a failed write instead of killing the process. Afterwards signals do what they did before. One object at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  [[nodiscard]] static bool interrupted();
  /// Raises the flag as Ctrl-C does, for whoever is asked between two signals.
  static void interrupt();
};

/// While this object lives: where something takes longer than half a second to stop after Ctrl-C, such as a simulation
/// with finite elements, `leave` is called by a thread of its own. It is expected to end the process; what is on disk
/// by then is what a killed run leaves, and resuming it gives the identical result.
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
