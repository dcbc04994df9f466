// SPDX-License-Identifier: Apache-2.0
#include "conformance/concurrency.hpp"

#include <algorithm>
#include <atomic>
#include <barrier>
#include <cerrno>
#include <chrono>
#include <exception>
#include <mutex>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

#include <pthread.h>
#include <signal.h>
#include <sys/time.h>
#include <time.h>
#include <ucontext.h>

namespace tunica::conformance {
namespace {

// Of all threads that race; the handler of a signal reaches nothing else.
std::atomic<std::uint64_t> ended_calls = 0;
std::atomic<int> may_sleep = 0;

void doze(int, siginfo_t*, void* context) {
  // A thread sleeps in the middle of its call until others have ended calls meanwhile: on a busy machine a sleep alone
  // may pass while strangers run. Half of the threads are awake; the bound lets go where these wait for one asleep.
  if (--may_sleep >= 0) {
    const int error = errno;
    const std::uint64_t enough = ended_calls + 2;
    const timespec moment{0, 1};  // the shortest sleep there is
    for (int sleeps = 0; sleeps < 100 && ended_calls < enough; ++sleeps) ::nanosleep(&moment, nullptr);
    errno = error;
    // It sleeps once a call, so that it gets on: until it admits the alarm again, others have it.
    ::sigaddset(&static_cast<ucontext_t*>(context)->uc_sigmask, SIGALRM);
  }
  ++may_sleep;
}

/// As long as it lives, threads that admit the alarm are put to sleep every 70 µs, wherever they are in what they do.
class Interruptions {
 public:
  Interruptions() {
    ::sigemptyset(&alarm_);
    ::sigaddset(&alarm_, SIGALRM);
    ::pthread_sigmask(SIG_BLOCK, &alarm_, &mask_);
    struct sigaction action {};
    action.sa_sigaction = doze;
    action.sa_flags = SA_RESTART | SA_SIGINFO;
    ::sigaction(SIGALRM, &action, &before_);
    set(70);
  }
  Interruptions(const Interruptions&) = delete;
  Interruptions& operator=(const Interruptions&) = delete;
  ~Interruptions() {
    set(0);
    forget();  // one that is pending still would be for whoever has the signal afterwards
    ::sigaction(SIGALRM, &before_, nullptr);
    ::pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }
  /// From now on. An alarm that waited would come at once, and always where a call begins.
  void admit() const {
    forget();
    ::pthread_sigmask(SIG_UNBLOCK, &alarm_, nullptr);
  }
  static void stop() { set(0); }

 private:
  static void set(int microseconds) {
    const itimerval every{{0, microseconds}, {0, microseconds}};
    ::setitimer(ITIMER_REAL, &every, nullptr);
  }
  void forget() const {
    const timespec at_once{0, 0};
    while (::sigtimedwait(&alarm_, nullptr, &at_once) > 0) continue;
  }
  sigset_t alarm_{}, mask_{};
  struct sigaction before_ {};
};

}  // namespace

Race race_threads(std::size_t count, const std::function<bool(std::size_t)>& agrees, double seconds) {
  const std::size_t threads = std::max<std::size_t>(8, 2 * std::thread::hardware_concurrency());
  std::atomic<bool> over = false;
  std::mutex guard;
  Race race;
  race.threads = threads;
  ended_calls = 0;
  may_sleep = static_cast<int>(threads / 2);
  std::exception_ptr thrown;
  const Interruptions interruptions;
  // Time of the processors, so that the race is no shorter on a machine that is busy with other work.
  const auto worked = [] {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  const double enough = worked() + seconds * std::max(1u, std::thread::hardware_concurrency());
  // Threads that wait, for a lock or for another program, hardly work.
  const auto latest = std::chrono::steady_clock::now() + std::chrono::duration<double>(20 * seconds);
  std::barrier begin(static_cast<std::ptrdiff_t>(threads));
  const auto run = [&](std::size_t thread) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::mt19937 engine(static_cast<std::uint32_t>(thread));
    std::shuffle(order.begin(), order.end(), engine);
    begin.arrive_and_wait();
    try {
      do {
        for (const std::size_t input : order) {
          if (over) return;
          interruptions.admit();
          const bool agreed = agrees(input);
          ++ended_calls;
          if (agreed) continue;
          const std::lock_guard lock(guard);
          over = race.lost = true;
          race.input = input;
          return;
        }
      } while (worked() < enough && std::chrono::steady_clock::now() < latest);
      Interruptions::stop();  // the last ones are not kept from their end
    } catch (...) {
      const std::lock_guard lock(guard);
      over = true;
      thrown = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> all;
    for (std::size_t thread = 0; thread < threads; ++thread) all.emplace_back(run, thread);
  }
  race.calls = ended_calls;
  if (thrown && !race.lost) std::rethrow_exception(thrown);
  return race;
}

}  // namespace tunica::conformance
