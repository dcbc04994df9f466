// SPDX-License-Identifier: Apache-2.0
#include "conformance/concurrency.hpp"

#include <algorithm>
#include <atomic>
#include <barrier>
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

namespace tunica::conformance {
namespace {

thread_local timespec awake_since{};

void doze(int) {
  // A thread that is woken late would find the next alarm waiting, and never get on: it works a while between two.
  constexpr long while_ns = 100'000;
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  if ((now.tv_sec - awake_since.tv_sec) * 1'000'000'000 + now.tv_nsec - awake_since.tv_nsec < while_ns) return;
  // The shortest sleep there is: another thread goes on meanwhile.
  const timespec moment{0, 1};
  ::nanosleep(&moment, nullptr);
  ::clock_gettime(CLOCK_MONOTONIC, &awake_since);
}

/// As long as it lives, threads that admit the alarm are put to sleep every 70 µs, wherever they are in what they do.
class Interruptions {
 public:
  Interruptions() {
    ::sigemptyset(&alarm_);
    ::sigaddset(&alarm_, SIGALRM);
    ::pthread_sigmask(SIG_BLOCK, &alarm_, &mask_);
    struct sigaction action {};
    action.sa_handler = doze;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGALRM, &action, &before_);
    set(70);
  }
  Interruptions(const Interruptions&) = delete;
  Interruptions& operator=(const Interruptions&) = delete;
  ~Interruptions() {
    set(0);
    // One that is pending still would be for whoever has the signal afterwards.
    const timespec at_once{0, 0};
    while (::sigtimedwait(&alarm_, nullptr, &at_once) > 0) continue;
    ::sigaction(SIGALRM, &before_, nullptr);
    ::pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }
  void admit() const { ::pthread_sigmask(SIG_UNBLOCK, &alarm_, nullptr); }
  static void stop() { set(0); }

 private:
  static void set(int microseconds) {
    const itimerval every{{0, microseconds}, {0, microseconds}};
    ::setitimer(ITIMER_REAL, &every, nullptr);
  }
  sigset_t alarm_{}, mask_{};
  struct sigaction before_ {};
};

}  // namespace

Race race_threads(std::size_t count, const std::function<bool(std::size_t)>& agrees, double seconds) {
  const std::size_t threads = std::max<std::size_t>(8, 2 * std::thread::hardware_concurrency());
  std::atomic<bool> over = false;
  std::atomic<std::uint64_t> calls = 0;
  std::mutex guard;
  Race race;
  race.threads = threads;
  std::exception_ptr thrown;
  const Interruptions interruptions;
  std::barrier begin(static_cast<std::ptrdiff_t>(threads));
  const auto run = [&](std::size_t thread) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::mt19937 engine(static_cast<std::uint32_t>(thread));
    std::shuffle(order.begin(), order.end(), engine);
    begin.arrive_and_wait();
    interruptions.admit();
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    try {
      do {
        for (const std::size_t input : order) {
          if (over) return;
          ++calls;
          if (agrees(input)) continue;
          const std::lock_guard lock(guard);
          over = race.lost = true;
          race.input = input;
          return;
        }
      } while (std::chrono::steady_clock::now() < end);
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
  race.calls = calls;
  if (thrown && !race.lost) std::rethrow_exception(thrown);
  return race;
}

}  // namespace tunica::conformance
