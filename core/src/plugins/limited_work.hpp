// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "plugins/calls.hpp"

namespace tunica::plugins {

/// Where work ends that max_time, s, bounds and that begins here; the end of time where none is set.
inline Clock::time_point deadline_after(std::optional<double> max_time) {
  constexpr double longest = 1e9;  // what clocks count
  if (!max_time) return Clock::time_point::max();
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(*max_time, longest)));
}

/// Work after a search, while it lives. Programs and servers that this thread waits for are given up at the deadline;
/// threads of its own need a scope of theirs.
class LimitedWork {
 public:
  LimitedWork(const char* what, Clock::time_point deadline) : call_{nullptr, what, nullptr, nullptr, deadline} {}

  [[nodiscard]] bool is_over() const { return Clock::now() >= call_.deadline; }

 private:
  Call call_;
  CallScope scope_{call_};
};

}  // namespace tunica::plugins
