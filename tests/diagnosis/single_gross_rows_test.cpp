// SPDX-License-Identifier: Apache-2.0
// Which rows are gross, from residuals made by hand: measured minus predicted, in σ.
#include <map>

#include <gmock/gmock.h>

#include "diagnosis/evidence/gross_rows.hpp"
#include "diagnosis/hand_made.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Curves of so many rows, named "0", "1" …
struct Quiet : HandMade {
  explicit Quiet(const std::vector<std::size_t>& counts) {
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const std::vector<double> x = fakes::grid(0, 1, counts[k]);
      add(std::to_string(k), x, rising(x), {0.5, 0, 0});
    }
    close();
  }
  void set(const std::string& name, std::size_t row, double measured_over_predicted) {
    evidence.fit.residuals[curve(name).first + static_cast<Eigen::Index>(row)] = -measured_over_predicted;
  }
  [[nodiscard]] std::vector<std::string> found() const {
    std::vector<std::string> all;
    for (const GrossRow& row : gross_rows(evidence)) all.push_back(row.test + ":" + std::to_string(row.row));
    return all;
  }
};

/// Whether a row of a curve of 40 rows is gross, beside others.
bool is_gross(std::size_t row, double value, const std::map<std::size_t, double>& others = {}, double free = 1) {
  Quiet bed({40});
  bed.set("0", row, value);
  for (const auto& [other, of_other] : others) bed.set("0", other, of_other);
  if (free < 1) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(40);
    column[static_cast<Eigen::Index>(row)] = std::sqrt(1 - free);
    column[(static_cast<Eigen::Index>(row) + 20) % 40] = std::sqrt(free);
    bed.add_column(5 * column);
  }
  const auto found = bed.found();
  return found == std::vector<std::string>{"0:" + std::to_string(row)};
}

// 4 √1.5 = 4.899 from the line through the rows on both sides.
TEST(SingleGrossRows, AreFourStandardDeviationsFromTheirNeighbours) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_FALSE(is_gross(20, sign * 4.89));
    EXPECT_TRUE(is_gross(20, sign * 4.91));
    EXPECT_FALSE(is_gross(20, sign * 5.89, {{19, sign}, {21, sign}}));
    EXPECT_TRUE(is_gross(20, sign * 5.91, {{19, sign}, {21, sign}}));
    EXPECT_FALSE(is_gross(20, sign * 5.39, {{19, sign}}));
    EXPECT_TRUE(is_gross(20, sign * 5.41, {{19, sign}}));
    EXPECT_FALSE(is_gross(20, sign * 5.39, {{21, sign}}));
    EXPECT_TRUE(is_gross(20, sign * 5.41, {{21, sign}}));
    EXPECT_FALSE(is_gross(20, sign * 4.89, {{19, sign}, {21, -sign}}));
    EXPECT_TRUE(is_gross(20, sign * 4.91, {{18, 1.9}, {22, 1.9}})) << "those are no neighbours";
  }
}

// 4 √6 = 9.798 from the line through the two rows beside them.
TEST(SingleGrossRows, AtTheEndsOfACurveAreFarFromTheLineThroughTheNextTwo) {
  for (const auto& [end, near, far] : {std::tuple<std::size_t, std::size_t, std::size_t>{0, 1, 2}, {39, 38, 37}}) {
    EXPECT_FALSE(is_gross(end, 9.79)) << end;
    EXPECT_TRUE(is_gross(end, 9.81)) << end;
    EXPECT_FALSE(is_gross(end, 11.79, {{near, 1}})) << end;
    EXPECT_TRUE(is_gross(end, 11.81, {{near, 1}})) << end;
    EXPECT_FALSE(is_gross(end, 8.79, {{far, 1}})) << end;
    EXPECT_TRUE(is_gross(end, 8.81, {{far, 1}})) << end;
    EXPECT_FALSE(is_gross(end, 7.45, {{near, -3}})) << end << ": the neighbour is almost as large";
    EXPECT_TRUE(is_gross(end, 7.55, {{near, -3}})) << end;
  }
}

TEST(SingleGrossRows, AreTwoAndAHalfTimesAsLargeAsTheirNeighbours) {
  for (const auto& [left, right] : {std::pair{-2.0, -2.0}, {-2.0, 0.0}, {0.0, -2.0}, {2.0, -2.0}}) {
    EXPECT_FALSE(is_gross(20, 4.99, {{19, left}, {21, right}})) << left << right;
    EXPECT_TRUE(is_gross(20, 5.01, {{19, left}, {21, right}})) << left << right;
  }
}

// A score of 16 needs 4 σ, and less where a fit follows the row: 4 √0.8 = 3.578.
TEST(SingleGrossRows, HaveAScoreOfSixteenByThemselves) {
  const std::map<std::size_t, double> others{{19, -1.4}, {21, -1.4}};
  EXPECT_FALSE(is_gross(20, 3.99, others));
  EXPECT_TRUE(is_gross(20, 4.01, others));
  EXPECT_FALSE(is_gross(20, 3.57, others, 0.8));
  EXPECT_TRUE(is_gross(20, 3.59, others, 0.8));
  EXPECT_FALSE(is_gross(20, 20, {}, 0.045)) << "the fit follows it nearly alone";
  EXPECT_TRUE(is_gross(20, 20, {}, 0.055));
}

// Columns that differ by 1e-3 of their length in that row alone: together they follow it.
TEST(SingleGrossRows, AreNoneThatAFitOfColumnsThatAreNearlyAlikeFollows) {
  Quiet bed({40});
  bed.set("0", 20, 20);
  bed.add_column(rough(40, 1));
  EXPECT_THAT(bed.found(), ElementsAre("0:20"));
  bed.add_column(rough(40, 1) + 1e-3 * rough(40, 1).norm() * Eigen::VectorXd::Unit(40, 20));
  EXPECT_THAT(bed.found(), IsEmpty());
}

TEST(SingleGrossRows, AreOfTheirOwnCurve) {
  Quiet bed({40, 40});
  bed.set("1", 0, 12);
  EXPECT_THAT(bed.found(), ElementsAre("1:0"));
}

TEST(SingleGrossRows, AreInCurvesOfAtLeastFourRows) {
  Quiet bed({3, 4, 40});
  bed.set("0", 1, 30);
  EXPECT_THAT(bed.found(), IsEmpty());
  bed.set("0", 1, 0);
  bed.set("1", 1, 30);
  EXPECT_THAT(bed.found(), ElementsAre("1:1"));
}

TEST(SingleGrossRows, AreAShapeWhereTheyAreMoreThanATenthOfTheirCurve) {
  Quiet bed({29, 19, 100});
  bed.set("0", 5, 20);
  bed.set("0", 12, 21);
  bed.set("1", 5, 22);
  EXPECT_THAT(bed.found(), ElementsAre("1:5", "0:12", "0:5"));
  bed.set("1", 12, 23);
  EXPECT_THAT(bed.found(), ElementsAre("0:12", "0:5")) << "two of nineteen";
  bed.set("1", 5, 0);
  bed.set("0", 20, 24);
  EXPECT_THAT(bed.found(), ElementsAre("1:12")) << "three of twenty-nine";
  Quiet few({5, 40});
  few.set("0", 2, 20);
  EXPECT_THAT(few.found(), ElementsAre("0:2")) << "one of five";
}

TEST(SingleGrossRows, AreNoneWhereMoreThanOneRowInThirtyIs) {
  Quiet bed({30, 59});
  bed.set("0", 5, 20);
  bed.set("1", 5, -21);
  EXPECT_THAT(bed.found(), ElementsAre("1:5", "0:5")) << "the farthest first, two of 89";
  bed.set("1", 25, 22);
  EXPECT_THAT(bed.found(), IsEmpty()) << "three of 89";
  Quiet few({25});
  few.set("0", 5, 20);
  EXPECT_THAT(few.found(), ElementsAre("0:5")) << "one of 25";
  few.set("0", 15, 20);
  EXPECT_THAT(few.found(), IsEmpty());
}

TEST(SingleGrossRows, SayWhereTheyAreAndWhatWasMeasured) {
  HandMade bed;
  const std::vector<double> x{5, 4, 3, 2, 1, 0};  // as in the file; sorted it is the other way round
  auto& entry = bed.add_test("s", x, {50.5, 40.5, 30.125, 20.5, 10.5, 0.5}, true);
  entry.data.noise = {{"y", {0.5, 0, 0}}, {"z", {0.5, 0, 0}}};
  entry.data.sorted = true;
  NoiseSource source{"s", "y", "kPa", NoiseSource::Kind::stated, {0.5, 0, 0}};
  bed.evidence.noise = {source, source};
  bed.evidence.noise[1].channel = "z";
  bed.add("t", x, x, {1, 0, 0});
  bed.close();
  bed.evidence.fit.residuals[3] = 12.345;
  const auto found = gross_rows(bed.evidence);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].test, "s");
  EXPECT_EQ(found[0].channel, "y");
  EXPECT_EQ(found[0].row, 3u);
  EXPECT_EQ(found[0].file_row, 2u);
  EXPECT_EQ(found[0].residual, -12.345);
  EXPECT_EQ(found[0].where, "x 3, measured 30.12 kPa");
  EXPECT_EQ(words_of(found), "row 2 of s, y (x 3, measured 30.12 kPa; -12.3 σ)");
  EXPECT_EQ(words_of({found[0], {"t", "z", 7, 9, 5, "x 1, measured 2 kPa"}}),
            "row 2 of s, y (x 3, measured 30.12 kPa; -12.3 σ); row 9 of t, z (x 1, measured 2 kPa; +5.0 σ)");
}

TEST(SingleGrossRows, AreGrossInTheirChannelOfTheExperimentAlone) {
  fakes::Bench bench;
  for (const char* name : {"s", "t"})
    bench.add_test(name, {0, 1}, {0, 1}, true).data.noise = {{"y", {0.5, 0, 0}}, {"z", {0.5, 0, 0}}};
  const auto without = without_rows(bench.experiment, {{"s", "z", 1, 5, 9, ""}, {"t", "y", 0, 0, 9, ""}});
  EXPECT_THAT(without.tests[0].data.noise[0].second.gross, IsEmpty());
  EXPECT_THAT(without.tests[0].data.noise[1].second.gross, ElementsAre(1u));
  EXPECT_THAT(without.tests[1].data.noise[0].second.gross, ElementsAre(0u));
  EXPECT_THAT(without.tests[1].data.noise[1].second.gross, IsEmpty());
}

}  // namespace
}  // namespace tunica::diagnosis
