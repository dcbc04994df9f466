// SPDX-License-Identifier: Apache-2.0
#include "data/units.hpp"

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "data/written_file.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

std::string refusal(std::string_view from, std::string_view to) {
  return testing::message_of<InputError>([&] { convert(1, from, to); });
}

TEST(Units, ConvertExactlyWhereTheFactorIsADecimal) {
  EXPECT_EQ(convert(1, "mmHg", "kPa"), 0.133322387415);
  EXPECT_EQ(convert(170, "mmHg", "kPa"), 170 * 0.133322387415);
  EXPECT_EQ(convert(1, "MPa", "kPa"), 1000);
  EXPECT_EQ(convert(1, "N/mm2", "kPa"), 1000);
  EXPECT_EQ(convert(1, "N/mm^2", "kPa"), 1000);
  EXPECT_EQ(convert(1, "N/mm²", "kPa"), 1000);
  EXPECT_EQ(convert(1, "um", "mm"), 0.001);
  EXPECT_EQ(convert(1, "µm", "mm"), 0.001);
  EXPECT_EQ(convert(1, "N", "mN"), 1000);
  EXPECT_EQ(convert(50, "%", "1"), 0.5);
  EXPECT_EQ(convert(3, "1/s", "1/s"), 3);
  EXPECT_EQ(convert(60, "1/min", "1/s"), 1);
  EXPECT_EQ(convert(1, "%/s", "1/s"), 0.01);
  EXPECT_EQ(convert(10, "min", "s"), 600);
}

TEST(Units, AgreeThatKilopascalTimesSquareMillimetreIsMillinewton) {
  EXPECT_EQ(convert(1, "kPa mm2", "mN"), 1);
  EXPECT_EQ(convert(1, "kPa·mm²", "mN"), 1);
}

TEST(Units, KnowAngles) {
  EXPECT_NEAR(convert(1, "rad", "deg"), 180 / std::numbers::pi, 1e-13);
  EXPECT_EQ(convert(46.4, "degree", "deg"), 46.4);
  EXPECT_EQ(convert(46.4, "°", "deg"), 46.4);
}

TEST(Units, TakeADashOrNothingForTheNumberOne) {
  EXPECT_EQ(convert(2, "-", "1"), 2);
  EXPECT_EQ(convert(2, "", "1"), 2);
  EXPECT_EQ(convert(2, " kPa ", "kPa"), 2);
}

TEST(Units, AnswerAnUnknownUnitWithTheNearest) {
  EXPECT_TRUE(refusal("kPaa", "kPa").starts_with("unknown unit 'kPaa'. Did you mean 'kPa'?")) << refusal("kPaa", "kPa");
  EXPECT_NE(refusal("kpa", "kPa").find("Did you mean 'kPa'?"), std::string::npos);
  EXPECT_NE(refusal("mmHG", "kPa").find("Did you mean 'mmHg'?"), std::string::npos);
  EXPECT_NE(refusal("furlongs_or_so", "mm").find("unknown unit"), std::string::npos);
  EXPECT_FALSE(is_unit("kPaa"));
  EXPECT_FALSE(is_unit("kPa)"));
  EXPECT_FALSE(is_unit("s since 2000-01-01"));
  EXPECT_TRUE(is_unit("mN/mm"));
}

TEST(Units, RefuseOtherDimensionsAndNameBoth) {
  EXPECT_EQ(refusal("mm", "kPa"), "the unit 'mm' cannot be converted to 'kPa': they measure different things");
  EXPECT_NE(refusal("deg", "1").find("cannot be converted"), std::string::npos) << "an angle is no plain number";
  EXPECT_NE(refusal("1", "deg").find("cannot be converted"), std::string::npos);
  EXPECT_NE(refusal("s", "1/s").find("cannot be converted"), std::string::npos) << "no silent reciprocal";
  EXPECT_NE(refusal("N", "kPa").find("cannot be converted"), std::string::npos);
  EXPECT_NE(refusal("lg(re 1 mW)", "kPa").find("cannot be converted"), std::string::npos);
}

TEST(Quantity, ReadsANumberAndAUnit) {
  EXPECT_EQ(parse_quantity("3.71 mm", "mm"), 3.71);
  EXPECT_EQ(parse_quantity("3.71", "mm"), 3.71);
  EXPECT_EQ(parse_quantity(" +3710um ", "mm"), 3.71);
  EXPECT_EQ(parse_quantity("-1e3 Pa", "kPa"), -1);
  EXPECT_EQ(parse_quantity("0.01/s", "1/s"), 0.01);
  EXPECT_EQ(parse_quantity("5 %", "1"), 0.05);
  EXPECT_EQ(parse_quantity("10 min", "s"), 600);
}

TEST(Quantity, SaysWhatIsWrong) {
  const auto refused = [](std::string_view text) {
    return testing::message_of<InputError>([&] { parse_quantity(text, "kPa"); });
  };
  EXPECT_NE(
      refused("soft").find("'soft' is not a quantity: it does not begin with a number. Expected a number and a unit, "
                           "for example \"1.5 kPa\"."),
      std::string::npos);
  // Of a number without a dimension the example is one that is read.
  EXPECT_NE(testing::message_of<InputError>([&] { parse_quantity("2 1", "1"); }).find("for example \"1.5 %\""),
            std::string::npos);
  EXPECT_EQ(parse_quantity("1.5 %", "1"), 0.015);
  EXPECT_NE(refused("").find("does not begin with a number"), std::string::npos);
  EXPECT_NE(refused("1,5 kPa").find("decimal comma"), std::string::npos);
  EXPECT_NE(refused("1 2 kPa").find("'2 kPa' follows the number"), std::string::npos);
  EXPECT_NE(refused("nan kPa").find("not finite"), std::string::npos);
  EXPECT_NE(refused("1e999 kPa").find("too large"), std::string::npos);
  EXPECT_NE(refused("1e308 MPa").find("too large"), std::string::npos);
  EXPECT_NE(refused("5 kPaa").find("Did you mean 'kPa'?"), std::string::npos);
}

TEST(Units, ConvertFromManyThreadsAtOnce) {
  std::vector<std::thread> threads;
  std::vector<double> sums(8, 0);
  for (std::size_t t = 0; t < sums.size(); ++t)
    threads.emplace_back([&sums, t] {
      for (int i = 0; i < 500; ++i) {
        sums[t] += convert(1, i % 2 == 0 ? "MPa" : "mmHg", "kPa");
        static_cast<void>(is_unit("unit" + std::to_string(i)));
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const double sum : sums) EXPECT_NEAR(sum, 250 * 1000.133322387415, 1e-6);
}

}  // namespace
}  // namespace tunica::data
