// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <pagmo/algorithm.hpp>

#include "search.hpp"

namespace tunica::pagmo_plugin {

struct Settings {
  /// The algorithm with its seed, and what evaluates a generation at once, for those that ask.
  std::function<pagmo::algorithm(unsigned seed, Search& search)> algorithm;
  std::size_t population = 0;  ///< 0: by dimension
  std::size_t restarts = 0;
  double restart_growth = 1;  ///< factor on the population at every restart
  std::size_t stall_generations = 0;
  double tolerance = 0;  ///< relative improvement that counts as progress
};

/// A population method of pagmo, from a random population that holds the problem's start, and again from larger ones
/// when it stalls.
class PagmoOptimizer : public Optimizer {
 public:
  explicit PagmoOptimizer(Settings settings) : settings_(std::move(settings)) {
    needs_ = {.constraints = true, .batch = true, .random = true};
  }
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override;

 private:
  Settings settings_;
  Needs needs_;
};

}  // namespace tunica::pagmo_plugin
