// SPDX-License-Identifier: Apache-2.0
#include "comparison/ranking_table.hpp"

#include <gmock/gmock.h>

using namespace tunica::comparison;
using ::testing::HasSubstr;

namespace {

Estimate estimate(double value, std::optional<Interval> ci95, Estimate::Bound bound = Estimate::Bound::none) {
  Estimate result;
  result.name = "mu";
  result.unit = "kPa";
  result.value = value;
  result.ci95 = ci95;
  result.identified = ci95.has_value();
  result.at_bound = bound;
  return result;
}

}  // namespace

TEST(RankingTable, WritesValuesWithTheirUncertainty) {
  EXPECT_EQ(value_text(estimate(22.3861, Interval{21.9, 22.8722})), "22.386 ± 0.49 kPa");
  EXPECT_EQ(value_text(estimate(22.4, Interval{21.9, 25})), "22.4 kPa (21.9 … 25)");
  EXPECT_EQ(value_text(estimate(22.4, {})), "22.4 kPa  (not fixed by the data)");
  EXPECT_EQ(value_text(estimate(200, {}, Estimate::Bound::upper)), "200 kPa  <- AT ITS UPPER BOUND");
}

TEST(RankingTable, BeginsWithTheWarningsAndShowsRunsWithoutAResult) {
  Summary summary;
  summary.warnings = {"something is odd"};
  RunSummary failed;
  failed.label = "gho/es";
  failed.group = "least_squares on circ";
  failed.status = tunica::Status::failed("row 3: no root");
  failed.evaluations = failed.failures = 200;
  failed.realisations = 1;
  summary.runs.push_back(failed);
  summary.ranking.push_back({0, {}});
  const auto text = ranking_table(summary);
  EXPECT_EQ(text.find("WARNINGS\n  ! something is odd\n"), 0u);
  EXPECT_THAT(text, HasSubstr("NO RESULT"));
  EXPECT_THAT(text, HasSubstr("no result: row 3: no root"));
}
