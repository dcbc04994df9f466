// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "figures.hpp"

namespace blind::score {
namespace {

constexpr double z = 1.959963984540054;

double wilson(const Share& of, double side) {
  if (of.total == 0) return side < 0 ? 0 : 1;
  const double n = static_cast<double>(of.total), p = of.value(), zz = z * z / n;
  return (p + zz / 2 + side * z * std::sqrt(p * (1 - p) / n + zz / (4 * n))) / (1 + zz);
}

bool holds(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Two that count for one another: declared of the first, and told apart by nothing in the data.
bool interchangeable(const std::string& first, const std::string& truth, double likeness,
                     const LookAlikes& look_alikes) {
  constexpr double alike = 0.9;
  const auto declared = look_alikes.find(first);
  return declared != look_alikes.end() && holds(declared->second, truth) && std::abs(likeness) > alike;
}

}  // namespace

double Share::low() const { return std::max(0.0, wilson(*this, -1)); }
double Share::high() const { return std::min(1.0, wilson(*this, 1)); }

Verdict judged(const Case& one) {
  Verdict left = one.verdict;
  const auto& hidden = one.truth.effects;
  const bool told_to_find =
      std::any_of(hidden.begin(), hidden.end(), [](const TrueEffect& effect) { return effect.id == "outliers"; });
  if (!one.truth.contaminated || told_to_find) return left;
  const bool any = !left.causes.empty();
  const auto gross = [](const Cause& cause) { return cause.id == "outliers"; };
  if (left.together) {
    const auto named = static_cast<std::ptrdiff_t>(std::min(*left.together, left.causes.size()));
    *left.together -= static_cast<std::size_t>(std::count_if(left.causes.begin(), left.causes.begin() + named, gross));
  }
  std::erase_if(left.causes, gross);
  std::erase(left.ambiguity_set, "outliers");
  // What is left when the gross errors are taken away is no alarm of anything else.
  if (left.verdict == "suspect_data" && left.causes.empty()) left.verdict = "nothing_detected";
  if (any && left.causes.empty() && left.ambiguity_set.empty() && left.verdict != "unknown")
    left.verdict = "nothing_detected";
  return left;
}

std::vector<std::string> claimed(const Verdict& verdict) {
  std::vector<std::string> all = verdict.ambiguity_set;
  if (!verdict.causes.empty() && !holds(all, verdict.causes.front().id)) all.push_back(verdict.causes.front().id);
  return all;
}

std::size_t together(const Verdict& verdict) {
  if (verdict.verdict == "unknown") return 0;
  return std::min(verdict.together.value_or(verdict.causes.size()), verdict.causes.size());
}

bool named_first(const Verdict& verdict, const std::string& truth) {
  return verdict.detected() && verdict.verdict != "unknown" && !verdict.causes.empty() &&
         verdict.causes.front().id == truth;
}

bool named_with_look_alike(const Verdict& verdict, const std::string& truth, const LookAlikes& look_alikes) {
  return verdict.detected() && verdict.verdict != "unknown" && !verdict.causes.empty() &&
         stands_for(verdict, verdict.causes.front().id, truth, look_alikes);
}

bool stands_for(const Verdict& verdict, const std::string& named, const std::string& truth,
                const LookAlikes& look_alikes) {
  if (named == truth) return true;
  const auto likeness = verdict.confusable.find({std::min(named, truth), std::max(named, truth)});
  return holds(verdict.ambiguity_set, truth) && likeness != verdict.confusable.end() &&
         interchangeable(named, truth, likeness->second, look_alikes);
}

bool oracle_named(const Oracle& oracle, const std::string& truth, const LookAlikes& look_alikes) {
  return stands_for(Oracle::Member{oracle.first, oracle.likeness}, truth, look_alikes);
}

bool stands_for(const Oracle::Member& named, const std::string& truth, const LookAlikes& look_alikes) {
  const auto likeness = named.likeness.find(truth);
  return named.id == truth ||
         (likeness != named.likeness.end() && interchangeable(named.id, truth, likeness->second, look_alikes));
}

}  // namespace blind::score
