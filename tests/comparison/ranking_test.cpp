// SPDX-License-Identifier: Apache-2.0
#include "comparison/ranking.hpp"

#include <gmock/gmock.h>

using namespace tunica;
using comparison::CertificateVerdict;
using comparison::RunSummary;

namespace {

RunSummary run(const std::string& group, std::optional<double> objective, Status status = Status()) {
  RunSummary summary;
  summary.group = group;
  summary.has_result = objective.has_value();
  summary.objective = objective.value_or(0);
  summary.status = std::move(status);
  return summary;
}

std::vector<std::size_t> order(const std::vector<comparison::Ranked>& ranking) {
  std::vector<std::size_t> runs;
  for (const auto& entry : ranking) runs.push_back(entry.run);
  return runs;
}

}  // namespace

TEST(Ranking, PutsTheSmallestObjectiveFirstAndKeepsTheOrderOfEquals) {
  const auto ranking = comparison::rank({run("a", 3), run("a", 1), run("a", 2), run("a", 1)});
  EXPECT_THAT(order(ranking), ::testing::ElementsAre(1, 3, 2, 0));
  EXPECT_EQ(ranking[3].rank, 4u);
}

TEST(Ranking, SharesARankWhereObjectivesDifferByLessThanSearchesResolve) {
  const auto ranking = comparison::rank({run("a", 1 + 4e-15), run("a", 2), run("a", 1), run("a", 1 + 1e-4)});
  EXPECT_THAT(order(ranking), ::testing::ElementsAre(0, 2, 3, 1)) << "equals stay in the order of the file";
  EXPECT_EQ(ranking[0].rank, 1u);
  EXPECT_EQ(ranking[1].rank, 1u);
  EXPECT_EQ(ranking[2].rank, 3u);
  EXPECT_EQ(ranking[3].rank, 4u);
}

TEST(Ranking, PutsTheCheapestOfEqualsFirst) {
  std::vector<RunSummary> runs{run("a", 1), run("a", 1 + 4e-15), run("a", 1), run("a", 0.5)};
  const auto cost = [](RunSummary& one, double expected, std::uint64_t evaluations, std::uint64_t jacobians) {
    one.expected_running_time = expected;
    one.evaluations = evaluations;
    one.jacobians = jacobians;
  };
  cost(runs[0], 500, 1000, 0);
  cost(runs[1], 300, 600, 600);  // fewer evaluations, and as many Jacobians
  cost(runs[2], 200, 800, 400);
  cost(runs[3], 90000, 90000, 0);
  const auto ranking = comparison::rank(runs);
  EXPECT_THAT(order(ranking), ::testing::ElementsAre(3, 2, 0, 1));
  EXPECT_EQ(ranking[1].rank, 2u);
  EXPECT_EQ(ranking[3].rank, 2u);
  EXPECT_EQ(runs[1].cost(), 600);
  runs[2].expected_running_time.reset();
  EXPECT_THAT(order(comparison::rank(runs)), ::testing::ElementsAre(3, 0, 1, 2)) << "one that had no success is last";
}

TEST(Ranking, WarnsWhereAiccComparesARunThatADefaultBoundHolds) {
  std::vector<RunSummary> runs{run("a", 1), run("a", 2)};
  std::vector<comparison::Ranked> ranking = comparison::rank(runs);
  ranking[0].delta_aicc = 0;
  ranking[1].delta_aicc = 375;
  EXPECT_TRUE(comparison::preferences(runs, ranking).empty());
  comparison::Estimate k1;
  k1.name = "k1";
  k1.upper_kind = assembly::FreeParameter::Bound::by_default;
  k1.stops_upper = {3, 9.0};
  runs[1].label = "hgo/lm";
  runs[1].parameters = {k1};
  const auto warnings = comparison::preferences(runs, ranking);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, execution::WarningKind::bound_in_comparison);
  EXPECT_THAT(warnings[0].sentence, ::testing::HasSubstr("k1 of hgo/lm"));
}

TEST(Ranking, NeverHidesARunWithoutAResult) {
  const auto ranking = comparison::rank({run("a", {}), run("a", 5, Status::infeasible("unstable", 1)), run("a", 9)});
  EXPECT_THAT(order(ranking), ::testing::ElementsAre(2, 1, 0));
  EXPECT_FALSE(ranking[2].rank);
}

TEST(Ranking, PutsWhatAFreshProcessRefutesBehindAllThatItDoesNot) {
  std::vector<RunSummary> runs{run("a", 1), run("a", 2), run("a", 5, Status::infeasible("unstable", 1)), run("a", {})};
  for (const auto verdict : {CertificateVerdict::failed, CertificateVerdict::objective_differs}) {
    runs[0].certificate.verdict = verdict;
    const auto ranking = comparison::rank(runs);
    EXPECT_THAT(order(ranking), ::testing::ElementsAre(1, 2, 0, 3));
    EXPECT_EQ(ranking[2].rank, 3u);
    EXPECT_THAT(comparison::reason_of_rank(runs[0]), ::testing::HasSubstr("did not find this objective again"));
  }
  EXPECT_EQ(comparison::reason_of_rank(runs[1]), "");
  EXPECT_EQ(comparison::reason_of_rank(runs[2]), "unstable");
  for (const auto verdict : {CertificateVerdict::not_checked, CertificateVerdict::not_an_optimum,
                             CertificateVerdict::better_neighbour, CertificateVerdict::constraint_broken}) {
    runs[0].certificate.verdict = verdict;
    EXPECT_THAT(order(comparison::rank(runs)), ::testing::ElementsAre(0, 1, 2, 3));
  }
}

TEST(Ranking, PutsTheLeastViolationFirstOfPointsThatBreakAConstraint) {
  const auto ranking = comparison::rank(
      {run("a", 1, Status::infeasible("x", 3)), run("a", 9, Status::infeasible("x", 2)), run("a", 99)});
  EXPECT_THAT(order(ranking), ::testing::ElementsAre(2, 1, 0));
}

TEST(Ranking, GoesBySuccessAndExpectedRunningTimeWhereAllStopAtOneTarget) {
  const auto aimed = [](double objective, double rate, std::optional<double> expected) {
    RunSummary summary = run("a", objective);
    summary.target = 1e-3;
    summary.success_rate = rate;
    summary.expected_running_time = expected;
    return summary;
  };
  std::vector<RunSummary> runs{aimed(9e-4, 0.05, 5000), aimed(9.9e-4, 1, 80), aimed(9.5e-4, 1, 900),
                               aimed(2e-3, 0, std::nullopt), aimed(1.5e-3, 0, std::nullopt)};
  EXPECT_TRUE(comparison::ranked_by_success(runs, "a"));
  EXPECT_THAT(order(comparison::rank(runs)), ::testing::ElementsAre(1, 2, 0, 4, 3));
  runs[3].target = 1e-4;  // not the same question any more
  EXPECT_FALSE(comparison::ranked_by_success(runs, "a"));
  EXPECT_THAT(order(comparison::rank(runs)), ::testing::ElementsAre(0, 2, 1, 4, 3));
}

TEST(Ranking, ComparesOnlyWithinAGroup) {
  const auto ranking = comparison::rank({run("a", 50), run("b", 1), run("a", 40)});
  EXPECT_THAT(order(ranking), ::testing::ElementsAre(2, 0, 1));
  EXPECT_EQ(ranking[2].rank, 1u);
}

TEST(Ranking, TellsObjectivesAndTestsApart) {
  experiment::RunEntry one, other;
  one.tests = other.tests = {"circ"};
  one.objective = experiment::ObjectiveType::sum_of_norms;
  other.objective = experiment::ObjectiveType::least_squares;
  EXPECT_EQ(comparison::group_of(one), "sum_of_norms on circ");
  EXPECT_NE(comparison::group_of(one), comparison::group_of(other));
}

TEST(Ranking, SaysWhereAnotherModelWithFewerParametersIsPreferred) {
  const auto fitted = [](const char* model, double objective, double aicc) {
    RunSummary summary = run("a", objective);
    summary.model = model;
    summary.label = std::string(model) + "/lm";
    summary.information.emplace();
    summary.information->aicc = aicc;
    return summary;
  };
  const auto told = [](const std::vector<RunSummary>& runs) {
    auto ranking = comparison::rank(runs);
    comparison::compare_information(runs, ranking);
    return comparison::preferences(runs, ranking);
  };
  const auto warnings = told({fitted("ogden", 1.0, 16.4), fitted("yeoh", 1.1, 10.0), fitted("gent", 2.0, 12.0)});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, execution::WarningKind::other_model_preferred);
  EXPECT_EQ(warnings[0].run, "ogden/lm");
  EXPECT_THAT(warnings[0].sentence, ::testing::HasSubstr("AICc prefers yeoh/lm by 6.4"));
  EXPECT_TRUE(told({fitted("ogden", 1.0, 13.9), fitted("yeoh", 1.1, 10.0)}).empty()) << "hardly better";
  EXPECT_TRUE(told({fitted("ogden", 1.0, 10.0), fitted("yeoh", 1.1, 30.0)}).empty());
  std::vector<RunSummary> aimed{fitted("ogden", 1.0, 16.4), fitted("yeoh", 1.1, 10.0)};
  for (auto& one : aimed) one.target = 2;
  EXPECT_TRUE(told(aimed).empty()) << "ranked by success";
}
