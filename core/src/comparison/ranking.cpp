// SPDX-License-Identifier: Apache-2.0
#include "comparison/ranking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace tunica::comparison {

namespace {

/// So much AICc above the least, a model has little support (K. P. Burnham, D. R. Anderson, Model Selection and
/// Multimodel Inference (2002), section 2.6).
constexpr double hardly_supported = 4;

/// 0: fits and keeps the constraints; 1: breaks one; 2: its objective was not found again; 3: no result.
int standing(const RunSummary& run) {
  if (!run.has_result) return 3;
  if (run.certificate.refuted()) return 2;
  return run.status.ok() ? 0 : 1;
}

/// By less than searches resolve, runs of one model or of several are equal: they share a rank, the cheapest first, and
/// the next rank counts them.
bool tie(const RunSummary& a, const RunSummary& b) {
  constexpr double resolved = 1e-6;  // of the objective: tolerances of optimisers end a search about there
  return a.group == b.group && standing(a) == 0 && standing(b) == 0 &&
         std::abs(a.objective - b.objective) <= resolved * std::abs(a.objective) + 1e-12;
}

void share_ranks(const std::vector<RunSummary>& runs, const std::map<std::string, bool>& by_success,
                 std::vector<Ranked>& order) {
  std::map<std::string, std::size_t> next;
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    const RunSummary& leader = runs[order[first].run];
    last = first + 1;
    if (!by_success.at(leader.group))
      while (last < order.size() && tie(leader, runs[order[last].run])) ++last;
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first),
               end = order.begin() + static_cast<std::ptrdiff_t>(last);
    const auto cost = [&](const Ranked& entry) {
      return std::pair(runs[entry.run].cost().value_or(std::numeric_limits<double>::infinity()), entry.run);
    };
    std::sort(begin, end, [&](const Ranked& a, const Ranked& b) { return cost(a) < cost(b); });
    if (!leader.has_result) continue;
    const std::size_t rank = next[leader.group] + 1;
    next[leader.group] += last - first;
    for (auto entry = begin; entry != end; ++entry) entry->rank = rank;
  }
}

/// "k1 of hgo/lm": a parameter that its default bound holds, or has held in some searches; empty for none.
std::string held_by_default(const RunSummary& run) {
  for (const Estimate& one : run.parameters)
    for (const bool upper : {false, true}) {
      const bool there = one.at_bound == (upper ? Estimate::Bound::upper : Estimate::Bound::lower);
      if (!there && (upper ? one.stops_upper : one.stops_lower).count == 0) continue;
      if ((upper ? one.upper_kind : one.lower_kind) == assembly::FreeParameter::Bound::by_default)
        return fmt::format(
            "{}, {} of {}",
            there ? "a fit that a default bound holds back" : "a fit beside which searches stopped at a default bound",
            one.name, run.label);
    }
  return "";
}

}  // namespace

const char* name_of(experiment::ObjectiveType type) {
  switch (type) {
    case experiment::ObjectiveType::standardised_quadratic:
      return "standardised_quadratic";
    case experiment::ObjectiveType::least_squares:
      return "least_squares";
    case experiment::ObjectiveType::sum_of_norms:
      return "sum_of_norms";
  }
  return "";
}

std::optional<double> RunSummary::cost() const {
  if (!expected_running_time || evaluations == 0) return expected_running_time;
  const auto made = static_cast<double>(evaluations);
  return *expected_running_time * (made + static_cast<double>(jacobians)) / made;
}

std::string group_of(const experiment::RunEntry& run) {
  return fmt::format("{} on {}", name_of(run.objective), fmt::join(run.tests, ", "));
}

bool ranked_by_success(const std::vector<RunSummary>& runs, const std::string& group) {
  std::set<std::optional<double>> targets;
  std::size_t count = 0;
  for (const auto& run : runs)
    if (run.group == group) {
      targets.insert(run.target);
      ++count;
    }
  return count > 1 && targets.size() == 1 && targets.begin()->has_value();
}

std::vector<Ranked> rank(const std::vector<RunSummary>& runs) {
  std::map<std::string, std::size_t> group_order;
  std::map<std::string, bool> by_success;
  for (const auto& run : runs) {
    group_order.emplace(run.group, group_order.size());
    by_success.emplace(run.group, ranked_by_success(runs, run.group));
  }
  std::vector<Ranked> order;
  for (std::size_t run = 0; run < runs.size(); ++run) order.push_back({run, std::nullopt, std::nullopt});
  std::stable_sort(order.begin(), order.end(), [&](const Ranked& a, const Ranked& b) {
    const auto key = [&](const RunSummary& run) {
      // How far below a common target a search happened to stop says nothing; how often and how fast it got there does.
      const bool success = by_success.at(run.group) && standing(run) == 0;
      return std::tuple(group_order.at(run.group), standing(run), success ? -run.success_rate : 0.0,
                        success ? run.expected_running_time.value_or(std::numeric_limits<double>::infinity()) : 0.0,
                        standing(run) == 1 ? run.status.violation() : 0.0, run.has_result ? run.objective : 0.0);
    };
    return key(runs[a.run]) < key(runs[b.run]);
  });
  share_ranks(runs, by_success, order);
  return order;
}

std::string reason_of_rank(const RunSummary& run) {
  if (run.has_result && run.certificate.refuted()) return "a fresh process did not find this objective again";
  return run.status.reason();
}

void compare_information(const std::vector<RunSummary>& runs, std::vector<Ranked>& ranking) {
  std::map<std::string, std::set<std::string>> models;
  std::map<std::string, double> least;
  for (const auto& run : runs) {
    if (!run.has_result || !run.status.ok() || !run.information || !run.information->aicc) continue;
    models[run.group].insert(run.model);
    const double aicc = *run.information->aicc;
    least[run.group] = std::min(least.emplace(run.group, aicc).first->second, aicc);
  }
  for (auto& entry : ranking) {
    const auto& run = runs[entry.run];
    if (!run.has_result || !run.status.ok() || !run.information || !run.information->aicc ||
        models[run.group].size() < 2)
      continue;
    entry.delta_aicc = *run.information->aicc - least[run.group];
  }
}

std::vector<execution::Warning> preferences(const std::vector<RunSummary>& runs, const std::vector<Ranked>& ranking) {
  std::vector<execution::Warning> warnings;
  for (const Ranked& entry : ranking) {
    if (!entry.delta_aicc) continue;
    if (const std::string held = held_by_default(runs[entry.run]); !held.empty())
      warnings.push_back({execution::WarningKind::bound_in_comparison,
                          fmt::format("ΔAICc {:.3g} compares {}: models are "
                                      "compared at their optima. Widen the bound first",
                                      *entry.delta_aicc, held),
                          runs[entry.run].label});
  }
  for (const Ranked& first : ranking) {
    const RunSummary& run = runs[first.run];
    if (first.rank != 1U || !first.delta_aicc || *first.delta_aicc < hardly_supported ||
        ranked_by_success(runs, run.group))
      continue;
    const auto preferred = std::find_if(ranking.begin(), ranking.end(), [&](const Ranked& other) {
      return other.delta_aicc == 0. && runs[other.run].group == run.group;
    });
    if (preferred == ranking.end()) continue;
    warnings.push_back({execution::WarningKind::other_model_preferred,
                        fmt::format("ranks first by its objective, and AICc prefers {} by {:.3g}: the parameters that "
                                    "it has more cost more than they gain. Take {}, unless physics asks for them",
                                    runs[preferred->run].label, *first.delta_aicc, runs[preferred->run].label),
                        run.label});
  }
  return warnings;
}

}  // namespace tunica::comparison
