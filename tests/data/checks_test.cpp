// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "data/strip.hpp"

namespace tunica::data {
namespace {

using testing::read_strip;
using testing::strip_refusal;

std::string only_warning(std::string_view text, const testing::Mapping& columns = {}) {
  const Dataset strip = read_strip(text, columns);
  return strip.warnings.size() == 1 ? strip.warnings[0] : std::to_string(strip.warnings.size()) + " warnings";
}

TEST(Checks, AcceptRealStretches) {
  EXPECT_TRUE(read_strip("stretch,stress [kPa]\n1,0\n4,900\n7.6,6000\n").warnings.empty()) << "natural rubber";
  EXPECT_TRUE(read_strip("stretch,stress [kPa]\n1,0\n0.6,-20\n0.3,-90\n").warnings.empty()) << "compression";
  EXPECT_TRUE(read_strip("stretch [%],stress [kPa]\n100,0\n160,20\n").warnings.empty());
}

TEST(Checks, RefuseStretchOfZeroOrLess) {
  EXPECT_EQ(strip_refusal("stretch,stress [kPa]\n1,0\n-0.5,1\n"),
            "strip.csv, line 3, column 1 ('stretch'): found a stretch of -0.5; expected a positive number, 1 at rest, "
            "less in compression.");
}

TEST(Checks, TellStrainFromStretch) {
  EXPECT_EQ(strip_refusal("stretch,stress [kPa]\n0,0\n0.1,1\n0.6,5\n"),
            "strip.csv, line 2, column 1 ('stretch'): 'stretch' begins at 0, so it looks like strain; expected "
            "stretch, which is 1 at rest. "
            "Write stretch = 1 + strain, or map the column as \"strain\".");
  EXPECT_NE(strip_refusal("stretch [%],stress [kPa]\n0,0\n60,5\n").find("looks like strain"), std::string::npos);
}

TEST(Checks, TellPercentFromAFraction) {
  EXPECT_EQ(
      strip_refusal("stretch,stress [kPa]\n5,0\n20,1\n60,5\n"),
      "strip.csv, line 4, column 1 ('stretch'): found 60 where a stretch (1 at rest) is expected; this looks "
      "like percent. Map the column as \"strain\" with the unit %, in the header or under \"units\" (a true stretch "
      "this large needs the unit: 'stretch [1]').");
  EXPECT_NE(strip_refusal("stretch,stress [kPa]\n-54,-5\n-20,-1\n0,0\n").find("looks like percent"), std::string::npos);
  EXPECT_NE(strip_refusal("stretch [-],stress [kPa]\n0,0\n20,1\n60,5\n").find("looks like percent"), std::string::npos);
  EXPECT_NE(strip_refusal("stretch,stress [kPa]\n100,0\n120,1\n").find("Write the unit in the header: 'stretch [%]'."),
            std::string::npos);
  EXPECT_NE(only_warning("stretch [1],stress [kPa]\n1,0\n25,900\n")
                .find("line 3, column 1 ('stretch'): found a stretch of 25"),
            std::string::npos);
  EXPECT_NE(only_warning("stretch,stress [kPa]\n5,0\n10,900\n").find("every stretch is above 2 and none is near 1"),
            std::string::npos);
}

TEST(Checks, WarnOfRowsThatLieOnAStraightLine) {
  std::string text = "stretch [1],stress [kPa]\n";
  for (int row = 0; row < 8; ++row) text += fmt::format("{},{}\n", 1 + 0.05 * row, 12.5 * row);
  EXPECT_EQ(only_warning(text),
            "strip.csv, line 1, column 2 ('stress'): the 8 rows lie on a straight line over 'stretch' to the last "
            "digit, as no measurement does. Were they interpolated or computed? There is no scatter to "
            "estimate a noise from; state it");
  EXPECT_TRUE(read_strip(text + "1.4,100.01\n").warnings.empty()) << "one digit of one row";
}

TEST(Checks, WarnOfTensionThatPushes) {
  EXPECT_EQ(only_warning("stretch,stress [kPa]\n1,0\n1.1,-1\n1.2,-2\n1.3,0.1\n"),
            "strip.csv, line 3, column 2 ('stress'): 2 of 3 rows in tension ('stretch' above 1) have a negative "
            "stress. Tension is positive "
            "here; is the sign of the load cell reversed?");
  EXPECT_TRUE(read_strip("stretch,stress [kPa]\n1,-0.1\n1.1,-0.1\n1.2,2\n1.3,4\n").warnings.empty())
      << "noise near rest is no reversed sign";
}

TEST(Checks, WarnOfRepeatedRows) {
  EXPECT_EQ(only_warning("stretch,stress [kPa]\n1,0\n1.1,1\n1.1,1\n1.2,2\n"),
            "strip.csv, line 4: the same numbers as in an earlier row. Duplicates count twice in the fit; remove them "
            "if they are not separate "
            "measurements.");
}

TEST(Checks, WarnOfTwoResultsAtOneAbscissa) {
  EXPECT_NE(only_warning("stretch,stress [kPa]\n1,0\n1.1,1\n1.1,1.5\n1.2,2\n")
                .find("strip.csv, line 4, column 1 ('stretch'): an earlier row has this abscissa and another result"),
            std::string::npos);
}

TEST(Checks, LetCyclesAndRelaxationRepeatAbscissae) {
  EXPECT_TRUE(read_strip("stretch,stress [kPa]\n1,0\n1.1,1\n1.2,2\n1.1,0.8\n1,0\n").warnings.empty())
      << "load and unload";
  EXPECT_TRUE(read_strip("time [s],stretch,stress [kPa]\n0,1,0\n1,1.1,1\n2,1.1,0.9\n",
                         {{"stretch", "stretch"}, {"stress", "stress"}, {"time", "time"}})
                  .warnings.empty())
      << "held while the stress relaxes";
}

TEST(Checks, RefuseTimeThatRunsBackwards) {
  const testing::Mapping columns = {{"stretch", "stretch"}, {"stress", "stress"}, {"time", "time"}};
  EXPECT_EQ(strip_refusal("time [s],stretch,stress [kPa]\n0,1,0\n2,1.1,1\n1,1.2,2\n", columns),
            "strip.csv, line 4, column 1 ('time'): the time 1 s comes after 2 s. Rows are in loading order, so time "
            "must not run backwards, "
            "and begins at rest at 0.");
  EXPECT_EQ(read_strip("time [min],stretch,stress [kPa]\n0,1,0\n2,1.1,1\n", columns).time,
            (std::vector<double>{0, 120}));
}

}  // namespace
}  // namespace tunica::data
