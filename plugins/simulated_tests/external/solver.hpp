// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <variant>

#include "cache.hpp"
#include "scratch.hpp"
#include "settings.hpp"

namespace tunica::external {

/// Runs the program for filled-in templates and reads what it wrote; asks the cache first. Thread-safe.
class Solver {
 public:
  explicit Solver(Settings settings)
      : settings_(std::move(settings)), cache_(settings_.cache, settings_.results.size()) {
    Scratch::sweep(settings_.scratch);
  }

  [[nodiscard]] const Settings& settings() const { return settings_; }
  /// The numbers of Settings::results, one list each; or why there are none. `value` fills a place in.
  [[nodiscard]] std::variant<Numbers, std::string> solve(
      const std::function<std::string(const TextTemplate::Place&)>& value) const;
  [[nodiscard]] std::vector<Effort> efforts() const;

 private:
  [[nodiscard]] std::variant<Numbers, std::string> run_in_scratch(const std::vector<std::string>& arguments,
                                                                  const std::vector<std::string>& texts) const;
  [[nodiscard]] bool interrupted() const;

  Settings settings_;
  mutable Cache cache_;
  mutable std::atomic<std::uint64_t> runs_ = 0, failed_ = 0, cached_ = 0;
};

}  // namespace tunica::external
