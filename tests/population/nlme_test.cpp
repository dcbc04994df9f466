// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "population/population.hpp"
#include "population/simulated.hpp"

using namespace tunica::population;

namespace {

const std::string nlme_folder = std::string(TUNICA_SOURCE_DIR) + "/tests/population/";

/// nlme_data.csv; nested: with its animals.
Cohort nlme_cohort(bool nested) {
  std::ifstream file(nlme_folder + "nlme_data.csv");
  std::string line;
  std::getline(file, line);
  std::map<std::string, std::vector<double>> stress;
  std::map<std::string, std::pair<std::string, std::size_t>> row;
  while (std::getline(file, line)) {
    std::stringstream fields(line);
    std::string animal, specimen, treated, strain, value;
    for (std::string* field : {&animal, &specimen, &treated, &strain, &value}) std::getline(fields, *field, ',');
    stress[specimen].push_back(std::stod(value));
    row[specimen] = {animal, treated == "1"};
  }
  simulated::Measured measured{&simulated::exponential(), {}};
  for (const auto& [specimen, values] : stress)
    measured.y.push_back(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  Cohort cohort = simulated::cohort_of(measured);
  cohort.misfits = {};  // nlme knows the linearised curves only
  cohort.factors = {{"treated", {"0", "1"}}};
  std::map<std::string, std::size_t> animals;
  std::size_t i = 0;
  for (const auto& [specimen, own] : row) {
    cohort.specimens[i].levels = {own.second};
    cohort.specimens[i++].animal = animals.try_emplace(own.first, animals.size()).first->second;
  }
  for (const auto& [animal, number] : animals)
    if (nested) cohort.animals.push_back(animal);
  return cohort;
}

nlohmann::json nlme_figures() { return nlohmann::json::parse(std::ifstream(nlme_folder + "nlme_reference.json")); }

void expect_means(const Population& found, const nlohmann::json& reference) {
  for (std::size_t k = 0; k < found.coefficients.size(); ++k) {
    const double mean = reference["mean"][k], error = reference["standard_error"][k];
    EXPECT_NEAR(found.coefficients[k].value, mean, 0.01 * std::abs(mean)) << k;
    EXPECT_NEAR(found.coefficients[k].standard_error, error, 0.1 * error) << k;
  }
  const double noise = reference["noise"];
  EXPECT_NEAR(std::sqrt(found.noise[0]) * simulated::exponential().noise[0], noise, 0.01 * noise);
}

Options diagonal(std::vector<std::size_t> factors) {
  Options options;
  options.factors = std::move(factors);
  options.within = options.between = Shape::diagonal;
  return options;
}

}  // namespace

// The peer: nlme 3.1-162 of R 4.2.2, figures of nlme_reference.R. It says which function gives which figure, and why.
TEST(Nlme, AgreesOnMeansErrorsAndSpreadsOfTwoGroups) {
  const Population found = estimate(nlme_cohort(false), diagonal({0}));
  const auto reference = nlme_figures()["treated"];
  expect_means(found, reference);
  for (std::size_t j = 0; j < 2; ++j)
    EXPECT_NEAR(found.spreads[j].value, reference["spread"][j], 0.002 * reference["spread"][j].get<double>());
  EXPECT_NEAR(found.reml.deviance, -2 * reference["restricted_log_likelihood"].get<double>(), 0.01);
  EXPECT_NEAR(found.ml->deviance, -2 * reference["full_log_likelihood"].get<double>(), 0.01);
}

TEST(Nlme, AgreesOnSpecimensWithinAnimals) {
  const Population found = estimate(nlme_cohort(true), diagonal({}));
  const auto reference = nlme_figures()["nested"];
  expect_means(found, reference);
  for (const Spread& spread : found.spreads) {
    const double own = reference[spread.between ? "spread_animal" : "spread_specimen"][spread.parameter];
    EXPECT_NEAR(spread.value, own, 0.002 * own);
  }
  EXPECT_NEAR(found.reml.deviance, -2 * reference["restricted_log_likelihood"].get<double>(), 0.01);
}
