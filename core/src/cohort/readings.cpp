// SPDX-License-Identifier: Apache-2.0
#include "cohort/readings.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "cohort/index.hpp"
#include "tunica/random.hpp"

namespace tunica::cohort {

namespace {

struct OwnReading {
  double value = 0, variance = 0;
  std::string unit, problem;
};

OwnReading own_reading(const ReadingEntry& entry, SpecimenLikelihood& specimen) {
  const LinearReading linear = specimen.reading(entry);
  OwnReading own{0, 0, linear.unit, linear.problem};
  if (!own.problem.empty()) return own;
  Eigen::VectorXd predictions, residuals;
  Eigen::MatrixXd by_prediction, J;
  Status status = specimen.predict(specimen.best(), predictions, &by_prediction);
  if (status.ok()) status = specimen.residuals(specimen.best(), residuals, &J);
  if (!status.ok()) {
    own.problem = status.reason();
    return own;
  }
  Eigen::VectorXd g = Eigen::VectorXd::Zero(by_prediction.cols());
  for (const auto& [at, weight] : linear.weights) {
    own.value += weight * predictions[index(at)];
    g += weight * by_prediction.row(index(at)).transpose();
  }
  const Eigen::MatrixXd information = J.transpose() * J;
  own.variance = g.dot(information.completeOrthogonalDecomposition().solve(g));
  return own;
}

/// The design of some of the specimens. Factors that lose all but one level are dropped with them.
Design part_of(const Design& design, const std::vector<std::size_t>& chosen) {
  Design part = design;
  part.rows.resize(index(chosen.size()), design.rows.cols());
  part.specimens.clear();
  part.animals.clear();
  for (DesignFactor& factor : part.factors) factor.columns.of.clear();
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    part.rows.row(index(k)) = design.rows.row(index(chosen[k]));
    part.specimens.push_back(design.specimens[chosen[k]]);
    part.animals.push_back(design.animals[chosen[k]]);
    for (std::size_t f = 0; f < design.factors.size(); ++f)
      part.factors[f].columns.of.push_back(design.factors[f].columns.of[chosen[k]]);
  }
  std::vector<std::size_t> animals = part.animals;
  std::sort(animals.begin(), animals.end());
  part.animal_count = static_cast<std::size_t>(std::unique(animals.begin(), animals.end()) - animals.begin());
  for (std::size_t f = part.factors.size(); f-- > 0;) {
    const auto& of = part.factors[f].columns.of;
    std::vector<bool> present(part.factors[f].levels.size(), false);
    for (const std::size_t level : of) present[level] = true;
    if (std::find(present.begin(), present.end(), false) != present.end()) part = part.without(f);
  }
  return part;
}

void analyse_reading(const Specification& cohort, const Design& design, const std::vector<OwnReading>& own,
                     const std::vector<std::size_t>& chosen, ReadingStudy& study) {
  const Design part = part_of(design, chosen);
  if (chosen.size() < 2 || part.rows.colPivHouseholderQr().rank() < part.rows.cols() ||
      part.rows.cols() >= part.rows.rows())
    return;
  const bool positive = std::all_of(chosen.begin(), chosen.end(), [&](std::size_t i) { return own[i].value > 0; });
  double scale = 0;  // spreads are searched for between fixed limits
  for (const std::size_t i : chosen) scale = std::max(scale, std::abs(own[i].value));
  if (positive || scale == 0) scale = 1;
  std::vector<population::Individual> individuals;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const OwnReading& one = own[chosen[k]];
    const double xi = positive ? std::log(one.value) : one.value / scale;
    const double sd = std::sqrt(one.variance) / (positive ? one.value : scale);
    constexpr double least_sd = 1e-6;  // a reading that the fit knows exactly
    population::Individual individual;
    individual.data.information = Eigen::MatrixXd::Constant(1, 1, std::pow(std::max(sd, least_sd), -2));
    individual.data.mode = Eigen::VectorXd::Constant(1, xi);
    individual.design = part.rows.row(index(k)).transpose();
    individual.animal = part.animals[k];
    individuals.push_back(std::move(individual));
  }
  const population::Structure structure{false, part.nested()};
  const population::Estimates estimates = population::estimate(individuals, structure);
  const auto null = [&](std::size_t factor) {
    NullModel without{individuals, {}};
    const Design reduced = part.without(factor);
    for (std::size_t k = 0; k < individuals.size(); ++k)
      without.individuals[k].design = reduced.rows.row(index(k)).transpose();
    without.estimates = population::estimate(without.individuals, structure);
    return without;
  };
  study.analysis = analyse({{study.entry.name, own[chosen.front()].unit, positive ? Scale::log : Scale::linear}},
                           {part, structure, individuals, estimates, null, cohort.permutations,
                            derive_seed(cohort.seed, "permutations of reading " + study.entry.name)});
  if (positive) return;
  const auto enlarge = [scale](Estimated& one) { one = {one.value * scale, one.lower * scale, one.upper * scale}; };
  for (Estimated& one : study.analysis->means.front()) enlarge(one);
  for (Effect& effect : study.analysis->effects) enlarge(effect.size);
  for (Spread& spread : study.analysis->spreads) {
    spread.sd *= scale;
    spread.lower *= scale;
    if (spread.upper) *spread.upper *= scale;
    spread.of_animals *= scale;
  }
  for (Planning& planning : study.analysis->planning) planning.detectable *= scale;
}

}  // namespace

std::vector<ReadingStudy> study_readings(const Specification& cohort, const Design& design, Likelihoods& likelihoods) {
  std::vector<std::vector<OwnReading>> own(cohort.readings.size(), std::vector<OwnReading>(likelihoods.count()));
  likelihoods.for_each([&](std::size_t i, SpecimenLikelihood& specimen) {
    for (std::size_t r = 0; r < cohort.readings.size(); ++r) own[r][i] = own_reading(cohort.readings[r], specimen);
  });
  std::vector<ReadingStudy> studies;
  for (std::size_t r = 0; r < cohort.readings.size(); ++r) {
    ReadingStudy study{cohort.readings[r], {}, {}, {}, {}};
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < own[r].size(); ++i) {
      const OwnReading& one = own[r][i];
      if (!one.problem.empty()) {
        study.missing.emplace_back(design.specimens[i], one.problem);
        continue;
      }
      chosen.push_back(i);
      const double half = 1.96 * std::sqrt(one.variance);
      study.specimens.push_back(design.specimens[i]);
      study.values.push_back({one.value, one.value - half, one.value + half});
    }
    analyse_reading(cohort, design, own[r], chosen, study);
    studies.push_back(std::move(study));
  }
  return studies;
}

}  // namespace tunica::cohort
