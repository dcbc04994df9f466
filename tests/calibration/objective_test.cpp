// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numeric>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assembly/noise.hpp"
#include "calibration/fakes.hpp"

namespace tunica {
namespace {

using assembly::Assembly;
using experiment::ObjectiveType;
using fakes::Bench;
using testing::HasSubstr;

struct Evaluation {
  double objective = 0;
  std::vector<double> per_test, residuals, jacobian;
};

Evaluation evaluate(const Assembly& assembly, const std::vector<double>& free) {
  Evaluation e{0, std::vector<double>(assembly.layout().test_count),
               std::vector<double>(assembly.layout().residual_count),
               std::vector<double>(assembly.layout().residual_count * free.size())};
  const auto workspace = assembly.evaluator().make_workspace();
  const Status status =
      assembly.evaluator().evaluate(free, e.objective, e.per_test, e.residuals, e.jacobian, *workspace);
  EXPECT_TRUE(status.ok()) << status.reason();
  return e;
}

/// Σ w ρ(‖r‖²) as tunica/optimizer.hpp promises it to optimisers.
double from_blocks(const Assembly& assembly, const std::vector<double>& residuals) {
  double sum = 0;
  for (const ResidualBlock& block : assembly.layout().blocks) {
    double s = 0;
    for (std::size_t i = 0; i < block.size; ++i) s += std::pow(residuals[block.offset + i], 2);
    constexpr double epsilon = Problem::root_smoothing;
    const bool root = block.loss == ResidualBlock::Loss::root;
    sum += block.weight * (root ? std::sqrt(s + epsilon * epsilon) - epsilon : s);
  }
  return sum;
}

/// Two tests, the first with two channels of weights 1 and 3, with rows held out in the middle.
void fill(Bench& bench) {
  auto& first = bench.add_test("s", {0, 1, 2, 3, 4}, {1, 2.5, 3, 4, 6}, true);
  first.weights = {1, 3};
  first.hold_out.rows = {1, 3, 1};
  bench.add_test("t", {0, 2, 5}, {1, 3, 9});
}

class Objective : public testing::TestWithParam<ObjectiveType> {};

TEST_P(Objective, IsTheSumOverItsResidualBlocks) {
  Bench bench;
  fill(bench);
  bench.run.objective = GetParam();
  for (auto& test : bench.experiment.tests) {
    test.data.noise = {{"y", {0.5, 0.1, test.name == "s" ? 0.4 : 0.0}}, {"z", {0.5, 0, 0}}};
  }
  if (GetParam() == ObjectiveType::least_squares) bench.parameter("b").prior = {2, 0.5};
  const Assembly assembly = bench.assemble();
  const Evaluation e = evaluate(assembly, {1.5, 0.5, 0.25});
  EXPECT_NEAR(from_blocks(assembly, e.residuals), e.objective, 1e-12 * e.objective);
  const double priors = GetParam() == ObjectiveType::least_squares ? std::pow((0.5 - 2) / 0.5, 2) : 0;
  EXPECT_NEAR(e.per_test[0] + e.per_test[1] + priors, e.objective, 1e-12 * e.objective);
}

TEST_P(Objective, HasTheJacobianOfItsResiduals) {
  Bench bench;
  fill(bench);
  bench.run.objective = GetParam();
  bench.experiment.tests[0].mechanisms = {{"scale_error", {}, {}}};
  for (auto& test : bench.experiment.tests) test.data.noise = {{"y", {0.5, 0.1, 0.4}}, {"z", {0.5, 0, 0}}};
  bench.parameter("b").prior = {2, 0.5};
  bench.parameter("a").share = "both";
  bench.parameter("c").share = "both";
  const Assembly assembly = bench.assemble();
  const std::vector<double> at{0.7, 1.3, 0.2};  // both, b, s.scale_error.value
  const Evaluation e = evaluate(assembly, at);
  for (std::size_t j = 0; j < at.size(); ++j) {
    std::vector<double> up = at, down = at;
    up[j] += 1e-4;
    down[j] -= 1e-4;
    const Evaluation above = evaluate(assembly, up), below = evaluate(assembly, down);
    for (std::size_t i = 0; i < e.residuals.size(); ++i) {
      const double difference = (above.residuals[i] - below.residuals[i]) / 2e-4;
      EXPECT_NEAR(e.jacobian[i * at.size() + j], difference, 1e-8 * (1 + std::abs(difference))) << i << " by " << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Objective,
                         testing::Values(ObjectiveType::standardised_quadratic, ObjectiveType::least_squares,
                                         ObjectiveType::sum_of_norms));

TEST(StandardisedQuadratic, DividesTheMeanSquareByTheRangeOfTheFittedRows) {
  Bench bench;
  auto& entry = bench.add_test("t", {0, 1, 2}, {1, 3, 100});
  entry.hold_out.rows = {2, {}, 1};
  entry.weights = {4};
  const Assembly assembly = bench.assemble();
  // a + b x at a = 2, b = 3: 2, 5 against 1, 3; range 2.
  EXPECT_NEAR(evaluate(assembly, {2, 3, 0}).objective, 4 * (0.5 * (1 + 4)) / 2, 1e-14);
  EXPECT_EQ(assembly.layout().channels[0].fitted, (std::vector<bool>{true, true, false}));
  EXPECT_EQ(assembly.layout().prediction_count, 3u);
  EXPECT_EQ(assembly.layout().residual_count, 2u);
}

TEST(StandardisedQuadratic, RefusesAChannelWithoutRange) {
  Bench bench;
  bench.add_test("t", {0, 1, 2}, {2, 2, 2});
  const std::string message = fakes::message_of([&] { static_cast<void>(bench.assemble()); });
  EXPECT_THAT(message, HasSubstr("test 't', channel 'y'"));
  EXPECT_THAT(message, HasSubstr("all 3 fitted rows measure 2"));
}

TEST(SumOfNorms, IsSmoothAtAPerfectFitAndTheNormElsewhere) {
  Bench bench;
  bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  bench.run.objective = ObjectiveType::sum_of_norms;
  const Assembly assembly = bench.assemble();
  EXPECT_EQ(evaluate(assembly, {1, 1, 0}).objective, 0);
  EXPECT_NEAR(evaluate(assembly, {4, 1, 0}).objective, std::sqrt(27), 1e-8);
}

TEST(LeastSquares, WeighsByTheStatedNoiseOfEachRow) {
  Bench bench;
  auto& entry = bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  entry.data.noise = {{"y", {0.3, 0.4, 0}}};
  bench.run.objective = ObjectiveType::least_squares;
  // e = 1, 1, 1 with σ² = 0.09 + 0.16 y².
  const double expected = 1 / 0.25 + 1 / (0.09 + 0.64) + 1 / (0.09 + 1.44);
  EXPECT_NEAR(evaluate(bench.assemble(), {2, 1, 0}).objective, expected, 1e-12);
}

TEST(LeastSquares, WhitensCorrelatedNoise) {
  Bench bench;
  auto& entry = bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  entry.data.noise = {{"y", {2, 0, 0.5}}};
  bench.run.objective = ObjectiveType::least_squares;
  // eᵀ Σ⁻¹ e with Σ = 4·0.5^|i−j|, whose inverse is (1/4)/(1 − φ²) [1 −φ 0; −φ 1+φ² −φ; 0 −φ 1]; e = 1, 1, 1.
  const double expected = 0.25 / 0.75 * (1 + 1.25 + 1 - 4 * 0.5);
  EXPECT_NEAR(evaluate(bench.assemble(), {2, 1, 0}).objective, expected, 1e-12);
}

TEST(LeastSquares, AddsPriorsAsOneMoreBlock) {
  Bench bench;
  auto& entry = bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  entry.data.noise = {{"y", {1, 0, 0}}};
  bench.run.objective = ObjectiveType::least_squares;
  bench.parameter("c").prior = {1, 0.25};
  const Assembly assembly = bench.assemble();
  ASSERT_EQ(assembly.layout().blocks.size(), 2u);
  EXPECT_NEAR(evaluate(assembly, {1, 1, 0}).objective, 16, 1e-12);
  EXPECT_EQ(evaluate(assembly, {1, 1, 0}).per_test[0], 0);
}

TEST(OtherObjectives, SayThatTheyDoNotUseAPrior) {
  Bench bench;
  bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  bench.parameter("c").prior = {1, 0.25};
  const Assembly assembly = bench.assemble();
  EXPECT_EQ(assembly.layout().blocks.size(), 1u);
  EXPECT_THAT(assembly.layout().warnings, testing::Contains(HasSubstr("the prior of 'c' is not used")));
}

TEST(HoldOut, OfAWholeTestLeavesItOutOfTheObjectiveAndInThePredictions) {
  Bench bench;
  bench.add_test("s", {0, 1, 2}, {1, 2, 3});
  bench.add_test("t", {0, 1, 2}, {5, 6, 7}).hold_out.all = true;
  const Assembly assembly = bench.assemble();
  EXPECT_EQ(assembly.layout().blocks.size(), 1u);
  EXPECT_EQ(assembly.layout().prediction_count, 6u);
  const Evaluation e = evaluate(assembly, {1, 1, 0});
  EXPECT_EQ(e.objective, 0);
  EXPECT_EQ(e.per_test[1], 0);
}

data::Channel channel(std::vector<double> values) { return {"y", "kPa", std::move(values), {}, {}}; }

TEST(Noise, IsEstimatedFromDifferencesOnAnUnevenGridWithTurningPoints) {
  // 4000 rows up and down again, slope 3, σ = 0.2. The relative standard error of the estimate is about
  // √(35/36 / 4000)/… < 2 %; 8 % is beyond four of them: false alarms below 1e-4. Seed 5.
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal(0, 0.2);
  std::uniform_real_distribution<double> gap(0.1, 1);
  std::vector<double> x{0}, y{normal(generator)};
  for (std::size_t i = 1; i < 4000; ++i) {
    x.push_back(x.back() + (i < 2000 ? 1 : -1) * gap(generator));
    y.push_back(3 * x.back() + normal(generator));
  }
  std::vector<std::string> warnings;
  const auto noise = assembly::noise_model(channel(y), x, std::vector<bool>(x.size(), true), "test 't'", warnings);
  EXPECT_TRUE(noise.estimated);
  EXPECT_NEAR(noise.sd[0], 0.2, 0.016);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("differences of neighbouring rows"));
}

TEST(Noise, IsPooledOverReplicatesAndHalvedInVarianceByAMeanOfTwo) {
  data::Channel replicated = channel({1, 2});
  replicated.replicates = {{0.9, 2.1}, {1.1, 1.9}};
  std::vector<std::string> warnings;
  const std::vector<double> x{0, 1};
  const auto noise = assembly::noise_model(replicated, x, {true, true}, "test 't'", warnings);
  EXPECT_NEAR(noise.sd[1], std::sqrt(0.02 / 2), 1e-15);
  EXPECT_THAT(warnings.at(0), HasSubstr("the replicates"));
  replicated.noise = data::Noise{0.4, 0, 0};
  EXPECT_NEAR(assembly::noise_model(replicated, x, {true, true}, "", warnings).sd[0], 0.4 / std::sqrt(2), 1e-15);
}

TEST(Noise, OfARowThatMeasuresZeroIsNeverZero) {
  data::Channel relative = channel({0, 1, 2});
  relative.noise = data::Noise{0, 0.1, 0};
  std::vector<std::string> warnings;
  const auto noise =
      assembly::noise_model(relative, std::vector<double>{0, 1, 2}, {true, true, true}, "test 't'", warnings);
  EXPECT_THAT(noise.sd, testing::ElementsAre(0.1, 0.1, 0.2));
  EXPECT_THAT(warnings.at(0), HasSubstr("row 0 measures 0"));
}

TEST(Noise, ThatMakesRowsAllButExactIsWarnedOf) {
  data::Channel relative = channel({1e-5, 3e-5, 1, 2, 3});
  const std::vector<double> x{0, 1, 2, 3, 4};
  const auto warnings_with = [&](data::Noise noise, std::vector<bool> fitted) {
    relative.noise = noise;
    std::vector<std::string> warnings;
    assembly::noise_model(relative, x, fitted, "test 't'", warnings);
    return warnings;
  };
  const std::vector<bool> all(5, true), without_first{false, true, true, true, true};
  EXPECT_THAT(warnings_with({0, 0.1, 0}, all),
              testing::ElementsAre(HasSubstr("makes 2 rows almost exact: σ = 1e-06 ")));
  EXPECT_THAT(warnings_with({0, 0.1, 0}, without_first), testing::ElementsAre(HasSubstr("makes a row almost exact")));
  EXPECT_TRUE(warnings_with({0.001, 0.1, 0}, all).empty());
  EXPECT_TRUE(warnings_with({0, 0.1, 0}, {false, false, true, true, true}).empty());
}

TEST(Noise, ThatCannotBeKnownIsRefused) {
  std::vector<std::string> warnings;
  const std::vector<double> x{0, 1, 2};
  const std::vector<bool> all(3, true);
  const auto refuse = [&](const data::Channel& of) {
    return fakes::message_of([&] { assembly::noise_model(of, x, all, "test 't', channel 'y'", warnings); });
  };
  EXPECT_THAT(refuse(channel({1, 2, 3})),
              HasSubstr("test 't', channel 'y': no noise is stated and none can be estimated"));
  data::Channel zero = channel({0, 0, 0});
  zero.noise = data::Noise{0, 0.1, 0};
  EXPECT_THAT(refuse(zero), HasSubstr("σ = 0 in every row; state noise.absolute"));
  data::Channel correlated = channel({1, 2, 3});
  correlated.noise = data::Noise{0.1, 0, 1};
  EXPECT_THAT(refuse(correlated), HasSubstr("noise.correlation 1 is not between -1 and 1"));
}

}  // namespace
}  // namespace tunica
