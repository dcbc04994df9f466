// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "calibration/fakes.hpp"

namespace tunica::fakes {

/// A Record that owns its numbers; times are left out, they are all that may differ between two runs.
struct Line {
  std::uint64_t index;
  std::vector<double> parameters, per_test;
  double objective;
  Status::Kind kind;
  std::string reason;
  bool ended_early = false;
  /// NaN marks a test that was left out.
  static bool same(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
  }
  bool operator==(const Line& other) const {
    const bool failed = kind == Status::Kind::failed;  // then objective and costs are undefined
    return index == other.index && ended_early == other.ended_early && parameters == other.parameters &&
           kind == other.kind && reason == other.reason &&
           (failed || (objective == other.objective && same(per_test, other.per_test)));
  }
};
inline void PrintTo(const Line& line, std::ostream* out) { *out << '#' << line.index << ' ' << line.objective; }

struct Recording {
  std::vector<Line> lines;
  std::function<void(const search::Record&)> recorder() {
    return [this](const search::Record& record) {
      lines.push_back({record.index,
                       {record.parameters.begin(), record.parameters.end()},
                       {record.per_test.begin(), record.per_test.end()},
                       record.objective,
                       record.status.kind(),
                       record.status.reason(),
                       record.ended_early});
    };
  }
  /// A journal of the first `count` lines.
  [[nodiscard]] search::Replay replay(std::size_t count) const {
    return [lines = lines, count](std::uint64_t index, search::JournalEntry& entry) {
      if (index >= count) return false;
      const Line& line = lines.at(index);
      entry = {line.parameters,
               line.per_test,
               line.objective,
               line.kind == Status::Kind::failed ? Status::failed(line.reason) : Status{},
               0.001 * static_cast<double>(index),
               line.ended_early};
      return true;
    };
  }
};

}  // namespace tunica::fakes
