// SPDX-License-Identifier: Apache-2.0
#include "cohort/curve_reading.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/written_file.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {
namespace {

using ::testing::HasSubstr;

/// A curve over the stretches, with other predictions before it.
assembly::MeasuredChannel channel(std::vector<double> stretches) {
  assembly::MeasuredChannel view;
  view.test = "strip";
  view.observable = "stress";
  view.unit = "kPa";
  view.abscissa_name = "stretch";
  view.abscissa_unit = "1";
  view.offset = 3;
  view.count = stretches.size();
  view.abscissa = std::move(stretches);
  return view;
}

double value(const assembly::MeasuredChannel& view, const LinearReading& reading, double (*curve)(double)) {
  double sum = 0;
  for (const auto& [at, weight] : reading.weights) sum += weight * curve(view.abscissa[at - view.offset]);
  return sum;
}

ReadingEntry entry(ReadingKind kind, std::vector<std::string> at) { return {"r", "strip", "stress", kind, at, "here"}; }

double line(double x) { return 3 * x - 2; }
double square(double x) { return x * x; }

const std::vector<double> up_and_down{1, 1.1, 1.15, 1.3, 1.2, 1};

TEST(CurveReading, OfALineIsExact) {
  const auto view = channel(up_and_down);
  EXPECT_NEAR(value(view, read_off(view, entry(ReadingKind::value, {"1.12"})), line), line(1.12), 1e-14);
  EXPECT_NEAR(value(view, read_off(view, entry(ReadingKind::slope, {"1.05", "1.2"})), line), 3, 1e-13);
  // ∫ (3x − 2) dx from 1.05 to 1.22
  const double integral = 1.5 * (1.22 * 1.22 - 1.05 * 1.05) - 2 * 0.17;
  EXPECT_NEAR(value(view, read_off(view, entry(ReadingKind::integral, {"1.05", "1.22"})), line), integral, 1e-14);
  EXPECT_NEAR(value(view, read_off(view, entry(ReadingKind::integral, {"1.22", "1.05"})), line), -integral, 1e-14);
  EXPECT_NEAR(value(view, read_off(view, entry(ReadingKind::integral, {"1.11", "1.12"})), line),
              1.5 * (1.12 * 1.12 - 1.11 * 1.11) - 0.02, 1e-14)
      << "within one interval";
}

TEST(CurveReading, IsOfTheLoadingNotOfTheWayBack) {
  const auto view = channel(up_and_down);
  for (const auto& [at, weight] : read_off(view, entry(ReadingKind::value, {"1.25"})).weights)
    EXPECT_LE(at, view.offset + 3) << "row of the unloading, weight " << weight;
}

TEST(CurveReading, OfACurveConvergesWithTheSquareOfTheStep) {
  double last = 0;
  for (const int rows : {10, 20, 40}) {
    std::vector<double> x;
    for (int k = 0; k <= rows; ++k) x.push_back(1 + 0.3 * k / rows);
    const auto view = channel(x);
    const double exact = (std::pow(1.3, 3) - 1) / 3;
    const double error =
        std::abs(value(view, read_off(view, entry(ReadingKind::integral, {"1", "1.3"})), square) - exact);
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.1);
    }
    last = error;
  }
}

TEST(CurveReading, SaysWhereTheLoadingDoesNotReach) {
  const auto view = channel(up_and_down);
  const auto reading = read_off(view, entry(ReadingKind::value, {"1.4"}));
  EXPECT_THAT(reading.problem, HasSubstr("stretch 1.4 lies outside the loading, 1 to 1.3"));
  EXPECT_TRUE(reading.weights.empty());
}

TEST(CurveReading, RefusesASlopeBetweenOnePlace) {
  const auto view = channel(up_and_down);
  EXPECT_THAT(testing::message_of<InputError>([&] {
                read_off(view, entry(ReadingKind::slope, {"1.1", "1.1"}));
              }),
              HasSubstr("both ends of the slope are 1.1"));
}

TEST(CurveReading, ConvertsUnits) {
  auto view = channel({0, 10, 20});
  view.abscissa_unit = "kPa";
  view.abscissa_name = "pressure";
  const auto reading = read_off(view, entry(ReadingKind::value, {"100 mmHg"}));
  ASSERT_EQ(reading.weights.size(), 2U);
  EXPECT_NEAR(reading.weights[1].second, (13.3322 - 10) / 10, 1e-5);
  EXPECT_THAT(testing::message_of<InputError>([&] { read_off(view, entry(ReadingKind::value, {"3 mm"})); }),
              HasSubstr("here: "));
}

}  // namespace
}  // namespace tunica::cohort
