// SPDX-License-Identifier: Apache-2.0
#include "cohort/study.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cohort/bands.hpp"
#include "cohort/index.hpp"
#include "cohort/readings.hpp"
#include "numerics/distributions.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"

namespace tunica::cohort {

namespace {

constexpr std::size_t fewest_specimens = 2;

std::vector<std::vector<ShrunkenParameter>> shrunken_parameters(const std::vector<Coordinate>& coordinates,
                                                                const PopulationFit& fit) {
  std::vector<std::vector<ShrunkenParameter>> all;
  for (std::size_t i = 0; i < fit.individuals.size(); ++i) {
    const population::Gaussian known = fit.shrunken(i);
    const Eigen::MatrixXd weight = Eigen::MatrixXd::Identity(known.mean.size(), known.mean.size()) -
                                   known.covariance * fit.individuals[i].data.information;
    auto& of_specimen = all.emplace_back();
    for (std::size_t j = 0; j < coordinates.size(); ++j) {
      const double xi = known.mean[index(j)];
      const double half = 1.96 * std::sqrt(std::max(0.0, known.covariance(index(j), index(j))));
      const Scale scale = coordinates[j].scale;
      of_specimen.push_back(
          {{from_coordinate(scale, xi), from_coordinate(scale, xi - half), from_coordinate(scale, xi + half)},
           std::clamp(weight(index(j), index(j)), 0.0, 1.0)});
    }
  }
  return all;
}

/// Of the distance of a specimen's own mode from its mean, with the covariance A⁻¹ + Ω:
/// d² = (m − μ)ᵀ W (m − μ), against χ² with the rank of W; Bonferroni over the specimens.
std::vector<Outlier> outliers_of(const Design& design, const PopulationFit& fit) {
  std::vector<Outlier> outliers;
  const auto n = static_cast<double>(fit.individuals.size());
  for (std::size_t i = 0; i < fit.individuals.size(); ++i) {
    const population::Individual& one = fit.individuals[i];
    const Eigen::MatrixXd W = population::about_mean(one.data, fit.estimates.omega).information;
    const Eigen::VectorXd away = one.data.mode - fit.estimates.mean(one.design) - fit.animal[i];
    const double distance = away.dot(W * away);
    const auto rank = static_cast<double>(W.fullPivLu().rank());
    if (rank < 1) continue;
    const double p = std::min(1.0, n * numerics::chi_squared_above(distance, rank));
    if (p < 0.05) outliers.push_back({design.specimens[i], p});
  }
  return outliers;
}

std::vector<Coordinate> coordinates_of(const Record::Run& run) {
  std::vector<Coordinate> coordinates;
  for (const Record::Parameter& one : run.parameters) coordinates.push_back({one.name, one.unit, one.scale});
  return coordinates;
}

void add_information(const PopulationFit& fit, PopulationStudy& result) {
  // Of maximum likelihood, so that models with other means can be compared.
  const population::Estimates ml = population::estimate(fit.individuals, fit.structure, {}, false);
  const auto parameters = static_cast<double>(ml.B.size()) + static_cast<double>(ml.spread_parameters);
  result.neg2_likelihood = ml.neg2_likelihood;
  result.aic = ml.neg2_likelihood + 2 * parameters;
  result.bic = ml.neg2_likelihood + parameters * std::log(static_cast<double>(fit.individuals.size()));
}

PopulationStudy population_of(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                              const Collection& found, std::size_t run, const plugins::Catalogue& catalogue) {
  PopulationStudy result;
  result.design = design_of(table, found);
  const Design& design = result.design;
  if (design.specimens.empty()) {
    result.problem = "no specimen was fitted";
    return result;
  }
  const Record::Run& first = found.records[design.specimens.front()].runs[run];
  result.run = first.label;
  result.model = first.model;
  result.parameters.coordinates = coordinates_of(first);
  if (design.specimens.size() < fewest_specimens) {
    result.problem = "one specimen says nothing of how specimens differ. Add others to the table";
    return result;
  }
  Likelihoods likelihoods(design.specimens.size(), [&](std::size_t i) {
    const std::size_t at = design.specimens[i];
    return std::make_unique<SpecimenLikelihood>(bind(cohort, pattern, table.specimens[at], catalogue), run,
                                                found.records[at].runs[run], catalogue);
  });
  const PopulationSettings settings{cohort.spread, cohort.noise};
  const PopulationFit fit = fit_population(likelihoods, design, settings);
  result.full = fit.structure.full;
  result.nested = fit.structure.nested;
  result.converged = fit.converged && fit.estimates.converged;
  result.rounds = fit.rounds;
  const auto null = [&](std::size_t factor) {
    PopulationSettings same = settings;
    same.spread = fit.structure.full ? SpreadStructure::full : SpreadStructure::diagonal;
    PopulationFit without = fit_population(likelihoods, design.without(factor), same);
    return NullModel{std::move(without.individuals), without.estimates};
  };
  result.parameters =
      analyse(coordinates_of(first), {design, fit.structure, fit.individuals, fit.estimates, null, cohort.permutations,
                                      derive_seed(cohort.seed, "permutations of " + result.run)});
  result.shrunken = shrunken_parameters(result.parameters.coordinates, fit);
  result.outliers = outliers_of(design, fit);
  result.readings = study_readings(cohort, design, likelihoods);
  result.bands = bands_of(design, fit, likelihoods, derive_seed(cohort.seed, "bands of " + result.run));
  if (cohort.noise == NoisePool::cohort) {
    const auto one = likelihoods.make(0);
    for (std::size_t c = 0; c < fit.noise.size(); ++c) result.noise.emplace_back(one->channels()[c], fit.noise[c]);
  }
  add_information(fit, result);
  return result;
}

}  // namespace

Study study(const Specification& cohort, const SpecimenTable& table, const Template& pattern, const Collection& found,
            const plugins::Catalogue& catalogue,
            const std::function<void(const std::string& stage, double share)>& told) {
  Study result;
  result.remarks = remarks_of(table, found);
  std::size_t runs = 0;
  for (const Record& record : found.records) runs = std::max(runs, record.runs.size());
  for (std::size_t run = 0; run < runs; ++run) {
    if (told) told("population", static_cast<double>(run) / static_cast<double>(runs));
    result.populations.push_back(population_of(cohort, table, pattern, found, run, catalogue));
  }
  if (result.populations.empty()) return result;
  const Design& design = result.populations.front().design;
  constexpr std::size_t enough_animals = 4;
  if (design.nested() && design.animal_count < enough_animals)
    result.remarks.push_back(
        {RemarkKind::few_animals,
         fmt::format("the specimens come from {} animals: intervals of a typical specimen are wide, "
                     "because they are to hold for other animals too. Effects within animals are "
                     "known better",
                     design.animal_count)});
  for (const std::string& refusal : design.refusals)
    result.remarks.push_back({RemarkKind::factor_not_compared, refusal});
  return result;
}

}  // namespace tunica::cohort
