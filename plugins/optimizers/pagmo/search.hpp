// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <pagmo/types.hpp>

#include "tunica/optimizer.hpp"

namespace tunica::pagmo_plugin {

/// One search on behalf of pagmo, whose problem and batch evaluator hold a pointer to it. pagmo has no way of being
/// stopped but an exception, so that a search always ends by one: Stopped, Stalled or NothingSucceeded.
///
/// The algorithms compare fitnesses and do not calculate with them, so that any order can be put into one number:
/// −1/f < 0 of feasible points, the violation of infeasible ones, the largest number of failed ones.
class Search {
 public:
  struct Stopped {};
  struct Stalled {};
  struct NothingSucceeded {};
  struct Best {
    std::vector<double> x;  ///< empty: nothing could be evaluated
    double fitness = std::numeric_limits<double>::max();

    [[nodiscard]] bool feasible() const { return fitness < 0; }
    [[nodiscard]] double violation() const { return feasible() ? 0 : fitness; }
  };
  static constexpr std::size_t gives_up_after = 2000;  ///< evaluations, all failed

  /// Ends by Stalled after `stall` evaluations that improved the best point by less than a fraction `tolerance`.
  Search(Problem& problem, std::size_t stall, double tolerance)
      : problem_(problem), stall_(stall), tolerance_(tolerance) {}

  double fitness(const pagmo::vector_double& x);
  /// Points one after the other; one fitness each.
  pagmo::vector_double fitnesses(const pagmo::vector_double& xs);

  [[nodiscard]] std::size_t dimension() const { return problem_.dimension(); }
  [[nodiscard]] const Best& best() const { return best_; }
  [[nodiscard]] const std::string& failure() const { return failure_; }
  [[nodiscard]] std::size_t evaluated() const { return evaluated_; }

 private:
  double note(std::span<const double> x, const Status& status, double objective);
  void end_if_due() const;

  Problem& problem_;
  const std::size_t stall_;
  const double tolerance_;
  Best best_;
  double progress_from_ = std::numeric_limits<double>::max();
  std::size_t evaluated_ = 0, progress_at_ = 0;
  std::string failure_;
};

}  // namespace tunica::pagmo_plugin
