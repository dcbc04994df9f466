// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/identifiability.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/fakes.hpp"
#include "uncertainty/valley_words.hpp"

namespace tunica {
namespace {

using fakes::Bench;
using testing::HasSubstr;
using uncertainty::Identifiability;

Identifiability identify(const Bench& bench, const std::vector<double>& free) {
  Identifiability found;
  const Status status = uncertainty::identify(bench.assemble(), free, found);
  EXPECT_TRUE(status.ok()) << status.reason();
  return found;
}

/// The line 1 + 2x with residuals ±0.1 that are orthogonal to constant and slope.
void add_line(Bench& bench, std::size_t count = 8) {
  const std::vector<double> x = fakes::grid(0, 7, count);
  std::vector<double> y;
  for (std::size_t i = 0; i < count; ++i) y.push_back(1 + 2 * x[i] + 0.1 * (i % 4 == 0 || i % 4 == 3 ? 1 : -1));
  bench.add_test("t", x, y);
}

TEST(Identifiability, GivesTheIntervalsOfLinearRegression) {
  Bench bench;
  bench.parameter("c").fixed = 0;
  add_line(bench);
  const Identifiability found = identify(bench, {1, 2});
  // Textbook: s² = Σe²/(n − 2), var b = s²/Σ(x − x̄)², var a = s² (1/n + x̄²/Σ(x − x̄)²); t(6; 0.975) = 2.4469.
  const double s = std::sqrt(8 * 0.01 / 6);
  EXPECT_NEAR(found.parameters[1].ci95, 2.446912 * s / std::sqrt(42), 1e-6);
  EXPECT_NEAR(found.parameters[0].ci95, 2.446912 * s * std::sqrt(1.0 / 8 + 3.5 * 3.5 / 42), 1e-6);
  EXPECT_TRUE(found.parameters[0].identified);
  EXPECT_TRUE(found.valleys.empty());
  EXPECT_TRUE(found.sentences().empty());
}

TEST(Identifiability, GivesTheIntervalOfTheFittedLine) {
  Bench bench;
  bench.parameter("c").fixed = 0;
  add_line(bench);
  const Identifiability found = identify(bench, {1, 2});
  // Textbook: var ŷ(x) = s² (1/n + (x − x̄)²/Σ(x − x̄)²).
  const double s = std::sqrt(8 * 0.01 / 6);
  ASSERT_EQ(found.curve_ci95.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    const double away = static_cast<double>(i) - 3.5;
    EXPECT_NEAR(found.curve_ci95[i], 2.446912 * s * std::sqrt(1.0 / 8 + away * away / 42), 1e-6) << i;
  }
}

TEST(Identifiability, TakesStatedNoiseInsteadOfResiduals) {
  Bench bench;
  bench.parameter("c").fixed = 0;
  add_line(bench);
  bench.experiment.tests[0].data.noise = {{"y", {0.5, 0, 0}}};
  EXPECT_NEAR(identify(bench, {1, 2}).parameters[1].ci95, 1.959964 * 0.5 / std::sqrt(42), 1e-6);
  // Correlation φ of neighbours: (XᵀΣ⁻¹X)⁻¹ for a constant alone is σ² (1 + φ)/(n − (n − 2) φ).
  bench.parameter("b").fixed = 2;
  bench.experiment.tests[0].data.noise = {{"y", {0.5, 0, 0.6}}};
  bench.run.objective = experiment::ObjectiveType::least_squares;  // which takes the correlation into account
  EXPECT_NEAR(identify(bench, {1}).parameters[0].ci95, 1.959964 * 0.5 * std::sqrt(1.6 / (8 - 6 * 0.6)), 1e-6);
}

TEST(Identifiability, CountsAPriorAsARow) {
  Bench bench;
  bench.parameter("b").fixed = 2;
  bench.parameter("c").fixed = 0;
  add_line(bench);
  bench.experiment.tests[0].data.noise = {{"y", {0.5, 0, 0}}};
  bench.parameter("a").prior = {1, 0.2};
  bench.run.objective = experiment::ObjectiveType::least_squares;
  EXPECT_NEAR(identify(bench, {1}).parameters[0].ci95, 1.959964 / std::sqrt(8 / 0.25 + 1 / 0.04), 1e-6);
}

TEST(Identifiability, NamesAnExactValleyAndWhatTheDataFixInIt) {
  Bench bench("valley");
  const std::vector<double> x = fakes::grid(0, 3, 12);
  bench.add_test("t", x, fakes::map(x, [](double v) { return 7 * v + 2 * v * v + 0.01 * std::sin(40 * v); }));
  const Identifiability found = identify(bench, {3, 1, 2});
  EXPECT_FALSE(found.parameters[0].identified);
  EXPECT_TRUE(std::isnan(found.parameters[0].ci95));
  EXPECT_TRUE(std::isnan(found.parameters[1].ci95));
  EXPECT_TRUE(found.parameters[2].identified);
  ASSERT_EQ(found.valleys.size(), 1u);
  const auto& valley = found.valleys[0];
  EXPECT_THAT(valley.parameters, testing::ElementsAre("p", "q"));
  EXPECT_TRUE(valley.exact);
  ASSERT_EQ(valley.directions.size(), 1u);
  ASSERT_EQ(valley.directions[0].size(), 2u);
  EXPECT_NEAR(valley.directions[0][1].second / valley.directions[0][0].second, -2, 1e-9);
  ASSERT_EQ(valley.fixed.size(), 1u);
  EXPECT_EQ(valley.fixed[0].name, "2p + q");
  EXPECT_NEAR(valley.fixed[0].value, 7, 1e-12);
  EXPECT_GT(valley.fixed[0].ci95, 1e-4);
  EXPECT_LT(valley.fixed[0].ci95, 0.1);
  ASSERT_EQ(found.sentences().size(), 1u);
  EXPECT_THAT(found.sentences()[0],
              testing::StartsWith("The data do not fix p and q separately: they fix 2p + q = 7.00"));
  EXPECT_THAT(
      found.sentences()[0],
      HasSubstr(
          "; one direction (p -4.47 kPa, q +8.94 kPa) changes no prediction. A test along another axis would fix it."));
}

TEST(Identifiability, GivesTheCombinationTheIntervalThatOneParameterInItsPlaceWouldHave) {
  Bench bench("valley");
  const std::vector<double> x = fakes::grid(0, 3, 12);
  bench.add_test("t", x, fakes::map(x, [](double v) { return 7 * v + 2 * v * v; })).data.noise = {{"y", {0.3, 0, 0}}};
  const double of_combination = identify(bench, {3, 1, 2}).valleys.at(0).fixed.at(0).ci95;
  bench.parameter("p").fixed = 3;
  EXPECT_NEAR(identify(bench, {1, 2}).parameters[0].ci95, of_combination, 1e-8 * of_combination);
}

TEST(Identifiability, NamesADirectionThatIsMerelyWeak) {
  Bench bench;
  // Within 1e-2 of x = 1 the data hardly tell a constant from a slope and a curvature.
  const std::vector<double> x = fakes::grid(0.99, 1.01, 9);
  bench.add_test("t", x, fakes::map(x, [](double v) { return 1 + 2 * v; })).data.noise = {{"y", {2, 0, 0}}};
  const Identifiability found = identify(bench, {1, 2, 0});
  ASSERT_EQ(found.valleys.size(), 1u);
  EXPECT_FALSE(found.valleys[0].exact);
  EXPECT_EQ(found.valleys[0].directions.size(), 2u);
  EXPECT_TRUE(found.valleys[0].fixed.empty());
  EXPECT_THAT(found.valleys[0].sentence,
              testing::StartsWith("The data do not fix a, b and c separately: two directions ("));
  EXPECT_THAT(found.valleys[0].sentence,
              HasSubstr("change the predictions so little that their uncertainty exceeds the bounds."));
}

TEST(Identifiability, LeavesAParameterItsIntervalWhereAWeakDirectionHardlyMovesIt) {
  Bench bench;
  const std::vector<double> x = fakes::grid(0, 0.3, 9);
  bench.add_test("t", x, fakes::map(x, [](double v) { return 1 + 2 * v; })).data.noise = {{"y", {0.3, 0, 0}}};
  const Identifiability found = identify(bench, {1, 2, 0});
  ASSERT_EQ(found.valleys.size(), 1u);
  EXPECT_FALSE(found.valleys[0].exact);
  EXPECT_THAT(found.valleys[0].parameters, testing::Not(testing::Contains("a")));
  EXPECT_THAT(found.valleys[0].parameters, testing::Contains("c"));
  // var a = σ² [(XᵀX)⁻¹]_aa for 1, x, x² at nine points: 0.66 σ², whatever the other two do.
  EXPECT_TRUE(found.parameters[0].identified);
  EXPECT_NEAR(found.parameters[0].ci95, 1.959964 * 0.3 * std::sqrt(0.6606), 1e-3);
  EXPECT_TRUE(std::isnan(found.parameters[2].ci95));
}

TEST(Identifiability, LeavesOutChannelsOfWeightZero) {
  Bench bench;
  bench.parameter("c").fixed = 0;
  const std::vector<double> x = fakes::grid(0, 7, 8);
  auto& entry = bench.add_test("t", x, fakes::map(x, [](double v) { return 1 + 2 * v; }), true);
  entry.data.noise = {{"y", {0.5, 0, 0}}, {"z", {0.5, 0, 0}}};
  entry.weights = {1, 0};
  EXPECT_NEAR(identify(bench, {1, 2}).parameters[1].ci95, 1.959964 * 0.5 / std::sqrt(42), 1e-6);
}

TEST(Identifiability, SaysWhenAParameterHasNoEffectAtAll) {
  Bench bench;
  bench.add_test("t", {0, 1, 2, 3}, {1, 2.1, 2.9, 4}).mechanisms = {{"offset", {}, {}}};
  bench.experiment.tests[0].hold_out.rows = {1, {}, 1};  // only x = 0 is left: b and c do nothing, a is the offset
  bench.experiment.tests[0].data.noise = {{"y", {0.1, 0, 0}}};
  bench.run.objective = experiment::ObjectiveType::sum_of_norms;
  const Identifiability found = identify(bench, {1, 1, 0, 0});
  ASSERT_EQ(found.valleys.size(), 3u);
  EXPECT_THAT(found.valleys[0].parameters, testing::ElementsAre("a", "t.offset.value"));
  EXPECT_THAT(found.valleys[1].sentence, testing::StartsWith("The data do not fix b: one direction (b +"));
}

TEST(Identifiability, LeavesParametersAtBoundsOutAndSaysSo) {
  Bench bench("valley");
  const std::vector<double> x = fakes::grid(0, 3, 12);
  bench.add_test("t", x, fakes::map(x, [](double v) { return 1 * v + 2 * v * v + 0.01 * std::sin(40 * v); }));
  const Identifiability found = identify(bench, {0, 1, 2});
  EXPECT_TRUE(found.parameters[0].at_bound);
  EXPECT_FALSE(found.parameters[0].identified);
  EXPECT_TRUE(std::isnan(found.parameters[0].ci95));
  EXPECT_TRUE(found.parameters[1].identified) << "with p at its bound, q is fixed";
  EXPECT_TRUE(found.valleys.empty());
  ASSERT_EQ(found.sentences().size(), 1u);
  EXPECT_THAT(found.sentences()[0],
              testing::StartsWith("p = 0 kPa lies at the natural end of its range: there is nothing to widen"));
  EXPECT_THAT(identify(bench, {10, 1, 2}).sentences(),
              testing::Contains(testing::StartsWith("p = 10 kPa lies at a bound: widen it")));
  EXPECT_TRUE(identify(bench, {0, 0, 10}).singular_values.empty()) << "nothing is left inside";
}

TEST(Identifiability, FailsWhereThePointCannotBeEvaluated) {
  Bench bench;
  add_line(bench);
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("no"); });
  Identifiability found;
  EXPECT_EQ(uncertainty::identify(bench.assemble(), std::vector<double>{1, 2, 0}, found).reason(), "test 't': no");
  fakes::set_behaviour({});
  bench.experiment.tests[0].hold_out.all = true;
  EXPECT_EQ(uncertainty::identify(bench.assemble(), std::vector<double>{1, 2, 0}, found).reason(), "no row is fitted");
}

TEST(Uncertainty, IsPrintedWithTwoDigits) {
  EXPECT_EQ(uncertainty::with_uncertainty(0.79671234, 0.00412, "1"), "0.7967 ± 0.0041");
  EXPECT_EQ(uncertainty::with_uncertainty(-0.1608, 0.002, "kPa"), "-0.1608 ± 0.0020 kPa");
  EXPECT_EQ(uncertainty::with_uncertainty(123456, 789, "kPa"), "1.235e+05 ± 7.9e+02 kPa");
  EXPECT_EQ(uncertainty::with_uncertainty(7, 1e-12, ""), "7 ± 1e-12");
  EXPECT_EQ(uncertainty::with_uncertainty(7, 0, ""), "7");
}

}  // namespace
}  // namespace tunica
