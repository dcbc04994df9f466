// SPDX-License-Identifier: Apache-2.0
// Fit, intervals and profiles read one noise and one objective.
#include <atomic>
#include <cmath>
#include <random>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "assembly/misfit.hpp"
#include "assembly/whitening.hpp"
#include "tunica/random.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/local.hpp"
#include "uncertainty/profile.hpp"

using namespace tunica;
using experiment::ObjectiveType;

namespace {

/// What one of many random fits is made of.
struct Case {
  ObjectiveType objective;
  bool states_noise;
  double misfit;  ///< of the second test, in units of its noise: the model cannot follow it
};

/// y = a + b x + c x² in two tests of different size and noise; `k` chooses data and case.
struct Random : fakes::Bench {
  Random(std::size_t k, const Case& chosen) {
    std::mt19937_64 generator(derive_seed(16, fmt::format("random fit {}", k)));
    std::normal_distribution<double> normal;
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(generator() >> 11) * 0x1p-53;
    };
    const double a = between(1, 9), b = std::exp(between(-1, 1)), size = std::exp(between(-5, 0));
    parameter("c").fixed = 0;
    for (const auto& [name, last, count, share] :
         {std::tuple{"s", 1.0, std::size_t{12}, 1.0}, {"t", 5.0, std::size_t{18}, 4.0}}) {
      const auto x = fakes::grid(0.1, last, count);
      const double sd = share * size, wrong = name[0] == 't' ? chosen.misfit * sd : 0;
      auto& test = add_test(name, x, fakes::map(x, [&](double at) {
                              return a + b * at + wrong * std::sin(3 * at) + sd * normal(generator);
                            }));
      if (chosen.states_noise) test.data.noise = {{"y", {sd, 0, 0}}};
    }
    run.objective = chosen.objective;
  }
};

/// The point that a run would end at: the least of its own objective.
std::vector<double> fitted(const assembly::Assembly& assembly, std::vector<double> start) {
  uncertainty::RefitObjective target;
  target.blocks = assembly.layout().blocks;
  target.residual_count = assembly.layout().residual_count;
  target.evaluate = [&assembly](std::span<const double> free, double& objective, std::span<double> residuals,
                                std::span<double> jacobian, assembly::Workspace& workspace) {
    return assembly.evaluator().evaluate(free, objective, {}, residuals, jacobian, workspace);
  };
  const auto workspace = assembly.evaluator().make_workspace();
  return uncertainty::refit(assembly, target, trial::local(), start, {}, 1, *workspace).free;
}

}  // namespace

// Three objectives, noise stated or not, a model that is right or misses the second test by ten times its noise.
TEST(OneNoise, TheEstimateLiesInItsProfileIntervalInAThousandOfAThousandRandomFits) {
  constexpr std::size_t fits = 1000;
  std::atomic<int> inside = 0, intervals = 0, closed = 0;
  tbb::parallel_for(std::size_t{0}, fits, [&](std::size_t k) {
    constexpr ObjectiveType objectives[] = {ObjectiveType::least_squares, ObjectiveType::standardised_quadratic,
                                            ObjectiveType::sum_of_norms};
    const Random random(k, {objectives[k % 3], k / 3 % 2 == 0, k / 6 % 2 == 0 ? 0.0 : 10.0});
    const auto assembly = random.assemble();
    const std::vector<double> best = fitted(assembly, {5, 1});
    ASSERT_EQ(best.size(), 2u);
    const auto likelihood = uncertainty::likelihood_at(assembly, best, trial::local(), k);
    ASSERT_TRUE(likelihood.centre.status.ok()) << likelihood.centre.status.reason();
    for (const auto& profile : uncertainty::profiles(assembly, likelihood, trial::local(), {0, 1}, k)) {
      const double value = best[profile.parameter];
      using Kind = uncertainty::Profile::End::Kind;
      const auto reaches = [](const auto& end) { return end.kind == Kind::open; };
      ++intervals;
      closed += profile.lower.kind == Kind::crossed && profile.upper.kind == Kind::crossed;
      inside += (reaches(profile.lower) || profile.lower.value < value) &&
                (reaches(profile.upper) || value < profile.upper.value);
    }
  });
  EXPECT_EQ(intervals, 2 * static_cast<int>(fits));
  EXPECT_EQ(inside, intervals);
  EXPECT_GT(closed, 1.5 * fits) << "open sides hold everything";
}

// To first order a profile ends where the linearised interval does, whatever the objective: for a model that is linear
// (a, and b held at its value) the two of a quadratic objective are equal.
TEST(OneNoise, ProfilesEndWhereLinearisedIntervalsDo) {
  for (const auto objective : {ObjectiveType::least_squares, ObjectiveType::standardised_quadratic})
    for (const bool states : {true, false}) {
      Random random(7, {objective, states, 0.0});
      random.parameter("b").fixed = 1;
      random.parameter("c").fixed = std::nullopt;
      const auto assembly = random.assemble();
      const std::vector<double> best = fitted(assembly, {5, 0.1});
      const auto likelihood = uncertainty::likelihood_at(assembly, best, trial::local(), 1);
      uncertainty::Identifiability linear;
      ASSERT_TRUE(uncertainty::identify(assembly, best, linear).ok());
      for (const auto& profile : uncertainty::profiles(assembly, likelihood, trial::local(), {0, 1}, 1)) {
        const auto& interval = linear.parameters[profile.parameter];
        ASSERT_TRUE(interval.identified);
        const double half = (interval.upper - interval.lower) / 2;
        EXPECT_NEAR(profile.lower.value, interval.lower, 5e-3 * half);
        EXPECT_NEAR(profile.upper.value, interval.upper, 5e-3 * half);
      }
    }
}

// 2000 data sets of a right model with stated noise: at most 10 are said to contradict it with probability 0.999998,
// the chance of each being 1e-3 at most (a Poisson of mean 2). Seed 16.
TEST(OneNoise, ARightModelContradictsItsNoiseNoMoreThanOnceInAThousand) {
  std::atomic<int> contradicted = 0, small = 0;
  constexpr std::size_t sets = 2000;
  tbb::parallel_for(std::size_t{0}, sets, [&](std::size_t k) {
    const Random random(k, {ObjectiveType::least_squares, true, 0.0});
    const auto assembly = random.assemble();
    const std::vector<double> best = fitted(assembly, {5, 1});
    std::vector<double> predictions(assembly.layout().prediction_count);
    const auto workspace = assembly.evaluator().make_workspace();
    ASSERT_TRUE(assembly.evaluator().predict(best, predictions, {}, *workspace).ok());
    const auto found = assembly::misfit(assembly, assembly::NoiseKind::stated, predictions);
    contradicted += found.contradicts();
    small += found.chance < 0.1;
    EXPECT_EQ(assembly::whitening(assembly, predictions).widening > 1, found.contradicts());
  });
  EXPECT_LE(contradicted, 10);
  // The chance is uniform: 200 ± 4 · 13.4 below a tenth.
  EXPECT_NEAR(small, 200, 54);
}

TEST(OneNoise, IntervalsAreWiderByTheRootOfChiSquaredWhereItContradicts) {
  trial::Line line;  // residuals ± 0.1 at the optimum (1, 2), 8 rows, 2 parameters
  const auto half_width = [&](double sd) {
    line.experiment.tests[0].data.noise = {{"y", {sd, 0, 0}}};
    const auto assembly = line.assemble();
    uncertainty::Identifiability found;
    EXPECT_TRUE(uncertainty::identify(assembly, std::vector{1.0, 2.0}, found).ok());
    return found.parameters[0].ci95;
  };
  const double shape = std::sqrt(1.0 / 8 + 3.5 * 3.5 / 42), t = 2.446912, s = std::sqrt(8 * 0.01 / 6);
  EXPECT_NEAR(half_width(0.1), 1.959964 * 0.1 * shape, 1e-6) << "χ²/ν = 8/6";
  EXPECT_NEAR(half_width(0.01), t * s * shape, 1e-6) << "χ²/ν = 133: σ is that of the residuals";
}

TEST(OneNoise, ChiSquaredIsTheSumOfWhitenedSquares) {
  trial::Line line;
  line.experiment.tests[0].data.noise = {{"y", {0.05, 0, 0}}};
  const auto assembly = line.assemble();
  std::vector<double> predictions(8);
  const auto workspace = assembly.evaluator().make_workspace();
  ASSERT_TRUE(assembly.evaluator().predict(std::vector{1.0, 2.0}, predictions, {}, *workspace).ok());
  const auto found = assembly::misfit(assembly, assembly::NoiseKind::stated, predictions);
  EXPECT_NEAR(found.chi_square, 32, 1e-9);
  EXPECT_EQ(found.rows, 8u);
  EXPECT_NEAR(found.freedom, 6, 1e-12);
  EXPECT_NEAR(found.chance, cdf(complement(boost::math::chi_squared(6), 32)), 1e-12);
  EXPECT_TRUE(found.contradicts());
  EXPECT_FALSE(assembly::misfit(assembly, assembly::NoiseKind::estimated, predictions).judged());
}
