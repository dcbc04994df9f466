// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

/// What this project uses of TBB, on threads of the standard library: for builds under ThreadSanitizer alone. Debian's
/// TBB is not instrumented, so the sanitizer cannot see how it hands work over. To suppress those false alarms would
/// hide real races.
///
/// Nothing here orders one pass of a loop before another: only the begin and the end of a thread do. Else a race would
/// show only between passes that overlap in time.
namespace tbb {

/// The threads that loops begin beside their own; nested loops share them.
class Crew {
 public:
  static Crew& instance() {
    static Crew crew;
    return crew;
  }
  void limit(std::size_t threads) {
    const std::lock_guard lock(mutex_);
    limits_.insert(threads);
    limit_.store(std::max<std::size_t>(*limits_.begin(), 1), std::memory_order_relaxed);
  }
  void unlimit(std::size_t threads) {
    const std::lock_guard lock(mutex_);
    limits_.erase(limits_.find(threads));
    limit_.store(limits_.empty() ? otherwise : std::max<std::size_t>(*limits_.begin(), 1), std::memory_order_relaxed);
  }
  [[nodiscard]] std::size_t limit() const { return limit_.load(std::memory_order_relaxed); }
  /// `wanted` threads, or as many as are left. The caller must return them.
  std::size_t take(std::size_t wanted) {
    const std::size_t most = limit() - 1;
    std::size_t busy = busy_.load(std::memory_order_relaxed), taken = 0;
    do {
      taken = std::min(wanted, most - std::min(most, busy));
    } while (!busy_.compare_exchange_weak(busy, busy + taken, std::memory_order_relaxed));
    return taken;
  }
  void give_back(std::size_t threads) { busy_.fetch_sub(threads, std::memory_order_relaxed); }

 private:
  static constexpr std::size_t otherwise = 4;  ///< more than two cores find more
  std::mutex mutex_;
  std::multiset<std::size_t> limits_;
  std::atomic<std::size_t> limit_ = otherwise, busy_ = 0;
};

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t threads) : threads_(threads) { Crew::instance().limit(threads); }
  ~global_control() { Crew::instance().unlimit(threads_); }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;

 private:
  std::size_t threads_;
};

class task_arena {
 public:
  explicit task_arena(int threads) : threads_(static_cast<std::size_t>(threads)) {}
  template <class Function>
  decltype(auto) execute(Function&& function) {
    const global_control limit(global_control::max_allowed_parallelism, threads_);
    return function();
  }

 private:
  std::size_t threads_;
};

namespace this_task_arena {
inline int max_concurrency() { return static_cast<int>(Crew::instance().limit()); }
/// A thread that waits here takes up nothing else.
template <class Function>
decltype(auto) isolate(Function&& function) {
  return function();
}
}  // namespace this_task_arena

namespace info {
inline int default_concurrency() { return static_cast<int>(std::thread::hardware_concurrency()); }
}  // namespace info

struct simple_partitioner {};

template <class Index>
class blocked_range {
 public:
  blocked_range(Index begin, Index end, std::size_t = 1) : begin_(begin), end_(end) {}
  Index begin() const { return begin_; }
  Index end() const { return end_; }

 private:
  Index begin_, end_;
};

/// The first exception ends the loop and is thrown again by it.
template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body, simple_partitioner = {}) {
  if (!(first < last)) return;
  std::atomic<Index> next = first;
  std::atomic<bool> failed = false;
  std::exception_ptr problem;
  std::mutex mutex;
  const auto work = [&] {
    const auto take = [&] { return next.fetch_add(1, std::memory_order_relaxed); };
    for (Index k = take(); k < last && !failed.load(std::memory_order_relaxed); k = take()) {
      try {
        body(k);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failed.exchange(true, std::memory_order_relaxed)) problem = std::current_exception();
      }
    }
  };
  const std::size_t helpers = Crew::instance().take(static_cast<std::size_t>(last - first) - 1);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < helpers; ++k) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  Crew::instance().give_back(helpers);
  if (problem) std::rethrow_exception(problem);
}

template <class Index, class Body>
void parallel_for(const blocked_range<Index>& range, const Body& body, simple_partitioner = {}) {
  parallel_for(range.begin(), range.end(), [&](Index k) { body(blocked_range<Index>(k, k + 1)); });
}

}  // namespace tbb

namespace oneapi {
namespace tbb = ::tbb;
}
