// SPDX-License-Identifier: Apache-2.0
#include "cohort/study.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cohort/bands.hpp"
#include "cohort/index.hpp"
#include "cohort/likelihoods.hpp"
#include "cohort/readings.hpp"
#include "population/outliers.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"

namespace tunica::cohort {

namespace {

std::vector<std::vector<ShrunkenParameter>> shrunken_parameters(const std::vector<Coordinate>& coordinates,
                                                                const population::Population& population) {
  std::vector<std::vector<ShrunkenParameter>> all;
  for (const population::Individual& one : population.individuals) {
    auto& of_specimen = all.emplace_back();
    for (std::size_t j = 0; j < coordinates.size(); ++j) {
      const double xi = one.mean[index(j)];
      const double half = 1.96 * std::sqrt(std::max(0.0, one.covariance(index(j), index(j))));
      const Scale scale = coordinates[j].scale;
      of_specimen.push_back(
          {{from_coordinate(scale, xi), from_coordinate(scale, xi - half), from_coordinate(scale, xi + half)},
           std::clamp(one.borrowed[index(j)], 0.0, 1.0)});
    }
  }
  return all;
}

std::vector<Outlier> outliers_of(const Members& members, const population::Cohort& cohort,
                                 const population::Population& population) {
  std::vector<Outlier> outliers;
  for (const population::Standing& one : population::outliers(cohort, population))
    if (one.outlying)
      outliers.push_back({members.specimens[one.specimen], one.holm, cohort.parameters[one.farthest].name});
  return outliers;
}

std::vector<Coordinate> coordinates_of(const Record::Run& run) {
  std::vector<Coordinate> coordinates;
  for (const Record::Parameter& one : run.parameters) coordinates.push_back({one.name, one.unit, one.scale});
  return coordinates;
}

population::Options options_of(const Specification& cohort, const Members& members) {
  population::Options options;
  options.factors = members.all_factors();
  if (cohort.spread == SpreadStructure::full) options.within = population::Shape::full;
  if (cohort.spread == SpreadStructure::diagonal) options.within = population::Shape::diagonal;
  return options;
}

void add_population(const Specification& cohort, Likelihoods& likelihoods, PopulationStudy& result) {
  const Members& members = result.members;
  population::Cohort of_parameters = members.cohort();
  add_expansions(likelihoods, cohort.noise, of_parameters);
  const population::Population population = population::estimate(of_parameters, options_of(cohort, members));
  result.full = population.within.shape == population::Shape::full;
  result.nested = population.between.has_value();
  result.converged = population.converged;
  result.rounds = population.rounds;
  result.parameters = analyse(result.parameters.coordinates, members, of_parameters, population, cohort.permutations,
                              derive_seed(cohort.seed, "permutations of " + result.run));
  result.shrunken = shrunken_parameters(result.parameters.coordinates, population);
  result.outliers = outliers_of(members, of_parameters, population);
  result.bands = bands_of(members, population, likelihoods, derive_seed(cohort.seed, "bands of " + result.run));
  if (cohort.noise == NoisePool::cohort)
    for (std::size_t c = 0; c < of_parameters.channels.size(); ++c)
      if (of_parameters.channels[c].estimated)
        result.noise.emplace_back(of_parameters.channels[c].name, std::sqrt(population.noise[c]));
  if (population.ml) {
    result.neg2_likelihood = population.ml->deviance;
    result.aic = population.ml->aic;
    result.bic = population.ml->bic;
  }
}

PopulationStudy population_of(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                              const Collection& found, std::size_t run, const plugins::Catalogue& catalogue) {
  PopulationStudy result;
  result.members = members_of(table, found);
  const std::vector<std::size_t>& members = result.members.specimens;
  if (members.empty()) {
    result.problem = "no specimen was fitted";
    return result;
  }
  const Record::Run& first = found.records[members.front()].runs[run];
  result.run = first.label;
  result.model = first.model;
  result.parameters.coordinates = coordinates_of(first);
  Likelihoods likelihoods(members.size(), [&](std::size_t i) {
    return std::make_unique<SpecimenLikelihood>(bind(cohort, pattern, table.specimens[members[i]], catalogue), run,
                                                found.records[members[i]].runs[run], catalogue);
  });
  result.readings = study_readings(cohort, result.members, likelihoods,
                                   derive_seed(cohort.seed, "permutations of readings of " + result.run));
  try {
    add_population(cohort, likelihoods, result);
  } catch (const InputError& reason) {
    result.problem = reason.what();
  }
  return result;
}

}  // namespace

Study study(const Specification& cohort, const SpecimenTable& table, const Template& pattern, const Collection& found,
            const plugins::Catalogue& catalogue, const std::filesystem::path& results,
            const std::function<void(const std::string& stage, double share)>& told) {
  Study result;
  result.remarks = remarks_of(table, found);
  std::size_t runs = 0;
  for (const Record& record : found.records) runs = std::max(runs, record.runs.size());
  for (std::size_t run = 0; run < runs; ++run) {
    if (told) told("population", static_cast<double>(run) / static_cast<double>(runs));
    result.populations.push_back(population_of(cohort, table, pattern, found, run, catalogue));
  }
  if (cohort.diagnosis) {
    if (told) told("diagnosis", 0);
    result.diagnosis = study_diagnosis(cohort, table, found, catalogue, results);
  }
  if (result.populations.empty()) return result;
  const Members& members = result.populations.front().members;
  constexpr std::size_t enough_animals = 4;
  if (!members.animals.empty() && members.animals.size() < enough_animals)
    result.remarks.push_back(
        {RemarkKind::few_animals,
         fmt::format("the specimens come from {} animals: intervals of a typical specimen are wide, "
                     "because they are to hold for other animals too. Effects within animals are "
                     "known better",
                     members.animals.size())});
  for (const std::string& refusal : members.refusals)
    result.remarks.push_back({RemarkKind::factor_not_compared, refusal});
  return result;
}

}  // namespace tunica::cohort
