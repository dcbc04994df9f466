// SPDX-License-Identifier: Apache-2.0
#include "cohort/readings.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "cohort/index.hpp"
#include "population/readings.hpp"
#include "tunica/error.hpp"

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

/// The readings that two specimens have at least, in the form of the population.
struct Usable {
  std::vector<population::Reading> readings;
  std::vector<Coordinate> coordinates;
};

Usable usable(const Specification& cohort, const std::vector<std::vector<OwnReading>>& own) {
  Usable result;
  for (std::size_t r = 0; r < own.size(); ++r) {
    population::Reading reading{cohort.readings[r].name, true, {}};
    std::size_t count = 0;
    std::string unit;
    for (const OwnReading& one : own[r]) {
      if (!one.problem.empty()) {
        reading.values.emplace_back();
        continue;
      }
      ++count;
      unit = one.unit;
      reading.logarithmic = reading.logarithmic && one.value > 0;
      reading.values.push_back(population::Reading::Value{one.value, std::sqrt(one.variance)});
    }
    if (count < 2) continue;
    result.coordinates.push_back({reading.name, unit, reading.logarithmic ? Scale::log : Scale::linear});
    result.readings.push_back(std::move(reading));
  }
  return result;
}

}  // namespace

ReadingsStudy study_readings(const Specification& cohort, const Members& members, Likelihoods& likelihoods,
                             std::uint64_t seed) {
  std::vector<std::vector<OwnReading>> own(cohort.readings.size(), std::vector<OwnReading>(likelihoods.count()));
  likelihoods.for_each([&](std::size_t i, SpecimenLikelihood& specimen) {
    for (std::size_t r = 0; r < cohort.readings.size(); ++r) own[r][i] = own_reading(cohort.readings[r], specimen);
  });
  ReadingsStudy study;
  for (std::size_t r = 0; r < cohort.readings.size(); ++r) {
    ReadingStudy one{cohort.readings[r], {}, {}, {}};
    for (std::size_t i = 0; i < own[r].size(); ++i) {
      if (!own[r][i].problem.empty()) {
        one.missing.emplace_back(members.specimens[i], own[r][i].problem);
        continue;
      }
      const double half = 1.96 * std::sqrt(own[r][i].variance);
      one.specimens.push_back(members.specimens[i]);
      one.values.push_back({own[r][i].value, own[r][i].value - half, own[r][i].value + half});
    }
    study.readings.push_back(std::move(one));
  }
  const Usable all = usable(cohort, own);
  if (all.readings.empty()) {
    study.problem = cohort.readings.empty() ? "" : "no reading was made in two specimens";
    return study;
  }
  try {
    const population::Cohort of_readings = population::cohort_of_readings(members.cohort(), all.readings);
    population::Options options;
    options.factors = members.all_factors();
    options.within = population::Shape::diagonal;
    options.maximum_likelihood = false;
    study.analysis = analyse(all.coordinates, members, of_readings, population::estimate(of_readings, options),
                             cohort.permutations, seed);
  } catch (const InputError& reason) {
    study.problem = reason.what();
  }
  return study;
}

}  // namespace tunica::cohort
