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
  // N = 8, SSE = 0.08, and σ is the third parameter.
  EXPECT_NEAR(*found->aicc, 8 * std::log(0.01) + 6 + 24 / 4.0, 1e-9);
  EXPECT_NEAR(found->bic, 8 * std::log(0.01) + 3 * std::log(8), 1e-9);
  EXPECT_EQ(found->noise, Information::Noise::estimated);
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
