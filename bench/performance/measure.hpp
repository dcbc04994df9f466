// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// How a row is timed: work and floors in turn, round by round, so that a disturbance meets both; the figures are
/// medians over the rounds, and a ratio is the median of the ratios of each round.
namespace tunica::bench {

/// One call does the work `per_call` times: so many points, evaluations, rows.
struct Work {
  std::function<void()> call;
  double per_call = 1;
};

struct Floor {
  std::string what;   ///< "fused kernel"
  std::string level;  ///< instructions it is compiled for; "" where there is one only
  Work work;
};

/// What a row times at one size, with everything that it needs kept alive by the functions.
struct Prepared {
  Work work;
  std::vector<Floor> floors = {};
  std::vector<Floor> peers = {};                           ///< others that do the same, timed like floors
  std::vector<std::pair<std::string, double>> facts = {};  ///< beside the time: deviation from the floor, iterations
};

enum class Clock {
  thread,  ///< processor time of this thread: others on the machine count as little as they can
  wall     ///< for work of several threads
};

struct Row {
  std::string name;                ///< "strip/gho/objective"
  std::string what;                ///< a few words
  std::string unit;                ///< what the time is of: "evaluation"
  std::string by;                  ///< what `sizes` counts: "points"; "" where the row has one size
  std::vector<std::size_t> sizes;  ///< the first is that of the figures; the others show the growth
  std::function<Prepared(std::size_t size)> make;
  Clock clock = Clock::thread;
  bool shows_memory = false;  ///< the peak of a process that does it once belongs to the row
};

struct Timing {
  double median = 0;  ///< s a unit
  double spread = 0;  ///< half the distance of the quartiles over the median
};

struct MeasuredFloor {
  std::string what, level;
  double time = 0, ratio = 0;
};

struct Measured {
  Timing time;
  std::size_t repeats = 0;
  std::vector<double> samples;  ///< s a unit, one a round
  std::vector<MeasuredFloor> floors, peers;
  std::vector<std::pair<std::string, double>> facts;
  std::vector<std::pair<std::size_t, double>> growth;  ///< size, s a call
  double exponent = 0;                                 ///< of time over size; only with three sizes or more
};

struct Effort {
  std::size_t rounds = 21;
  double sample = 4e-3;  ///< s that a sample lasts at least
  double most = 8;       ///< s that a row lasts at most, but for three rounds
  bool all_sizes = true;
  bool floors = true;  ///< and peers
};

/// Throws std::runtime_error where the work fails.
Measured measure(const Row& row, const Effort& effort);

}  // namespace tunica::bench
