// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/groups.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "cohort_diagnosis/common_amplitude.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort_diagnosis {
namespace {

constexpr double in_one_level = 0.2;  ///< of effects, before the data
constexpr double sure = 0.5;          ///< that one level alone has it

/// ln of the evidence with its odds: of all specimens, then of each level alone.
std::vector<double> structures(const Hypothesis& hypothesis, const std::vector<Level>& levels, std::size_t specimens) {
  const std::vector<bool> everyone(specimens, true);
  std::vector<double> logs{hypothesis.log_evidence(everyone)};
  if (levels.empty()) return logs;
  logs.front() += std::log1p(-in_one_level);
  const double share = std::log(in_one_level / static_cast<double>(levels.size()));
  for (const Level& level : levels) logs.push_back(share + hypothesis.log_evidence(level.has));
  return logs;
}

}  // namespace

std::vector<Level> levels_of(const Specimens& specimens, std::span<const Factor> factors) {
  std::vector<Level> all;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    std::set<std::string> names;
    for (const SpecimenEvidence* specimen : specimens) {
      const auto found = factors[f].level.find(specimen->id);
      if (found == factors[f].level.end())
        throw InputError(
            fmt::format("the factor '{}' has no level for the specimen '{}'. Add one, or "
                        "leave the factor out",
                        factors[f].name, specimen->id));
      names.insert(found->second);
    }
    if (names.size() < 2) continue;
    for (const std::string& name : names) {
      Level level{f, name, {}};
      for (const SpecimenEvidence* specimen : specimens) level.has.push_back(factors[f].level.at(specimen->id) == name);
      all.push_back(std::move(level));
    }
  }
  return all;
}

double log_evidence(const Hypothesis& hypothesis, const std::vector<Level>& levels, std::size_t specimens) {
  return log_sum_exp(structures(hypothesis, levels, specimens));
}

std::vector<FactorEvidence> factors_of(const Hypothesis& hypothesis, const std::vector<Level>& levels,
                                       std::span<const Factor> factors, std::size_t specimens) {
  const std::vector<double> logs = structures(hypothesis, levels, specimens);
  const double all = log_sum_exp(logs);
  std::vector<FactorEvidence> found;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const Level& level = levels[k];
    if (found.empty() || found.back().factor != factors[level.factor].name)
      found.push_back({factors[level.factor].name, {}, std::nullopt, 0});
    FactorEvidence& factor = found.back();
    LevelEvidence own{level.name, static_cast<std::size_t>(std::count(level.has.begin(), level.has.end(), true)),
                      hypothesis.log_evidence(level.has), 0, std::nullopt};
    if (own.with > 0) own.amplitude = common_amplitude(hypothesis, level.has);
    factor.levels.push_back(std::move(own));
    const double probability = std::exp(logs[k + 1] - all);
    factor.probability_only += probability;
    if (probability > sure) factor.only_in = level.name;
  }
  return found;
}

std::vector<bool> affected(const std::vector<FactorEvidence>& factors, const std::vector<Level>& levels,
                           std::size_t specimens) {
  for (std::size_t k = 0, f = 0; k < levels.size(); ++k) {
    if (k > 0 && levels[k].factor != levels[k - 1].factor) ++f;
    if (factors[f].only_in == levels[k].name) return levels[k].has;
  }
  return std::vector<bool>(specimens, true);
}

}  // namespace tunica::cohort_diagnosis
