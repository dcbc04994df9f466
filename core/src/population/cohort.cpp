// SPDX-License-Identifier: Apache-2.0
#include "population/cohort.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::population {
namespace {

void check_factors(const Cohort& cohort) {
  for (std::size_t f = 0; f < cohort.factors.size(); ++f) {
    const Factor& factor = cohort.factors[f];
    std::set<std::size_t> seen;
    for (const Specimen& specimen : cohort.specimens) {
      if (specimen.levels.size() != cohort.factors.size() || specimen.levels[f] >= factor.levels.size())
        throw InputError(fmt::format("specimen '{}' has no level of the factor '{}'; expected one for every factor",
                                     specimen.name, factor.name));
      seen.insert(specimen.levels[f]);
    }
    if (seen.size() < 2)
      throw InputError(fmt::format(
          "factor '{}': all {} specimens have one level, expected two levels at least; leave the factor out",
          factor.name, cohort.specimens.size()));
    for (std::size_t level = 0; level < factor.levels.size(); ++level)
      if (!seen.contains(level))
        throw InputError(fmt::format("factor '{}': no specimen has the level '{}'; leave the level out", factor.name,
                                     factor.levels[level]));
  }
}

void check_cohort(const Cohort& cohort) {
  if (cohort.specimens.size() < 2)
    throw InputError(fmt::format("a cohort needs two specimens at least, found {}; add specimens or fit the one alone",
                                 cohort.specimens.size()));
  assert(!cohort.parameters.empty() && cohort.start.size() == static_cast<Eigen::Index>(cohort.parameters.size()));
  std::set<std::string> names;
  for (const Specimen& specimen : cohort.specimens) {
    if (!names.insert(specimen.name).second)
      throw InputError(fmt::format("the specimen '{}' is there twice; give each a name of its own", specimen.name));
    if (!cohort.animals.empty() && specimen.animal >= cohort.animals.size())
      throw InputError(
          fmt::format("specimen '{}' has no animal; name one for every specimen or for none", specimen.name));
  }
  check_factors(cohort);
}

}  // namespace

Sorted sorted(const Cohort& cohort) {
  check_cohort(cohort);
  Sorted result{cohort, std::vector<std::size_t>(cohort.specimens.size())};
  std::iota(result.place.begin(), result.place.end(), std::size_t{0});
  std::sort(result.place.begin(), result.place.end(),
            [&](std::size_t a, std::size_t b) { return cohort.specimens[a].name < cohort.specimens[b].name; });
  std::vector<std::string> animals;
  std::vector<std::size_t> number(cohort.animals.size(), cohort.animals.size());
  for (std::size_t k = 0; k < result.place.size(); ++k) {
    Specimen& specimen = result.cohort.specimens[k] = cohort.specimens[result.place[k]];
    if (cohort.animals.empty()) continue;
    if (number[specimen.animal] == cohort.animals.size()) {
      number[specimen.animal] = animals.size();
      animals.push_back(cohort.animals[specimen.animal]);
    }
    specimen.animal = number[specimen.animal];
  }
  result.cohort.animals = std::move(animals);
  result.cohort.expand = [expand = cohort.expand, place = result.place](std::size_t k, const Prior& prior) {
    return expand(place[k], prior);
  };
  if (cohort.misfits)
    result.cohort.misfits = [misfits = cohort.misfits, place = result.place](
                                std::size_t k, const Eigen::MatrixXd& points, const std::vector<double>& variances) {
      return misfits(place[k], points, variances);
    };
  return result;
}

}  // namespace tunica::population
