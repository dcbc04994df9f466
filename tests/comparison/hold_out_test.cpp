// SPDX-License-Identifier: Apache-2.0
#include "comparison/hold_out.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "comparison/ranking_table.hpp"

using namespace tunica::comparison;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

Quality channel(const std::string& test, const std::string& name, bool held_out, std::size_t rows, double rmse,
                std::optional<double> r2, double nmad = 20) {
  Quality quality{test, name, name == "force" ? "mN" : "mm", held_out, {}};
  quality.agreement.rows = rows;
  quality.agreement.rmse = rmse;
  quality.agreement.r2 = r2;
  quality.agreement.nmad = nmad;
  return quality;
}

/// A tube fitted at one axial stretch and predicted at two others.
std::vector<Quality> tube() {
  return {channel("fitted", "diameter", false, 12, 0.072, 0.997), channel("fitted", "force", false, 12, 1.5, 0.8),
          channel("below", "diameter", true, 9, 0.1, 0.7),        channel("below", "force", true, 9, 16, -5.165),
          channel("above", "diameter", true, 16, 0.1, 0.76),      channel("above", "force", true, 16, 12, -14.94)};
}

}  // namespace

TEST(HoldOut, ErrorsArePooledOverTheRowsOfAnObservable) {
  const auto quality = tube();
  const auto found = transfers(quality);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].channel, "force");
  EXPECT_DOUBLE_EQ(found[1].in_sample, 1.5);
  EXPECT_DOUBLE_EQ(found[1].held_out, std::sqrt((9 * 256. + 16 * 144.) / 25));
  EXPECT_EQ(found[1].worst->test, "above") << "the lowest R², though the error is smaller there";
}

TEST(HoldOut, AnObservableThatIsOnlyFittedOrOnlyHeldOutIsNoTransfer) {
  EXPECT_TRUE(transfers({channel("a", "force", false, 3, 1, 0.5), channel("b", "diameter", true, 3, 1, 0.5)}).empty());
}

TEST(HoldOut, WarnsOfWhatFitsBetterThanItPredicts) {
  const auto quality = tube();
  const auto warning = transfer_warning("hgo/lm", quality);
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->kind, tunica::execution::WarningKind::predicts_worse);
  EXPECT_EQ(warning->subjects, std::vector<std::string>{"force"});
  EXPECT_EQ(warning->text(),
            "hgo/lm: the run fits better than it predicts: its force error is 1.5 mN in sample and 13.6 mN held out "
            "(root mean square; worst in above, R² -14.9)");
  EXPECT_EQ(transfers(quality)[0].verdict, HoldOutVerdict::predicted);
  EXPECT_EQ(transfers(quality)[1].verdict, HoldOutVerdict::worse_than_fitted);
}

TEST(HoldOut, IsSilentWherePredictionsAreAsGoodAsTheFitOrBothAreNearlyPerfect) {
  EXPECT_FALSE(
      transfer_warning("m", {channel("a", "force", false, 5, 1, 0.9), channel("b", "force", true, 5, 1.9, 0.8)}));
  EXPECT_FALSE(transfer_warning(
      "m", {channel("a", "force", false, 5, 1e-9, 1, 1e-9), channel("b", "force", true, 5, 1e-6, 1, 1e-6)}));
}

TEST(HoldOut, TheTableHasInSampleAndHeldOutSideBySide) {
  std::vector<Quality> quality = tube();
  quality.insert(quality.begin() + 2, channel("fitted", "force", true, 3, 2, std::nullopt));
  const std::string text = hold_out_table(quality);
  EXPECT_THAT(text, HasSubstr("\n  fitted, diameter                      0.072 mm, R² 0.99700\n"));
  EXPECT_THAT(text, HasSubstr("\n  fitted, force                         1.5 mN, R² 0.8      2 mN, R² -\n"));
  EXPECT_THAT(text, HasSubstr("\n  above, force                                              12 mN, R² -14.9\n"));
  EXPECT_THAT(text, HasSubstr("\n  all tests, diameter                   0.072 mm            0.1 mm\n"));
  EXPECT_THAT(text, HasSubstr("\n  all tests, force                      1.5 mN              12.8 mN, 8.6 times\n"));
}

TEST(HoldOut, TheTableKeepsLongNamesOnALineOfTheirOwn) {
  const std::string name(40, 'x');
  EXPECT_THAT(hold_out_table({channel(name, "force", true, 5, 1, 0.9)}),
              HasSubstr("\n  " + name + ", force\n" + std::string(60, ' ') + "1 mN, R² 0.9\n"));
}

TEST(HoldOut, RunsWithoutHeldOutRowsAreShownAsBefore) {
  EXPECT_EQ(hold_out_table({channel("fitted", "force", false, 12, 1.5, 0.8)}), "");
  Summary summary;
  RunSummary run;
  run.label = "m/lm";
  run.group = "g";
  run.has_result = true;
  run.quality = {channel("fitted", "force", false, 12, 1.5, 0.8)};
  summary.runs = {run};
  summary.ranking = {{0, 1, std::nullopt}};
  EXPECT_THAT(ranking_table(summary).plain(), HasSubstr("\n  fitted, force: RMSE 1.5 mN, R² 0.80000, NMAD 20 %\n"));
  summary.runs[0].quality = tube();
  EXPECT_THAT(ranking_table(summary).plain(), HasSubstr("\n  fitted, force                         1.5 mN, R² 0.8\n"));
  EXPECT_THAT(ranking_table(summary).plain(), Not(HasSubstr("RMSE")));
}
