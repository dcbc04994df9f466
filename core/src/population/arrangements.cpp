// SPDX-License-Identifier: Apache-2.0
#include "population/arrangements.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "population/chance.hpp"

namespace tunica::population {
namespace {

/// Specimens that move together, and the label that they carry.
struct Unit {
  std::vector<std::size_t> specimens;
  std::size_t level;
};
/// Units that exchange labels.
using Stratum = std::vector<Unit>;

bool constant_in_animals(const Cohort& cohort, std::size_t factor) {
  std::map<std::size_t, std::size_t> level;
  for (const Specimen& specimen : cohort.specimens)
    if (level.try_emplace(specimen.animal, specimen.levels[factor]).first->second != specimen.levels[factor])
      return false;
  return true;
}

std::vector<Stratum> strata(const Cohort& cohort, std::size_t factor, std::vector<std::size_t> others, Scheme scheme) {
  // A factor that varies within animals does not keep whole animals apart.
  if (scheme == Scheme::over_animals)
    std::erase_if(others, [&](std::size_t other) { return !constant_in_animals(cohort, other); });
  std::map<std::vector<std::size_t>, std::map<std::size_t, Unit>> found;
  for (std::size_t i = 0; i < cohort.specimens.size(); ++i) {
    const Specimen& specimen = cohort.specimens[i];
    std::vector<std::size_t> key;
    if (scheme == Scheme::within_animals) key.push_back(specimen.animal);
    for (const std::size_t other : others) key.push_back(specimen.levels[other]);
    Unit& unit = found[key][scheme == Scheme::over_animals ? specimen.animal : i];
    unit.specimens.push_back(i);
    unit.level = specimen.levels[factor];
  }
  std::vector<Stratum> result;
  for (auto& [key, units] : found) {
    result.emplace_back();
    for (auto& [number, unit] : units) result.back().push_back(std::move(unit));
  }
  return result;
}

std::vector<std::size_t> labels(const Stratum& stratum) {
  std::vector<std::size_t> result;
  for (const Unit& unit : stratum) result.push_back(unit.level);
  return result;
}

/// n!/(n_1! n_2! …)
double count_of(std::vector<std::size_t> levels) {
  double result = 1;
  std::map<std::size_t, std::size_t> seen;
  for (std::size_t k = 0; k < levels.size(); ++k)
    result *= static_cast<double>(k + 1) / static_cast<double>(++seen[levels[k]]);
  return std::round(result);
}

void deal(const Stratum& stratum, const std::vector<std::size_t>& levels, std::vector<std::size_t>& row) {
  for (std::size_t k = 0; k < stratum.size(); ++k)
    for (const std::size_t i : stratum[k].specimens) row[i] = levels[k];
}

void enumerate(const std::vector<Stratum>& all, std::size_t from, std::vector<std::size_t>& row, Arrangements& result) {
  if (from == all.size()) {
    result.levels.push_back(row);
    return;
  }
  std::vector<std::size_t> own = labels(all[from]);
  std::sort(own.begin(), own.end());
  do {
    deal(all[from], own, row);
    enumerate(all, from + 1, row, result);
  } while (std::next_permutation(own.begin(), own.end()));
}

}  // namespace

Arrangements arrangements(const Cohort& cohort, std::size_t factor, const std::vector<std::size_t>& other_factors,
                          std::size_t most, std::uint64_t seed) {
  Arrangements result;
  if (!cohort.animals.empty())
    result.scheme = constant_in_animals(cohort, factor) ? Scheme::over_animals : Scheme::within_animals;
  const std::vector<Stratum> all = strata(cohort, factor, other_factors, result.scheme);
  for (const Stratum& stratum : all) result.possible *= count_of(labels(stratum));
  result.exhaustive = result.possible <= static_cast<double>(most) + 1;
  std::vector<std::size_t> row(cohort.specimens.size());
  if (result.exhaustive) {
    enumerate(all, 0, row, result);
    return result;
  }
  Chance chance(derive_seed(seed, "arrangements of " + cohort.factors[factor].name));
  for (std::size_t draw = 0; draw < most; ++draw) {
    for (const Stratum& stratum : all) {
      std::vector<std::size_t> own = labels(stratum);
      for (std::size_t k = own.size(); k > 1; --k) std::swap(own[k - 1], own[chance.below(k)]);
      deal(stratum, own, row);
    }
    result.levels.push_back(row);
  }
  return result;
}

}  // namespace tunica::population
