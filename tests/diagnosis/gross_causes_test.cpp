// SPDX-License-Identifier: Apache-2.0
// Gross rows beside an explanation, and as the only thing that is wrong.
#include "diagnosis/naming/gross_causes.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/causes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Test "a" of six rows of which two are held out, and "b" of four rows with the channels y and z = 10 y. A mechanism
/// "m" explains the last row of "a"; some rows of both are off.
struct OffRows : MadeUpCauses {
  explicit OffRows(bool with_outliers = true, const data::Noise& noise = {.absolute = 0.5})
      : MadeUpCauses({6, 4}, at_rows(10, {{3, 2.1}, {4, 1.9}, {5, 7}, {8, -6}, {9, 5}})) {
    experiment.tests[0].data.noise = {{"y", noise}};
    experiment.tests[0].hold_out.rows = data::RowRange{0, 2, 1};
    experiment::TestEntry& second = experiment.tests[1];
    second.data.columns.emplace_back("z", "z");
    second.weights.assign(2, 1.0);
    second.data.noise = {{"y", {.absolute = 1}}, {"z", {.absolute = 3, .relative = 0.1}}};
    add({"m", at_rows(10, {{5, 1}})});
    MadeUp outliers{"outliers", at_rows(10, {{4, 1}})};
    outliers.declare = [](MechanismFactory& factory) {
      factory.stage = Stage::data;
      factory.options = {Option::text("rows", "", "")};
    };
    if (with_outliers) add(outliers);
    close();
  }
  [[nodiscard]] Claim claim_of(const std::vector<std::size_t>& directions) const {
    Claim claim;
    claim.best = group_of(directions).refit;
    return claim;
  }
};

GrossRow row_of(const std::string& test, const std::string& channel, std::size_t row, std::size_t file_row = 0) {
  return {test, channel, row, file_row, 0, {}};
}

std::vector<std::pair<std::string, std::size_t>> places_of(const std::vector<GrossRow>& rows) {
  std::vector<std::pair<std::string, std::size_t>> all;
  for (const GrossRow& row : rows) all.emplace_back(row.test, row.row);
  return all;
}

// Of σ = 0.5, row 3 is off by 4.2 and row 4 by 3.8; row 5 is until it is explained.
TEST(StillGross, IsWhatAnExtensionMissesByFourStandardDeviations) {
  OffRows causes;
  causes.analysis.evidence.gross = {row_of("a", "y", 3), row_of("a", "y", 4), row_of("a", "y", 5),
                                    row_of("nowhere", "y", 0)};
  EXPECT_THAT(places_of(still_gross(causes.analysis, {})), SizeIs(4)) << "all without an extension";
  EXPECT_THAT(places_of(still_gross(causes.analysis, causes.claim_of({causes.direction("m")}))),
              ElementsAre(std::pair{"a", 3u}, std::pair{"nowhere", 0u}));
  // Where the model cannot be evaluated nothing is known of a row.
  const Claim claim = causes.claim_of({causes.direction("m")});
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("not today"); });
  EXPECT_THAT(still_gross(causes.analysis, claim), SizeIs(4));
}

// z is 10 (1 + 0.1 · 8) = 18 in row 2 of b, and measured as 18 − 60: σ = hypot(3, 0.1 · 42).
TEST(CausesOfRows, SayHowFarARowLiesFromWhatTheExtensionPredicts) {
  OffRows causes;
  causes.analysis.evidence.gross = {row_of("b", "z", 2, 17)};
  const auto found = causes_of_rows(causes.inquiry(), causes.analysis, causes.claim_of({causes.direction("m")}));
  ASSERT_THAT(found, SizeIs(1));
  const Cause& cause = found.front();
  const double sd = std::hypot(3, 4.2);
  EXPECT_EQ(cause.id, "outliers");
  EXPECT_EQ(cause.place, (Place{{"b"}, "z", 2, {}}));
  EXPECT_EQ(cause.place.file_row, 17u);
  EXPECT_EQ(cause.group, CauseGroup::rig);
  EXPECT_EQ(cause.amplitude.name, "v");
  EXPECT_EQ(cause.amplitude.unit, "kPa");
  EXPECT_NEAR(cause.amplitude.value, -60, 1e-9);
  EXPECT_NEAR(cause.amplitude.low, -60 - 1.959963984540054 * sd, 1e-6);
  EXPECT_NEAR(cause.amplitude.high, -60 + 1.959963984540054 * sd, 1e-6);
  EXPECT_FALSE(cause.amplitude.at_bound);
  EXPECT_TRUE(cause.amplitude.plausible);
  EXPECT_EQ(cause.probability, 1);
  EXPECT_EQ(cause.retained, 1);
  EXPECT_NEAR(cause.p_value, std::erfc(60 / sd / std::sqrt(2)), 1e-12 * cause.p_value) << "of a normal, either way";
  EXPECT_NEAR(cause.gain, 3600 / (sd * sd), 1e-6);
  EXPECT_EQ(cause.explanation, explanation_of(cause, causes.inquiry().mechanism("outliers")));
}

// Rows of σ 0.1 y: row 3, measured as 1.3 + 2.1, is the second one that is fitted.
TEST(CausesOfRows, HaveTheNoiseOfTheirRow) {
  OffRows causes(true, {.relative = 0.1});
  causes.analysis.evidence.gross = {row_of("a", "y", 3)};
  const auto found = causes_of_rows(causes.inquiry(), causes.analysis, causes.claim_of({causes.direction("m")}));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found.front().amplitude.value, 2.1, 1e-9);
  EXPECT_NEAR(found.front().gain, std::pow(2.1 / 0.34, 2), 1e-6);
}

TEST(CausesOfRows, AreOfTheFirstRowOfATestThatHasNoneYet) {
  OffRows causes;
  const auto places = [&](const std::vector<std::size_t>& directions) {
    std::vector<std::pair<std::string, std::size_t>> all;
    for (const Cause& cause : causes_of_rows(causes.inquiry(), causes.analysis, causes.claim_of(directions)))
      all.emplace_back(cause.place.tests.front(), cause.place.row.value());
    return all;
  };
  causes.analysis.evidence.gross = {row_of("a", "y", 3), row_of("b", "y", 2), row_of("b", "y", 3), row_of("a", "y", 4),
                                    row_of("nowhere", "y", 1)};
  EXPECT_THAT(places({causes.direction("m")}), ElementsAre(std::pair{"a", 3u}, std::pair{"b", 2u}));
  EXPECT_THAT(places({causes.direction("outliers")}), ElementsAre(std::pair{"b", 2u}));
  EXPECT_THAT(causes_of_rows(causes.inquiry(), causes.analysis, {}), IsEmpty()) << "beside no extension";
  OffRows without(false);
  without.analysis.evidence.gross = {row_of("a", "y", 3)};
  EXPECT_THAT(causes_of_rows(without.inquiry(), without.analysis, without.claim_of({without.direction("m")})),
              IsEmpty());
}

/// Rows of two tests, and mechanisms that are looked for in one row: five of them elsewhere or of no use, two in row 1
/// of "a".
struct WorstRow : MadeUpCauses {
  WorstRow() : MadeUpCauses({3, 3}, at_rows(6, {{1, 8}, {4, 5}})) {
    MadeUp failing{"failing", at_rows(6, {{1, 1}})};
    failing.by = [](double distance) { return distance == 0 ? 0 : NAN; };
    add({"other_test", at_rows(6, {{4, 1}}), {{"b"}}});
    add({"other_channel", at_rows(6, {{1, 1}})});
    add({"other_row", at_rows(6, {{2, 1}})});
    add(failing);
    add({"outliers", at_rows(6, {{1, 2}})});
    add({"again", at_rows(6, {{1, 1}})});
    close();
    for (Candidate& candidate : analysis.hypotheses.candidates) {
      Place& place = candidate.hypotheses.front().addition.place;
      place.channel = candidate.id == "other_channel" ? "z" : "y";
      place.row = candidate.id == "other_row" ? 2 : 1;
    }
    analysis.alarm.detection.by_candidate = {0.1, 0.2, 0.3, 0.4, 0.005, 0.6};
  }
};

TEST(SuspectedRows, NameTheMechanismInTheWorstOfThem) {
  WorstRow causes;
  const std::vector<GrossRow> rows{{"a", "y", 1, 11, 8, "x 1, measured 9.1 kPa"},
                                   {"b", "y", 1, 1, -5.25, "x 4, measured 6.4 kPa"}};
  const Explanation found = suspected_rows(causes.inquiry(), causes.analysis, rows);
  EXPECT_EQ(found.verdict, Verdict::suspect_data);
  ASSERT_THAT(found.reasons, SizeIs(1));
  EXPECT_EQ(found.reasons.front().kind, ReasonKind::gross_rows);
  EXPECT_EQ(found.reasons.front().text,
            "nothing is wrong but row 11 of a, y (x 1, measured 9.1 kPa; +8.0 σ); row 1 of b, y (x 4, measured 6.4 "
            "kPa; -5.2 σ)");
  EXPECT_EQ(found.claim.named, 1u);
  EXPECT_THAT(found.claim.ambiguity_set, ElementsAre("outliers"));
  ASSERT_THAT(found.claim.causes, SizeIs(1));
  const Cause& cause = found.claim.causes.front();
  EXPECT_EQ(cause.id, "outliers");
  EXPECT_EQ(cause.place.row, 1u);
  EXPECT_EQ(cause.probability, 1);
  EXPECT_EQ(cause.p_value, 0.005);
  EXPECT_NEAR(cause.amplitude.value, 4, 1e-3);
  EXPECT_NEAR(cause.gain, 64, 1e-3);
  ASSERT_TRUE(found.claim.best);
  EXPECT_NEAR(found.claim.best->fit.chi2, 25, 1e-3);
  ASSERT_THAT(found.claim.rivals, SizeIs(1));
  EXPECT_NEAR(found.claim.rivals.front().fit.chi2, 25, 1e-3);
}

}  // namespace
}  // namespace tunica::diagnosis
