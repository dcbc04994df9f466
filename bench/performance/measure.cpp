// SPDX-License-Identifier: Apache-2.0
#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace tunica::bench {
namespace {

double now(Clock clock) {
  timespec at{};
  clock_gettime(clock == Clock::thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &at);
  return static_cast<double>(at.tv_sec) + 1e-9 * static_cast<double>(at.tv_nsec);
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}
double median(const std::vector<double>& values) { return quantile(values, 0.5); }

/// Work with the number of calls that makes a sample long enough for the clock.
class Sampled {
 public:
  Sampled(const Work& work, Clock clock, double sample) : work_(work), clock_(clock) {
    const double first = time();  // memory and caches
    while (first < sample) {
      const double seconds = time();
      if (seconds >= sample || calls_ > (1ULL << 40)) break;
      calls_ = seconds <= 0 ? calls_ * 16
                            : std::min(calls_ * 16, static_cast<std::size_t>(std::ceil(
                                                        1.2 * static_cast<double>(calls_) * sample / seconds)));
    }
  }
  /// Seconds a unit, of one sample.
  double operator()() const { return time() / (static_cast<double>(calls_) * work_.per_call); }
  [[nodiscard]] double last() const { return last_; }

 private:
  double time() const {
    const double begin = now(clock_);
    for (std::size_t k = 0; k < calls_; ++k) work_.call();
    return last_ = now(clock_) - begin;
  }
  const Work& work_;
  Clock clock_;
  std::size_t calls_ = 1;
  mutable double last_ = 0;
};

/// Slope of ln t over ln n.
double exponent(const std::vector<std::pair<std::size_t, double>>& growth) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [size, seconds] : growth) {
    const double a = std::log(static_cast<double>(size)), b = std::log(seconds);
    x += a, y += b, xx += a * a, xy += a * b;
  }
  const auto n = static_cast<double>(growth.size());
  return (xy - x * y / n) / (xx - x * x / n);
}

}  // namespace

Measured measure(const Row& row, const Effort& effort) {
  Measured measured;
  {
    Prepared prepared = row.make(row.sizes.front());
    if (!effort.floors) prepared.floors.clear(), prepared.peers.clear();
    const Sampled work(prepared.work, row.clock, effort.sample);
    std::vector<Sampled> floors;  // and peers behind them
    for (const auto* list : {&prepared.floors, &prepared.peers})
      for (const Floor& floor : *list) floors.emplace_back(floor.work, row.clock, effort.sample);
    std::vector<double>& times = measured.samples;
    std::vector<std::vector<double>> bounds(floors.size()), ratios(floors.size());
    const std::size_t least = work.last() > 1.5 ? 1 : 3;  // of work that takes seconds one sample says enough
    double spent = 0;
    for (std::size_t round = 0; round < effort.rounds && (round < least || (least > 1 && spent < effort.most));
         ++round) {
      times.push_back(work());
      spent += work.last();
      for (std::size_t k = 0; k < floors.size(); ++k) {
        bounds[k].push_back(floors[k]());
        ratios[k].push_back(times.back() / bounds[k].back());
        spent += floors[k].last();
      }
    }
    measured.repeats = times.size();
    measured.time.median = median(times);
    measured.time.spread = (quantile(times, 0.75) - quantile(times, 0.25)) / 2 / measured.time.median;
    for (std::size_t k = 0; k < floors.size(); ++k) {
      const bool peer = k >= prepared.floors.size();
      const Floor& floor = peer ? prepared.peers[k - prepared.floors.size()] : prepared.floors[k];
      (peer ? measured.peers : measured.floors)
          .push_back({floor.what, floor.level, median(bounds[k]), median(ratios[k])});
    }
    measured.facts = prepared.facts;
    measured.growth.emplace_back(row.sizes.front(), measured.time.median * prepared.work.per_call);
  }
  if (!effort.all_sizes || row.sizes.size() < 3) return measured;
  for (std::size_t k = 1; k < row.sizes.size(); ++k) {
    const Prepared prepared = row.make(row.sizes[k]);
    const Sampled work(prepared.work, row.clock, effort.sample);
    std::vector<double> times;
    double spent = 0;
    for (std::size_t round = 0; round < std::min<std::size_t>(effort.rounds, 7) && (round < 1 || spent < effort.most);
         ++round) {
      times.push_back(work() * prepared.work.per_call);
      spent += work.last();
    }
    measured.growth.emplace_back(row.sizes[k], median(times));
  }
  std::ranges::sort(measured.growth);
  measured.exponent = exponent(measured.growth);
  return measured;
}

}  // namespace tunica::bench
