// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

/// When a plugin kills its process, this records the fatal call for the next process.
namespace tunica::plugins {

/// From here on, signals that end the process (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) and a plugin's exit() are
/// entered into `casualties` first. Overflow of the stack too: each thread that calls plugins handles signals on a
/// stack of its own. Call it before plugins are loaded, and again afterwards: what they register runs at exit in
/// reverse.
void leave_last_words();

/// Exit code of a process that was ended because of an entry in `casualties`.
constexpr int fell = 70;

/// For replacements of _exit(): records the plugin that this thread is in, if any. False in processes that a plugin has
/// forked, because their end does not end the work.
bool enter_exit_in_plugin(const char* end);

/// Bytes that a process may have: of the machine, of its control group, of its own limits.
double memory_limit();

/// While it lives: a call that does not come back is entered into `casualties`, and the process ends. That is
/// - a call of a model that takes longer than `longest_model_call`: a batch takes milliseconds;
/// - once max_time has passed for `grace`, a call of a model that has lasted as long, and one of a test that has lasted
///   ten times as long as any before it. A first prediction may be that of a slow solver: it has `first_prediction`.
/// - a call during which the memory of the process has come to its limit. Where no call can be blamed alone, as for a
/// leak
///   of many, the process ends as well, and the next one takes up the work with its memory free.
class CallWatch {
 public:
  struct Limits {
    std::chrono::duration<double> longest_model_call{60}, grace{1}, first_prediction{600};
    double memory = 0.9 * memory_limit();                                    ///< bytes
    double memory_of_model = std::min(0.25 * memory, 1024.0 * 1024 * 1024);  ///< bytes that a call of a model may take
  };
  explicit CallWatch(Limits limits);
  ~CallWatch();
  CallWatch(const CallWatch&) = delete;
  CallWatch& operator=(const CallWatch&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace tunica::plugins
