// SPDX-License-Identifier: Apache-2.0
#include "comparison/information.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "calibration/fakes.hpp"
#include "comparison/ranking.hpp"

using namespace tunica;
using comparison::Information;
using experiment::ObjectiveType;

namespace {

/// The line 1 + 2x with residuals ±0.1, c held.
struct Line : fakes::Bench {
  Line() {
    parameter("c").fixed = 0;
    const auto x = fakes::grid(0, 7, 8);
    std::vector<double> y;
    for (std::size_t i = 0; i < x.size(); ++i) y.push_back(1 + 2 * x[i] + (i % 4 == 0 || i % 4 == 3 ? 0.1 : -0.1));
    add_test("t", x, y);
    run.objective = ObjectiveType::least_squares;
  }
  [[nodiscard]] std::optional<Information> information() const {
    return comparison::information(assemble(), run.objective, std::vector<double>{1, 2});
  }
};

}  // namespace

TEST(Information, IsTheTextbookFormulaWhereTheNoiseIsEstimated) {
  const Line line;
  const auto found = line.information();
  ASSERT_TRUE(found && found->aicc);
  // N = 8, SSE = 0.08, and the factor of σ is the third parameter.
  const double s = line.assemble().layout().channels[0].sigma.rows.sd[0];
  EXPECT_NEAR(*found->aicc, 8 * std::log(0.01 / (s * s)) + 6 + 24 / 4.0, 1e-9);
  EXPECT_NEAR(found->bic, 8 * std::log(0.01 / (s * s)) + 3 * std::log(8), 1e-9);
  EXPECT_EQ(found->noise, Information::Noise::estimated);
}

TEST(Information, WeighsChannelsWithoutAStatementAsTheFitDoes) {
  // Two channels of which the second errs ten times as much; whatever σ is taken for them, the model that the objective
  // prefers is preferred, for it costs one σ, not one a channel.
  Line line;
  line.add_test("u", fakes::grid(0, 7, 8), {0, 5, 2, 9, 6, 13, 11, 16});
  const auto assembly = line.assemble();
  const auto chi_square = [&](const std::vector<double>& at) {
    double objective = 0;
    const auto workspace = assembly.evaluator().make_workspace();
    EXPECT_TRUE(assembly.evaluator().evaluate(at, objective, {}, {}, {}, *workspace).ok());
    return objective;
  };
  const auto found = [&](const std::vector<double>& at) {
    return comparison::information(assembly, line.run.objective, at);
  };
  const std::vector<double> one{1, 2}, other{1.5, 1.9};
  EXPECT_NEAR(found(one)->bic - found(other)->bic, 16 * std::log(chi_square(one) / chi_square(other)), 1e-9);
  EXPECT_NEAR(found(one)->bic, 16 * std::log(chi_square(one) / 16) + 3 * std::log(16), 1e-9);
}

TEST(Information, IsChiSquaredWhereTheNoiseIsStated) {
  Line line;
  line.experiment.tests[0].data.noise = {{"y", {0.2, 0, 0}}};
  const auto found = line.information();
  ASSERT_TRUE(found && found->aicc);
  EXPECT_NEAR(*found->aicc, 8 * 0.25 + 4 + 12 / 5.0, 1e-9);
  EXPECT_NEAR(found->bic, 8 * 0.25 + 2 * std::log(8), 1e-9);
  EXPECT_EQ(found->noise, Information::Noise::stated);
}

TEST(Information, IsNotGivenWhereTheBestPointIsNotTheMostLikely) {
  Line line;
  line.run.objective = ObjectiveType::sum_of_norms;
  EXPECT_FALSE(line.information());
  line.run.objective = ObjectiveType::least_squares;
  line.experiment.tests[0].weights = {2};
  EXPECT_FALSE(line.information());
  line.experiment.tests[0].weights = {1};
  line.parameter("a").prior = {1, 1};
  EXPECT_FALSE(line.information());
}

TEST(Information, ComparesDifferentModelsOfAGroupOnly) {
  std::vector<comparison::RunSummary> runs(3);
  for (auto& run : runs) {
    run.group = "g";
    run.has_result = true;
    run.model = "a";
  }
  runs[0].information = Information{-10, 0, Information::Noise::stated};
  runs[1].information = Information{-14, 0, Information::Noise::stated};
  auto ranking = comparison::rank(runs);
  comparison::compare_information(runs, ranking);
  EXPECT_FALSE(ranking[0].delta_aicc) << "one model by two optimizers";
  runs[1].model = "b";
  comparison::compare_information(runs, ranking);
  EXPECT_EQ(ranking[0].delta_aicc, 4);
  EXPECT_EQ(ranking[1].delta_aicc, 0);
  EXPECT_FALSE(ranking[2].delta_aicc);
  // A point that breaks a constraint fits better for it, and sets no standard.
  runs[1].status = Status::infeasible("unstable", 1);
  runs[2].model = "c";
  runs[2].information = Information{-9, 0, Information::Noise::stated};
  ranking = comparison::rank(runs);
  comparison::compare_information(runs, ranking);
  std::vector<std::optional<double>> delta(3);
  for (const auto& entry : ranking) delta[entry.run] = entry.delta_aicc;
  EXPECT_EQ(delta[0], 0);
  EXPECT_EQ(delta[1], std::nullopt);
  EXPECT_EQ(delta[2], 1);
}
