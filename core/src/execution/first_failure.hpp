// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <exception>
#include <mutex>

namespace tunica::execution {

/// Keeps the first exception of parallel jobs until all jobs have ended. An exception that leaves a TBB loop silently
/// cancels the inner loops of its other jobs. These jobs would then take incomplete results for complete ones.
class FirstFailure {
 public:
  /// Runs a job; no exception leaves it.
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
  /// Throws the kept exception, if there is one.
  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr first_;
  std::atomic<bool> any_ = false;
};

}  // namespace tunica::execution
