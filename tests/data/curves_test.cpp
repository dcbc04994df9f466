// SPDX-License-Identifier: Apache-2.0
// Which rows a person would join to a curve, and over what.
#include "data/curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>

using namespace tunica::data;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

namespace {

using Values = std::vector<double>;

/// A sheet whose axial stretch is held at each of three values while the circumferential one goes from 1 to 1.5.
std::vector<Prescribed> sheets_in_series() {
  std::vector<Prescribed> sheet{{"stretch_circumferential", "1", {}}, {"stretch_axial", "1", {}}};
  for (const double held : {1.3, 1.5, 2.0})
    for (int k = 0; k < 6; ++k) {
      sheet[0].values.push_back(1 + 0.1 * k);
      sheet[1].values.push_back(held);
    }
  return sheet;
}

}  // namespace

TEST(Abscissa, IsTheChannelsOwnWhereThatIsSwept) {
  const std::vector<Prescribed> sheet{{"a", "1", {1, 1.1, 1.2, 1.3}}, {"b", "1", {1, 1.05, 1.1, 1.15}}};
  EXPECT_EQ(abscissa_of(sheet, "b").column, 1u);
  EXPECT_EQ(abscissa_of(sheet, "a").column, 0u);
  EXPECT_EQ(abscissa_of(sheet, "").column, 0u);
  EXPECT_THAT(abscissa_of(sheet, "b").curves, IsEmpty());
}

TEST(Abscissa, IsNotOneThatIsHeldWithItsNoise) {
  const std::vector<Prescribed> tube{{"pressure", "kPa", {3.31, 3.29, 3.32, 3.30, 3.31, 3.28, 3.33, 3.29}},
                                     {"axial_stretch", "1", {1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7}}};
  EXPECT_EQ(abscissa_of(tube, "pressure").column, 1u);
}

TEST(Abscissa, IsTimeWhereTheRestIsLong) {
  const auto over_time = [](const std::vector<double>& values) {
    return is_over_time(std::vector<Prescribed>{{"stretch", "1", values}}, values);
  };
  std::vector<double> ramp, cycles, hold, steps;
  for (int k = 0; k < 5000; ++k) {
    ramp.push_back(1 + 1e-4 * k);
    cycles.push_back(1.25 - 0.25 * std::cos(2 * std::numbers::pi * k / 2500));
    hold.push_back(k < 300 ? 1 + 0.5 * k / 300 : 1.5 + 1e-3 * ((k * 7919) % 13 - 6) / 6);
    steps.push_back(1 + 0.1 * std::floor(k / 1000.0));
  }
  EXPECT_FALSE(over_time(ramp));
  EXPECT_FALSE(over_time(cycles));
  EXPECT_TRUE(over_time(hold)) << "with 0.2 % of the range as noise";
  EXPECT_TRUE(over_time(steps));
  EXPECT_TRUE(over_time({1, 1.1, 1.2, 1.2, 1.2, 1.20001, 1.2, 1.2}));
  EXPECT_TRUE(over_time({1.2, 1.2, 1.2}));
  EXPECT_FALSE(over_time({1, 1.1, 1.2, 1.3, 1.3, 1.3, 1.3, 1.25}));
  EXPECT_FALSE(over_time({1, 1.1, 1, 1.1}));
  EXPECT_FALSE(is_over_time(std::vector<Prescribed>{{"stretch", "1", {1.2, 1.2, 1.2}}}, {})) << "there is no clock";
  EXPECT_FALSE(is_over_time({}, hold));
}

TEST(Abscissa, OfAFamilyIsWhatVariesAlongItsCurves) {
  for (const char* own : {"stretch_circumferential", "stretch_axial", ""}) {
    const Abscissa chosen = abscissa_of(sheets_in_series(), own);
    EXPECT_EQ(chosen.column, 0u) << own;
    ASSERT_THAT(chosen.curves, SizeIs(18));
    EXPECT_EQ(chosen.curves.front(), "stretch_axial = 1.3");
    EXPECT_EQ(chosen.curves[6], "stretch_axial = 1.5");
    EXPECT_EQ(chosen.curves.back(), "stretch_axial = 2");
  }
}

TEST(Lines, PartAFamilyIntoItsCurves) {
  const auto sheet = sheets_in_series();
  const auto lines = lines_of(sheet[0].values, abscissa_of(sheet, "").curves);
  ASSERT_THAT(lines, SizeIs(3));
  EXPECT_EQ(lines[1].curve, "stretch_axial = 1.5");
  EXPECT_THAT(lines[1].rows, ElementsAre(6, 7, 8, 9, 10, 11));
}

TEST(Lines, AreNotDrawnAcrossAJumpBack) {
  Values abscissa;
  for (int pass = 0; pass < 3; ++pass)
    for (int k = 0; k <= 20; ++k) abscissa.push_back(1 + 0.05 * k);
  const auto lines = lines_of(abscissa, {});
  ASSERT_THAT(lines, SizeIs(3));
  for (const Line& line : lines) EXPECT_TRUE(std::is_sorted(line.rows.begin(), line.rows.end()));
}

TEST(Lines, GoOnWhereRowsAreFartherAndFartherApart) {
  std::vector<double> time;
  for (int k = 0; k < 20; ++k) time.push_back(0.02 * std::pow(1.9, k));
  const auto lines = lines_of(time, {});
  ASSERT_THAT(lines, SizeIs(1));
  EXPECT_THAT(lines[0].rows, SizeIs(20));
}

TEST(Lines, FollowALoopInTheOrderOfItsRows) {
  Values abscissa;
  for (int k = 0; k <= 10; ++k) abscissa.push_back(1 + 0.1 * k);
  for (int k = 9; k >= 0; --k) abscissa.push_back(1 + 0.1 * k);
  const auto lines = lines_of(abscissa, {});
  ASSERT_THAT(lines, SizeIs(1));
  EXPECT_TRUE(lines.front().path);
  EXPECT_EQ(lines.front().rows.back(), 20u);
}

TEST(Lines, OfRowsWithoutOrderRunFromLowToHigh) {
  Values abscissa;
  for (int k = 0; k < 40; ++k) abscissa.push_back(k);
  std::mt19937 generator(5);
  std::shuffle(abscissa.begin(), abscissa.end(), generator);
  const auto lines = lines_of(abscissa, {});
  ASSERT_THAT(lines, SizeIs(1));
  EXPECT_FALSE(lines.front().path);
  for (std::size_t k = 0; k < 40; ++k) EXPECT_EQ(abscissa[lines.front().rows[k]], static_cast<double>(k));
}

TEST(Lines, LeaveOutRowsWithoutAPlace) {
  EXPECT_THAT(lines_of(Values{1, NAN, 2, 3}, {}).front().rows, ElementsAre(0, 2, 3));
  EXPECT_THAT(lines_of(Values{}, {}), IsEmpty());
}
