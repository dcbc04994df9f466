// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tunica/optimizer.hpp"
#include "variation.hpp"

namespace tunica::es {

/// Why a search ended.
enum class End { small_step, alike, stalled, stopped, nothing_succeeded };

/// One search, from a random population to convergence. All memory is taken at construction, none in a generation.
class Search {
 public:
  Search(Problem& problem, const Settings& settings, Random& random);

  /// `from_start`: the problem's start is the first of the random population.
  End run(bool from_start);

  [[nodiscard]] const std::optional<Fitness>& best() const { return best_; }
  [[nodiscard]] const std::string& first_failure() const { return first_failure_; }
  [[nodiscard]] std::uint64_t evaluated() const { return index_; }

 private:
  std::optional<End> initialise(bool from_start);
  [[nodiscard]] std::size_t batch_size() const;
  [[nodiscard]] bool alike() const;
  void evaluate(std::size_t count);
  [[nodiscard]] std::span<const std::size_t> best_offspring(std::size_t count);
  void select(std::span<const std::size_t> best);

  Problem& problem_;
  const Settings settings_;
  Random& random_;
  const std::size_t n_, steps_;
  Population parents_, survivors_, offspring_;
  Variation variation_;
  std::vector<double> objectives_;
  std::vector<Status> statuses_;
  std::vector<std::size_t> order_;
  std::size_t parent_count_ = 0;
  std::uint64_t index_ = 0, first_mutant_ = 0;
  std::optional<Fitness> best_;
  std::string first_failure_;
};

}  // namespace tunica::es
