// SPDX-License-Identifier: Apache-2.0
#include "plugins/last_words.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <csetjmp>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include "plugins/calls.hpp"
#include "plugins/casualties.hpp"
#include "plugins/images.hpp"
#include "plugins/signal_stack.hpp"

namespace tunica::plugins {

namespace {

struct Fatal {
  int number;
  const char* end;
};
constexpr std::array<Fatal, 5> fatal{{{SIGSEGV, "ended the program with a segmentation fault (SIGSEGV)"},
                                      {SIGBUS, "ended the program with a bus error (SIGBUS)"},
                                      {SIGFPE, "ended the program with an arithmetic fault (SIGFPE)"},
                                      {SIGILL, "ended the program with an illegal instruction (SIGILL)"},
                                      {SIGABRT, "aborted the program (SIGABRT)"}}};

pid_t process_of_work = 0;

/// Whether this thread is in a plugin, which then is the culprit: in a call, or in a thread that the plugin has made.
bool enter_culprit(const char* end) {
  if (casualties == nullptr || ::getpid() != process_of_work) return false;
  const CallsOfThread* thread = known_calls_of_this_thread;
  if (const Call* call = thread == nullptr ? nullptr : innermost_plugin_call(*thread); call != nullptr) {
    casualties->add(call->key(*call), call->plugin, call->what, end, 0);
    return true;
  }
  const char* const plugin = plugin_on_the_stack();
  if (plugin != nullptr) casualties->add(0, plugin, own_thread, end, 0, CasualtyList::weight_of_thread);
  return plugin != nullptr;
}

/// Where the watch goes on when what it reads is no longer mapped; null while it reads nothing of other threads.
std::atomic<sigjmp_buf*> way_back = nullptr;
std::atomic<pid_t> reader = 0;

/// Ends the process as it would have ended without us. To go back would repeat the instruction, which may succeed now:
/// the list is open to be written to.
void on_fatal(int number, siginfo_t*, void*) {
  if (sigjmp_buf* const to = way_back.load(); to != nullptr && ::gettid() == reader.load()) siglongjmp(*to, 1);
  for (const Fatal& signal : fatal)
    if (signal.number == number) enter_culprit(signal.end);
  std::signal(number, SIG_DFL);
  std::raise(number);
}

void on_exit_in_plugin() {
  if (enter_exit_in_plugin("called exit()")) ::_exit(fell);
}

/// So that an overflow of a thread's own stack can be told.
void give_signal_stack() { [[maybe_unused]] static thread_local const SignalStack stack; }

using Seconds = std::chrono::duration<double>;

constexpr double gibibyte = 1024.0 * 1024 * 1024;

/// Bytes of this process that are in memory; 0 where the system does not tell.
double resident_memory() {
  std::ifstream stream("/proc/self/statm");
  double all = 0, resident = 0;
  return stream >> all >> resident ? resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) : 0;
}

/// "max" where the group has no limit of its own.
double limit_in(const char* file) {
  std::ifstream stream(file);
  double value = 0;
  return stream >> value && value > 0 ? value : std::numeric_limits<double>::infinity();
}

double limit_of(int resource) {
  rlimit limit{};
  const bool known = ::getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0;
  return known && limit.rlim_cur != RLIM_INFINITY ? static_cast<double>(limit.rlim_cur)
                                                  : std::numeric_limits<double>::infinity();
}

bool is_of_model(const Call& call) {
  return call.what == std::string_view("evaluate") || call.what == std::string_view("evaluate_axes") ||
         call.what == std::string_view("solve_strip");
}

/// Of a factory, a destructor, or what an object is asked about itself. A factory may ask a server or mesh a tube.
constexpr double patience_with_objects = 10;

constexpr int of_model = 2;

/// 2: of a model, 1: of a test, 0: of something that calls both.
int kind_of(const Call& call) {
  if (is_of_model(call)) return of_model;
  return call.what == std::string_view("predict") ? 1 : 0;
}

/// Reads what lies on the stacks of other threads, which go on meanwhile; false where it is no longer mapped.
template <class Read>
bool read_of_others(const Read& read) {
  sigjmp_buf here;
  if (sigsetjmp(here, 1) != 0) {
    way_back = nullptr;
    return false;
  }
  reader = ::gettid();
  way_back = &here;
  read();
  way_back = nullptr;
  return true;
}

bool is_in_plugin(const CallsOfThread& thread) {
  bool inside = false;
  return read_of_others([&] { inside = innermost_plugin_call(thread) != nullptr; }) && inside;
}

/// What is told of the innermost call of a thread.
struct Sight {
  std::array<char, 96> plugin = {};
  const char* what = nullptr;
  int kind = 0;
  std::uint64_t key = 0;
};

bool is_of_object(const Sight& call) {
  constexpr std::array<std::string_view, 5> names{"create", "destroy", "describe", "rows", "needs"};
  return std::find(names.begin(), names.end(), call.what) != names.end();
}

/// A call that comes back leaves its stack to the next one, and may give back what it was asked with: all is copied,
/// and counts only if the thread has entered and left nothing since it had `entered` so many.
std::optional<Sight> sight_of(const CallsOfThread& thread, std::uint64_t entered) {
  Sight sight;
  const bool read = read_of_others([&] {
    const Call* call = innermost_plugin_call(thread);
    if (call == nullptr) return;
    const Call copy = *call;
    std::atomic_thread_fence(std::memory_order_acquire);
    if (thread.entered.load(std::memory_order_relaxed) != entered) return;
    for (std::size_t i = 0; i + 1 < sight.plugin.size() && copy.plugin[i] != 0; ++i) sight.plugin[i] = copy.plugin[i];
    sight.kind = kind_of(copy);
    sight.key = copy.key(copy);
    sight.what = copy.what;
  });
  std::atomic_thread_fence(std::memory_order_acquire);
  if (!read || sight.what == nullptr || thread.entered.load(std::memory_order_relaxed) != entered) return std::nullopt;
  return sight;
}

/// A thread as the watch sees it.
struct Watched {
  CallsOfThread* thread;
  std::uint64_t entered = 0;
  Clock::time_point since = Clock::now();
  double memory = 0;  ///< bytes that the process had at the last look before the call
};

/// Looks at calls of other threads while they go on.
class Inspection {
 public:
  explicit Inspection(CallWatch::Limits limits) : limits_(limits) {}

  void look() {
    const auto now = Clock::now();
    const auto threads = calls_of_all_threads();
    const double memory = resident_memory();
    for (std::size_t i = watched_.size(); i < threads.size(); ++i) watched_.push_back({threads[i]});
    for (Watched& one : watched_) look_at(one, now);
    const bool grows = memory > memory_before_;
    memory_before_ = memory;
    if (memory > limits_.memory && was_over_) end_for_want_of_memory(memory, now);
    if (grows) end_model_without_end(memory, now);
    was_over_ = memory > limits_.memory;  // the next look tells calls that stay from those that come and go
  }
  /// What grows to its limit in less than a second is looked at more often.
  [[nodiscard]] std::chrono::milliseconds heartbeat() const {
    return std::chrono::milliseconds(resident_memory() > 0.5 * limits_.memory ? 10 : 100);
  }

 private:
  void look_at(Watched& one, Clock::time_point now) {
    const std::uint64_t entered = one.thread->entered.load(std::memory_order_acquire);
    const Seconds stayed = now - one.since;
    if (entered != one.entered || one.thread->depth.load(std::memory_order_acquire) == 0) {
      if (evaluated.load(std::memory_order_relaxed)) longest_ = std::max(longest_, stayed);
      one.entered = entered;
      one.since = now;
      one.memory = memory_before_;
      return;
    }
    if (stayed < limits_.grace) return;
    const auto call = sight_of(*one.thread, entered);
    if (!call) return;
    const bool too_long = (call->kind == of_model && stayed > limits_.longest_model_call) ||
                          (is_of_object(*call) && stayed > patience_with_objects * limits_.longest_model_call);
    const bool late = now > deadline(*one.thread) + std::chrono::duration_cast<Clock::duration>(limits_.grace);
    if (!too_long && !(late && stayed > patience(*call))) return;
    const std::string end = too_long ? fmt::format("did not come back within {:.3g} s", stayed.count())
                                     : fmt::format("did not come back for {:.3g} s, beyond max_time", stayed.count());
    casualties->add(call->key, call->plugin.data(), call->what, end.c_str(), stayed.count());
    ::_exit(fell);
  }

  /// A batch of a model takes kilobytes. One that has come to `memory_of_model` takes the rest as well, and is ended
  /// before the machine suffers: where no call into a model of another plugin lasts.
  void end_model_without_end(double memory, Clock::time_point now) {
    std::vector<Sight> suspects;
    for (const Watched& one : watched_) {
      if (one.since == now || memory - one.memory < limits_.memory_of_model || !is_in_plugin(*one.thread)) continue;
      const auto call = sight_of(*one.thread, one.entered);
      if (call && call->kind == of_model) suspects.push_back(*call);
    }
    if (suspects.empty() || !is_of_one_plugin(suspects)) return;
    end_with(suspects, fmt::format("took the memory of the program to {:.3g} GiB in a call of a model, which may take "
                                   "{:.3g} GiB, a quarter of --memory-limit,",
                                   memory / gibibyte, limits_.memory_of_model / gibibyte));
  }

  static bool is_of_one_plugin(const std::vector<Sight>& calls) {
    return std::all_of(calls.begin(), calls.end(),
                       [&](const Sight& one) { return one.plugin == calls.front().plugin; });
  }

  [[noreturn]] static void end_with(const std::vector<Sight>& culprits, const std::string& end) {
    unsigned weight = CasualtyList::weight_of_memory;  // of all together
    for (const Sight& one : culprits)
      casualties->add(one.key, one.plugin.data(), one.what, end.c_str(), 0, std::exchange(weight, 0U));
    ::_exit(fell);
  }

  /// A call is to blame where half of the limit came while it lasted, and while no call of its kind into another plugin
  /// did. A search lasts as long as what it waits for, so a test comes before it, and a model before both. Work that
  /// needs so much without a plugin is not ended: it is told by std::bad_alloc.
  void end_for_want_of_memory(double memory, Clock::time_point now) {
    std::vector<Sight> suspects;
    bool inside = false;
    for (const Watched& one : watched_) {
      if (!is_in_plugin(*one.thread)) continue;
      inside = true;
      if (one.since == now || memory - one.memory < 0.5 * limits_.memory) continue;
      const auto call = sight_of(*one.thread, one.entered);
      if (!call || (!suspects.empty() && call->kind < suspects.front().kind)) continue;
      if (!suspects.empty() && call->kind > suspects.front().kind) suspects.clear();
      suspects.push_back(*call);
    }
    if (!inside) return;
    if (!suspects.empty() && is_of_one_plugin(suspects))
      end_with(suspects, fmt::format("took the memory of the program to {:.3g} GiB, and {:.3g} GiB are allowed,",
                                     memory / gibibyte, limits_.memory / gibibyte));
    casualties->add_leak();
    ::_exit(fell);
  }

  [[nodiscard]] Seconds patience(const Sight& call) const {
    if (call.kind == of_model) return limits_.grace;
    if (!evaluated.load(std::memory_order_relaxed)) return limits_.first_prediction;
    return std::max<Seconds>(limits_.grace, 10 * longest_);
  }

  static Clock::time_point deadline(const CallsOfThread& thread) {
    const int depth = std::min(thread.depth.load(std::memory_order_acquire), CallsOfThread::depth_recorded);
    auto first = Clock::time_point::max() - std::chrono::hours(1);
    read_of_others([&] {
      for (int i = 0; i < depth; ++i) {
        const Call* call = thread.stack[static_cast<std::size_t>(i)].load(std::memory_order_relaxed);
        if (call != nullptr) first = std::min(first, call->deadline);
      }
    });
    return first;
  }

  CallWatch::Limits limits_;
  double memory_before_ = resident_memory();  ///< bytes, at the last look
  bool was_over_ = false;                     ///< the limit of memory, at the last look
  Seconds longest_{0};                        ///< that a call has stayed, as far as it was seen
  std::vector<Watched> watched_;
};

}  // namespace

double memory_limit() {
  const double machine = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return std::min({machine, limit_in("/sys/fs/cgroup/memory.max"),
                   limit_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"), limit_of(RLIMIT_AS),
                   limit_of(RLIMIT_DATA)});
}

bool enter_exit_in_plugin(const char* end) { return enter_culprit(end); }

/// A fork within a call of a plugin is the plugin's own.
void note_copy() {
  const CallsOfThread* thread = known_calls_of_this_thread;
  is_copy = thread != nullptr && innermost_plugin_call(*thread) != nullptr;
}

void leave_last_words() {
  if (casualties == nullptr) return;
  [[maybe_unused]] static const int registered = ::pthread_atfork(nullptr, nullptr, note_copy);
  process_of_work = ::getpid();
  prepare_thread = give_signal_stack;
  give_signal_stack();
  for (const Fatal& signal : fatal) {
    struct sigaction action = {};
    action.sa_sigaction = on_fatal;
    action.sa_flags = SA_ONSTACK | SA_NODEFER | SA_SIGINFO;
    ::sigaction(signal.number, &action, nullptr);
  }
  // Timers and limits that a plugin sets would end the work. A write beyond a limit then fails with words.
  for (const int number : {SIGALRM, SIGVTALRM, SIGPROF, SIGXFSZ}) {
    struct sigaction before = {};
    if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) std::signal(number, SIG_IGN);
  }
  // One for each thread that may call exit() while another one does: a thread that finds none left ends the process.
  for (int thread = 0; thread < 64; ++thread)
    if (std::atexit(on_exit_in_plugin) != 0 || std::at_quick_exit(on_exit_in_plugin) != 0) break;  // memory lacks
}

CallWatch::CallWatch(Limits limits) {
  if (casualties == nullptr) return;
  thread_ = std::thread([this, limits] {
    Inspection inspection(limits);
    for (std::unique_lock lock(mutex_); !wake_.wait_for(lock, inspection.heartbeat(), [this] { return over_; });)
      inspection.look();
  });
}

CallWatch::~CallWatch() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

}  // namespace tunica::plugins
