// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <exception>
#include <mutex>

namespace tunica::execution {

/// Keeps the first exception of jobs that run side by side, for after all of them. An exception that leaves a loop of
/// TBB cancels the loops inside its other jobs, wherever they are, without a word to them: they would take half of
/// their numbers for the whole.
class FirstFailure {
 public:
  /// Runs a job; nothing leaves it.
  template <class Job>
  void guard(Job&& job) {
    try {
      job();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!first_) first_ = std::current_exception();
      any_ = true;
    }
  }
  [[nodiscard]] bool any() const { return any_; }
  /// Throws what was kept, if there is something.
  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr first_;
  std::atomic<bool> any_ = false;
};

}  // namespace tunica::execution
