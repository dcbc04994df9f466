// SPDX-License-Identifier: Apache-2.0
#include "plugins/calls.hpp"

#include <algorithm>
#include <deque>
#include <mutex>

#include <sys/syscall.h>
#include <unistd.h>

namespace tunica::plugins {

namespace {

/// Never destroyed: threads may end after the statics are gone.
struct Register {
  std::mutex mutex;
  std::deque<CallsOfThread> all;
  std::vector<CallsOfThread*> free;
};
Register& threads() {
  static auto& only = *new Register();
  return only;
}

/// Returns the entry when the thread ends. If it is destroyed during a call, the plugin has called exit(), which
/// destroys thread-local objects first.
struct Lease {
  ~Lease() {
    CallsOfThread*& mine = known_calls_of_this_thread;
    if (mine->depth > 0) return;
    const std::lock_guard lock(threads().mutex);
    threads().free.push_back(mine);
    mine = nullptr;
  }
};

}  // namespace

CallsOfThread& first_call_of_this_thread() {
  CallsOfThread*& mine = known_calls_of_this_thread;
  {
    Register& all = threads();
    const std::lock_guard lock(all.mutex);
    if (all.free.empty()) {
      mine = &all.all.emplace_back();
    } else {
      mine = all.free.back();
      all.free.pop_back();
    }
    mine->depth = 0;
  }
  [[maybe_unused]] static thread_local const Lease held;
  if (prepare_thread != nullptr) prepare_thread();
  return *mine;
}

std::vector<CallsOfThread*> calls_of_all_threads() {
  Register& all = threads();
  const std::lock_guard lock(all.mutex);
  std::vector<CallsOfThread*> found;
  for (CallsOfThread& thread : all.all) found.push_back(&thread);
  return found;
}

Clock::time_point deadline_of_this_thread() {
  const CallsOfThread& thread = calls_of_this_thread();
  const int depth = std::min(thread.depth.load(std::memory_order_relaxed), CallsOfThread::depth_recorded);
  auto first = Clock::time_point::max();
  for (int i = 0; i < depth; ++i)
    if (const Call* call = thread.stack[static_cast<std::size_t>(i)].load(std::memory_order_relaxed); call != nullptr)
      first = std::min(first, call->deadline);
  return first;
}

void leave_copy() {
  for (;;) ::syscall(SYS_exit_group, 0);
}

const Call* innermost_plugin_call(const CallsOfThread& thread) {
  const int depth = std::min(thread.depth.load(std::memory_order_acquire), CallsOfThread::depth_recorded);
  for (int i = depth - 1; i >= 0; --i) {
    const Call* call = thread.stack[static_cast<std::size_t>(i)].load(std::memory_order_relaxed);
    if (call != nullptr && call->plugin != nullptr) return call;
  }
  return nullptr;
}

}  // namespace tunica::plugins
