// SPDX-License-Identifier: Apache-2.0
#include "search/ledger.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace tunica::search {
namespace {

/// Equal but for digits, signs and points.
bool same_kind(std::string_view a, std::string_view b) {
  const auto part_of_number = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; };
  for (;;) {
    while (!a.empty() && part_of_number(a.front())) a.remove_prefix(1);
    while (!b.empty() && part_of_number(b.front())) b.remove_prefix(1);
    if (a.empty() || b.empty()) return a.empty() && b.empty();
    if (a.front() != b.front()) return false;
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
}

}  // namespace

void Tally::add_failure(const std::string& reason, std::uint64_t count) {
  if (first_failure.empty()) first_failure = reason;
  const auto known = std::find_if(reasons.begin(), reasons.end(),
                                  [&](const FailureKind& kind) { return same_kind(kind.example, reason); });
  if (known != reasons.end())
    known->count += count;
  else if (reasons.size() < most_reasons)
    reasons.push_back({reason, count});
}

void Tally::add_start(std::span<const double> x, double objective) {
  constexpr double on_bound = 1e-6;
  ++starts;
  for (std::size_t j = 0; j < x.size(); ++j)
    if (x[j] <= on_bound || x[j] >= 1 - on_bound) add_stops({j, x[j] > 0.5, 1, objective});
}

void Tally::add_stops(const BoundStops& stops) {
  const auto known = std::find_if(bound_stops.begin(), bound_stops.end(), [&](const BoundStops& one) {
    return one.parameter == stops.parameter && one.upper == stops.upper;
  });
  if (known == bound_stops.end()) {
    bound_stops.push_back(stops);
    return;
  }
  known->count += stops.count;
  known->objective = std::min(known->objective, stops.objective);
}

void Tally::add(const Tally& part) {
  starts += part.starts;
  for (const BoundStops& stops : part.bound_stops) add_stops(stops);
  evaluations += part.evaluations;
  jacobians += part.jacobians;
  failures += part.failures;
  infeasible += part.infeasible;
  ended_early += part.ended_early;
  simulated += part.simulated;
  guide_evaluations += part.guide_evaluations;
  if (first_failure.empty()) first_failure = part.first_failure;
  for (const FailureKind& kind : part.reasons) add_failure(kind.example, kind.count);
}

void Ledger::add(std::span<const double> parameters, double objective, const Status& status, bool jacobian,
                 Extent extent) {
  const std::uint64_t index = next_index();
  ++tally_.evaluations;
  if (jacobian) ++tally_.jacobians;
  if (extent == Extent::whole) ++tally_.simulated;
  if (extent == Extent::ended_early) {
    ++tally_.ended_early;
  } else if (status.kind() == Status::Kind::failed) {
    ++tally_.failures;
    tally_.add_failure(status.reason());
  } else {
    const double violation = status.violation();
    if (status.kind() == Status::Kind::infeasible) ++tally_.infeasible;
    if (!best_.found() || is_better(objective, violation, best_.objective, best_.violation)) {
      best_.parameters.assign(parameters.begin(), parameters.end());
      best_.objective = objective;
      best_.index = index;
      best_.violation = violation;
      improved_at_ = tally_.evaluations;
    }
  }
  // An evaluation that ended early is never the best, and does not change the best.
  const bool reached = status.ok() && extent != Extent::ended_early && best_.feasible();
  if (reached && rules_.stop.target && best_.objective <= *rules_.stop.target) stop(StopReason::target);
  check_failures(status);
  if (rules_.stop.stall && tally_.evaluations - improved_at_ >= *rules_.stop.stall) stop(StopReason::stall);
  if (tally_.evaluations >= rules_.stop.max_evaluations) stop(StopReason::max_evaluations);
}

void Ledger::check_failures(const Status& status) {
  if (status.kind() != Status::Kind::failed) return;
  if (rules_.on_failure == experiment::OnFailure::stop)
    stop(StopReason::failure, fmt::format("failure: {}", status.reason()));
  if (!rules_.whole_run) return;
  const std::uint64_t evaluations = tally_.evaluations, failures = tally_.failures;
  if (failures == evaluations && evaluations >= nothing_succeeded_after) {
    stop(StopReason::nothing_succeeded,
         fmt::format("nothing succeeded in the first {} evaluations; the first failure: {}", evaluations,
                     tally_.first_failure));
  }
  const double rate = static_cast<double>(failures) / static_cast<double>(evaluations);
  if (evaluations >= rate_counts_from && rate > rules_.max_failure_rate) {
    stop(StopReason::failure_rate,
         fmt::format("failure rate: {} of {} evaluations failed, more than the limit of {:g} %; the first failure: {}",
                     failures, evaluations, 100 * rules_.max_failure_rate, tally_.first_failure));
  }
}

void Ledger::stop(StopReason reason, std::string sentence) {
  if (stopped()) return;
  reason_ = reason;
  sentence_ = sentence.empty() ? std::string(code(reason)) : std::move(sentence);
}

std::uint64_t Ledger::budget() const {
  const bool none = stopped() || tally_.evaluations >= rules_.stop.max_evaluations;
  return none ? 0 : rules_.stop.max_evaluations - tally_.evaluations;
}

Ledger Ledger::for_one_start() const {
  Rules rules = rules_;
  rules.stop.max_evaluations = budget();
  rules.first_index = 0;
  rules.whole_run = false;
  Ledger ledger(rules);
  ledger.best_ = best_;
  return ledger;
}

}  // namespace tunica::search
