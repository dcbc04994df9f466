// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "population/alternation.hpp"
#include "population/simulated.hpp"

using namespace tunica::population;

namespace {

/// 9 sheets of 3 animals with a factor, expanded about the mean of the cohort.
struct Case {
  Cohort cohort;
  Design design;
  std::vector<Expansion> expansions;

  explicit Case(bool nested) {
    simulated::Normal normal(21);
    std::vector<Eigen::VectorXd> xi;
    for (int i = 0; i < 9; ++i) xi.push_back(simulated::sheet().typical + 0.3 * normal.vector(5));
    cohort = simulated::cohort(simulated::sheet(), xi, normal);
    cohort.factors = {{"side", {"left", "right"}}};
    if (nested) cohort.animals = {"a", "b", "c"};
    for (std::size_t i = 0; i < 9; ++i) {
      cohort.specimens[i].levels = {i % 2};
      cohort.specimens[i].animal = i / 3;
    }
    design = tunica::population::design(cohort, {0});
    for (std::size_t i = 0; i < 9; ++i)
      expansions.push_back(*cohort.expand(i, {cohort.start, 4 * Eigen::MatrixXd::Identity(5, 5), {1, 1}}));
  }
};

void expect_gradient(const Case& own, Shape within, std::optional<Shape> between, Likelihood likelihood,
                     bool zero_spread) {
  const Coordinates coordinates(own.cohort, within, between);
  const LinearModel model(own.cohort, own.design, own.expansions, likelihood);
  simulated::Normal normal(4);
  std::vector<double> x = coordinates.start({1.2, 0.8});
  for (double& value : x) value += 0.1 * normal();
  if (zero_spread) x[1] = 0;
  std::vector<double> exact(x.size());
  VarianceGradient by_variance;
  model.value(coordinates.variances(x), &by_variance);
  coordinates.chain(x, by_variance, exact.data());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double step = 1e-4;
    const auto at = [&](double away) {
      std::vector<double> moved = x;
      moved[k] += away;
      return model.value(coordinates.variances(moved));
    };
    const double difference = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
    EXPECT_NEAR(exact[k], difference, 1e-5 * (1 + std::abs(difference))) << "coordinate " << k;
  }
}

}  // namespace

TEST(VarianceGradient, IsThatOfFiniteDifferences) {
  for (const Likelihood likelihood : {Likelihood::full, Likelihood::restricted})
    for (const Shape shape : {Shape::diagonal, Shape::full}) {
      expect_gradient(Case(false), shape, {}, likelihood, false);
      expect_gradient(Case(true), shape, Shape::diagonal, likelihood, false);
      expect_gradient(Case(true), Shape::diagonal, shape, likelihood, true);
    }
}
