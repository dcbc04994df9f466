// SPDX-License-Identifier: Apache-2.0
#include "comparison/conclusion.hpp"

#include <algorithm>
#include <cstdint>
#include <variant>

#include <fmt/format.h>

#include "comparison/summary.hpp"

namespace tunica::comparison {

namespace {

/// Of the fitted curves: how many there are, how many lie farther from their data than the mean does, and the worst.
struct WorseThanMean {
  std::size_t judged = 0, worse = 0;
  const Quality* worst = nullptr;
};

WorseThanMean worse_than_mean(const RunSummary& run) {
  WorseThanMean found;
  for (const Quality& one : run.quality) {
    if (one.held_out || !one.agreement.r2) continue;
    ++found.judged;
    if (!(*one.agreement.r2 < 0)) continue;
    ++found.worse;
    if (!found.worst || *one.agreement.r2 < *found.worst->agreement.r2) found.worst = &one;
  }
  return found;
}

std::string words_on_worst(const RunSummary& run) {
  const Quality& worst = *worse_than_mean(run).worst;
  return fmt::format("R² is {:.3g} in {}, {}: its mean is nearer to the data than the model", *worst.agreement.r2,
                     worst.test, worst.channel);
}

std::string words_on_limit(const RunSummary& run) {
  const std::string by = run.stop_sentence.empty() ? "" : "ended by " + run.stop_sentence;
  if (!run.limit) return by;
  return fmt::format("{}{} = {}: raise it to search on", by.empty() ? "" : by + ", ", run.limit->key, run.limit->value);
}

}  // namespace

std::optional<SearchLimit> limit_of(const execution::PlannedRun& run, const RunSummary& summary) {
  const experiment::Stop& shared = run.entry->stop;
  const auto* const stage = run.stages.empty() ? nullptr : &run.stages.back();
  const experiment::Stop& own = stage && stage->own_stop ? *stage->own_stop : shared;
  switch (summary.stopped_by) {
    case search::StopReason::max_evaluations:
      return SearchLimit{"stop.max_evaluations",
                         fmt::format("{}", std::min(own.max_evaluations, shared.max_evaluations))};
    case search::StopReason::stall:
      if (const auto stall = own.stall ? own.stall : shared.stall)
        return SearchLimit{"stop.stall", fmt::format("{}", *stall)};
      return {};
    case search::StopReason::max_time:
      if (const auto time = own.max_time ? own.max_time : shared.max_time)
        return SearchLimit{"stop.max_time", fmt::format("{:g} s", *time)};
      return {};
    case search::StopReason::failure_rate:
      return SearchLimit{"max_failure_rate", "see on_failure"};
    case search::StopReason::none:
      break;
    default:
      return {};
  }
  if (summary.converged || !stage) return {};
  // An optimiser names the option that ended it, as a word of its reason.
  for (const auto& option : stage->optimizer->factory.options) {
    if (option.name.find('_') == std::string::npos || summary.reason.find(option.name) == std::string::npos) continue;
    const auto& values = stage->entry->options.values();
    const auto given = values.find(option.name);
    const auto* const count = given == values.end() ? nullptr : std::get_if<std::int64_t>(&given->second);
    if (count)
      return SearchLimit{fmt::format("optimizers.{}.{}", stage->entry->name, option.name), fmt::format("{}", *count)};
  }
  return {};
}

Ending ending_of(const RunSummary& run) {
  if (!run.has_result) return Ending::no_result;
  if (run.status.kind() == Status::Kind::infeasible) return Ending::infeasible;
  if (run.certificate.refuted()) return Ending::refuted;
  if (2 * run.failures > run.evaluations) return Ending::mostly_failed;
  if (run.certificate.verdict == CertificateVerdict::not_an_optimum)
    return run.stopped_by == search::StopReason::none ? Ending::not_an_optimum : Ending::short_of_optimum;
  const WorseThanMean curves = worse_than_mean(run);
  if (curves.judged > 0 && curves.worse == curves.judged) return Ending::not_a_fit;
  if (run.stopped_by == search::StopReason::target) return Ending::at_target;
  if (run.stopped_by != search::StopReason::none) return Ending::at_limit;
  if (!run.converged) return Ending::not_converged;
  return curves.worse > 0 ? Ending::misses : Ending::converged;
}

std::string words_on_ending(const RunSummary& run) {
  const std::string limit = words_on_limit(run);
  const auto with = [](std::string words, const std::string& more) {
    return more.empty() ? words : fmt::format("{}; {}", words, more);
  };
  const std::string reason = with(run.reason, limit);
  const Ending ending = ending_of(run);
  switch (ending) {
    case Ending::no_result:
    case Ending::infeasible:
    case Ending::refuted:
      return reason.empty() ? "no fit" : "no fit: " + reason;
    case Ending::mostly_failed:
      return with(fmt::format("not trusted: {} of {} evaluations failed", run.failures, run.evaluations), reason);
    case Ending::not_an_optimum:
    case Ending::short_of_optimum:
      return with("not at an optimum, see below", reason);
    case Ending::not_a_fit:
    case Ending::misses:
      return with(fmt::format("{}: {}", ending == Ending::misses ? "a poor fit" : "no fit", words_on_worst(run)),
                  reason);
    case Ending::at_target:
      return "ended at its target";
    case Ending::at_limit:
      return fmt::format("{}; the search that found the best point {} converged{}",
                         limit.empty() ? std::string(search::code(run.stopped_by)) : limit,
                         run.converged ? "had" : "had not", run.reason.empty() ? "" : ": " + run.reason);
    case Ending::not_converged:
      return reason.empty() ? "not converged" : "not converged: " + reason;
    case Ending::converged:
      return reason.empty() ? "converged" : "converged: " + reason;
  }
  return "";
}

}  // namespace tunica::comparison
