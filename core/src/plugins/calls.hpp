// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

/// Which plugin each thread is in. Written before every call, read when something went wrong: by a signal handler in
/// the same thread, and by the watch for calls that do not come back.
namespace tunica::plugins {

using Clock = std::chrono::steady_clock;

/// A call under way. It lives on the stack of the caller.
struct Call {
  /// Entry::plugin of the plugin; null for a whole evaluation, in which plugins are called.
  const char* plugin;
  const char* what;                                       ///< "evaluate"
  std::uint64_t (*key)(const Call&);                      ///< the CallKey; null for a whole evaluation
  const void* input;                                      ///< what `key` reads
  Clock::time_point deadline = Clock::time_point::max();  ///< of a whole evaluation: where max_time ends it
};

/// The calls that a thread is in, the innermost last. Written several times an evaluation, so that no two threads may
/// share a cache line, nor a pair of lines that the machine fetches together.
struct alignas(128) CallsOfThread {
  static constexpr int depth_recorded = 8;  ///< plugins inside plugins; deeper ones count as their caller

  std::atomic<std::uint64_t> entered = 0;  ///< calls so far; one that stays for long is a call that hangs
  std::atomic<int> depth = 0;
  std::array<std::atomic<const Call*>, depth_recorded> stack = {};
};

/// Those of this thread; null where it has called nothing yet.
inline constinit thread_local CallsOfThread* known_calls_of_this_thread = nullptr;
/// Makes them.
CallsOfThread& first_call_of_this_thread();
inline CallsOfThread& calls_of_this_thread() {
  CallsOfThread* const known = known_calls_of_this_thread;
  return known != nullptr ? *known : first_call_of_this_thread();
}
/// Every thread that has called a plugin. Entries stay when a thread ends, and are used again.
std::vector<CallsOfThread*> calls_of_all_threads();
/// Whether an evaluation came to an end. Threads look at it before they write: a line of memory that all of them write
/// at every evaluation would go from one to the other.
inline std::atomic<bool> evaluated = false;
inline void set_evaluated() {
  if (!evaluated.load(std::memory_order_relaxed)) evaluated.store(true, std::memory_order_relaxed);
}
/// Called once by each thread before its first call: gives it a stack to handle signals on.
inline void (*prepare_thread)() = nullptr;

/// Whether this process is a copy of the one that does the work, which a plugin has forked.
inline bool is_copy = false;
/// Ends such a copy silently, because the work does not belong to it.
[[noreturn]] void leave_copy();

/// Marks a call while it lives.
class CallScope {
 public:
  explicit CallScope(const Call& call) : thread_(calls_of_this_thread()) {
    const int depth = thread_.depth.load(std::memory_order_relaxed);
    if (depth < CallsOfThread::depth_recorded)
      thread_.stack[static_cast<std::size_t>(depth)].store(&call, std::memory_order_relaxed);
    thread_.entered.store(thread_.entered.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    thread_.depth.store(depth + 1, std::memory_order_release);
  }
  ~CallScope() {
    if (is_copy) [[unlikely]]
      leave_copy();
    thread_.depth.store(thread_.depth.load(std::memory_order_relaxed) - 1, std::memory_order_release);
    thread_.entered.store(thread_.entered.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  CallScope(const CallScope&) = delete;
  CallScope& operator=(const CallScope&) = delete;

 private:
  CallsOfThread& thread_;
};

/// Where max_time ends the evaluation that this thread is in; the end of time where none does.
Clock::time_point deadline_of_this_thread();

/// The innermost call into a plugin that `thread` is in, or null.
const Call* innermost_plugin_call(const CallsOfThread& thread);

}  // namespace tunica::plugins
