// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "experiment/experiment.hpp"
#include "search/calibration_problem.hpp"
#include "search/stop_reason.hpp"
#include "tunica/status.hpp"

namespace tunica::search {

/// Which part of an evaluation was done.
enum class Extent {
  whole,
  without_costly_tests,  ///< of an infeasible point
  ended_early            ///< the objective is a lower bound; it counts, and is never the best
};

/// Counts evaluations in the order of their index, keeps the best point (strictly better; of equals the first) and
/// says when the search must stop:
///
///   max_evaluations    so many were counted;
///   target             the best objective is at or below it;
///   stall              so many evaluations since the best one (or the beginning);
///   failure            the first failure under on_failure: stop;
///   failure_rate       above the limit, once 100 were counted;
///   nothing_succeeded  all of the first 200 failed.
///
/// A pure function of what was added: no clock, no threads.
class Ledger {
 public:
  struct Rules {
    experiment::Stop stop;
    experiment::OnFailure on_failure = experiment::OnFailure::penalise;
    double max_failure_rate = 1;
    std::uint64_t first_index = 0;
    /// The rules that apply only to a whole run: failure rate, nothing succeeded.
    bool whole_run = true;
  };
  static constexpr std::uint64_t rate_counts_from = 100, nothing_succeeded_after = 200;

  explicit Ledger(Rules rules) : rules_(rules) {}

  void add(std::span<const double> parameters, double objective, const Status& status, bool jacobian,
           Extent extent = Extent::whole);
  /// Stops for an external reason, such as max_time or interrupted. The first reason is kept. The sentence is for
  /// people; without one it is the code of the reason.
  void stop(StopReason reason, std::string sentence = {});
  void add_start(std::span<const double> x, double objective) { tally_.add_start(x, objective); }

  [[nodiscard]] bool stopped() const { return reason_ != StopReason::none; }
  [[nodiscard]] StopReason stop_reason() const { return reason_; }
  [[nodiscard]] const std::string& stop_sentence() const { return sentence_; }  ///< empty = not stopped
  [[nodiscard]] const Best& best() const { return best_; }
  [[nodiscard]] const Tally& tally() const { return tally_; }
  [[nodiscard]] std::uint64_t next_index() const { return rules_.first_index + tally_.evaluations; }
  [[nodiscard]] std::uint64_t budget() const;

  /// A ledger for one of several parallel searches, none of which knows how many evaluations precede it. It knows the
  /// best so far, and begins its counts at zero with the rest of the budget. It therefore never stops before this
  /// ledger would stop after adding the searches in order.
  [[nodiscard]] Ledger for_one_start() const;

 private:
  void check_failures(const Status& status);

  Rules rules_;
  Best best_;
  Tally tally_;
  std::uint64_t improved_at_ = 0;  ///< evaluations counted when the best was found
  StopReason reason_ = StopReason::none;
  std::string sentence_;
};

}  // namespace tunica::search
