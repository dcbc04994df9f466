// SPDX-License-Identifier: Apache-2.0
#include "cohort/members.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "population/design.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {

namespace {

/// Adds a factor, or says why not.
void add_factor(const Factor& factor, Members& members) {
  std::set<std::size_t> present;
  for (const std::size_t k : members.specimens) present.insert(factor.of[k]);
  population::Factor added{factor.column, {}};
  std::map<std::size_t, std::size_t> number;  // of a level among those that are present; the reference is the first
  for (const std::size_t level : present) {
    number[level] = added.levels.size();
    added.levels.push_back(factor.levels[level]);
  }
  if (present.size() < 2) {
    members.refusals.push_back(fmt::format("the factor '{}' has one level among the specimens that were fitted, '{}'",
                                           factor.column, added.levels.empty() ? "" : added.levels.front()));
    return;
  }
  Members with = members;
  with.factors.push_back(added);
  for (std::size_t i = 0; i < with.rows.size(); ++i)
    with.rows[i].levels.push_back(number[factor.of[with.specimens[i]]]);
  try {
    const population::Design design = population::design(with.cohort(), with.all_factors());
    if (design.size() >= with.rows.size())
      throw InputError(
          fmt::format("{} specimens are too few for it. Add specimens, or take the factor out", with.rows.size()));
    members = std::move(with);
  } catch (const InputError& reason) {
    members.refusals.push_back(
        fmt::format("the factor '{}' is left out of the comparison: {}", factor.column, reason.what()));
  }
}

std::vector<Group> groups_of(const Members& members) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < members.rows.size(); ++i) {
    const std::vector<std::size_t>& levels = members.rows[i].levels;
    auto at = std::find_if(groups.begin(), groups.end(), [&](const Group& one) { return one.levels == levels; });
    if (at == groups.end()) {
      std::string name;
      for (std::size_t f = 0; f < levels.size(); ++f)
        name += (name.empty() ? "" : ", ") + members.factors[f].levels[levels[f]];
      at = groups.insert(groups.end(), {name.empty() ? "all" : name, levels, {}});
    }
    at->specimens.push_back(i);
  }
  std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.levels < b.levels; });
  return groups;
}

}  // namespace

std::vector<std::size_t> Members::all_factors() const {
  std::vector<std::size_t> all(factors.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

population::Cohort Members::cohort() const {
  population::Cohort cohort;
  cohort.factors = factors;
  cohort.specimens = rows;
  cohort.animals = animals;
  return cohort;
}

Members members_of(const SpecimenTable& table, const Collection& found) {
  Members members;
  std::map<std::string, std::size_t> animals;
  for (std::size_t k = 0; k < found.records.size(); ++k) {
    if (found.records[k].outcome != Outcome::fitted) continue;
    const auto [animal, fresh] = animals.emplace(table.specimens[k].animal, animals.size());
    if (fresh) members.animals.push_back(table.specimens[k].animal);
    members.specimens.push_back(k);
    members.rows.push_back({table.specimens[k].id, {}, animal->second});
  }
  if (members.animals.size() == members.specimens.size() || members.animals.size() < 2) members.animals.clear();
  for (const Factor& factor : table.factors)
    if (factor.refusal.empty() && !members.specimens.empty()) add_factor(factor, members);
  members.groups = groups_of(members);
  return members;
}

}  // namespace tunica::cohort
