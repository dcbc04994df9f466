// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  bool operator==(const Line& other) const {
    const bool failed = kind == Status::Kind::failed;  // then objective and costs are undefined
    return index == other.index && parameters == other.parameters && kind == other.kind && reason == other.reason &&
           (failed || (objective == other.objective && per_test == other.per_test));
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
                       record.status.reason()});
    };
  }
  /// A journal of the first `count` lines.
  [[nodiscard]] search::Replay replay(std::size_t count) const {
    return [lines = lines, count](std::uint64_t index, search::JournalEntry& entry) {
      if (index >= count) return false;
      const Line& line = lines.at(index);
      entry = {line.parameters, line.per_test, line.objective,
               line.kind == Status::Kind::failed ? Status::failed(line.reason) : Status{},
               0.001 * static_cast<double>(index)};
      return true;
    };
  }
};

}  // namespace tunica::fakes
