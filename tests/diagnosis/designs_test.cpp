// SPDX-License-Identifier: Apache-2.0
// The library of tests that a lab could make: how far each goes, how fast, and how well its values would be known.
#include "diagnosis/prospects/designs.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/measured.hpp"

namespace tunica::diagnosis::designs_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Pointwise;

constexpr double reach = 1.6, edge = 1 + 0.7 * (reach - 1);
const std::string circumferential =
    "a strip pulled along the circumferential direction to a stretch of 1.6, its width measured too";
const std::string axial = "a strip pulled along the axial direction to a stretch of 1.6, its width measured too";
const std::string askew = "a strip cut at 45° between the axes, pulled to 1.6";

/// The library for an experiment.
class Library {
 public:
  explicit Library(const trial::Measured& measured) {
    const experiment::Experiment read = measured.read();
    const Request request = request_of(read);
    const Progress silent;
    const Inquiry inquiry{read, request, testing::catalogue(), silent};
    evidence_ = evidence_of(inquiry, {});
    all_ = designs(inquiry, evidence_, *evidence_.base, evidence_.fit.free);
  }
  [[nodiscard]] std::vector<std::string> descriptions() const {
    std::vector<std::string> all;
    for (const Design& design : all_) all.push_back(design.description);
    return all;
  }
  [[nodiscard]] const Design& operator[](const std::string& description) const {
    for (const Design& design : all_)
      if (design.description == description) return design;
    throw std::out_of_range(description);
  }
  [[nodiscard]] std::vector<double> predicted(const Design& design) const {
    std::vector<double> values;
    EXPECT_TRUE(predict(design, *evidence_.base, evidence_.fit.free, values));
    return values;
  }

 private:
  Evidence evidence_;
  std::vector<Design> all_;
};

Library of(const trial::Measured& measured) {
  measured.measure(41);
  return Library(measured);
}

std::vector<double> steps(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 1; i <= count; ++i) values.push_back(from + (to - from) * i / count);
  return values;
}

void expect_column(std::span<const double> found, const std::vector<double>& expected) {
  EXPECT_THAT(std::vector<double>(found.begin(), found.end()),
              Pointwise(::testing::DoubleNear(1e-12 * expected.back()), expected));
}

std::vector<double> timed(double duration) { return testing::evenly(0, duration, 30); }

TEST(Library, HoldsStripsAndSheetsThatGoAsFarAsTheData) {
  const Library library = of(trial::Measured{});
  EXPECT_THAT(library.descriptions(),
              ElementsAre("a sheet stretched equally in both directions",
                          "a sheet stretched twice as far along the circumference as along the axis",
                          "a sheet stretched twice as far along the axis as along the circumference", circumferential,
                          axial, askew));
  for (const std::string& name : {circumferential, axial}) {
    const TestRows& rows = library[name].test->rows();
    ASSERT_EQ(rows.abscissae.size(), 1u);
    expect_column(rows.abscissae[0].values, steps(1, reach, 20));
    EXPECT_THAT(rows.channels, ElementsAre("stress", "transverse_stretch"));
    EXPECT_TRUE(rows.time.empty());
  }
  EXPECT_THAT(library[askew].test->rows().channels, ElementsAre("stress"));
  EXPECT_EQ(library[askew].parameters.at(0), 45);
  EXPECT_EQ(library[axial].parameters.at(0), 0);
  const std::vector<std::pair<double, double>> ends{
      {edge, edge}, {edge, 1 + (edge - 1) / 2}, {1 + (edge - 1) / 2, edge}};
  for (std::size_t k = 0; k < 3; ++k) {
    const TestRows& rows = library[library.descriptions()[k]].test->rows();
    ASSERT_EQ(rows.abscissae.size(), 2u);
    EXPECT_EQ(rows.abscissae[0].observable, "stretch_circumferential");
    EXPECT_EQ(rows.abscissae[1].observable, "stretch_axial");
    expect_column(rows.abscissae[0].values, steps(1, ends[k].first, 20));
    expect_column(rows.abscissae[1].values, steps(1, ends[k].second, 20));
    EXPECT_THAT(rows.channels, ElementsAre("stress_circumferential", "stress_axial"));
  }
  // Along the two directions the strips differ.
  EXPECT_NE(library.predicted(library[axial])[19], library.predicted(library[circumferential])[19]);
}

/// A cycle ten times as slow as the longest test; a hold as long as that, twenty times as fast as the shortest.
TEST(Library, HoldsACycleAndAHoldWhereTheDataHaveTime) {
  const Library library = of(trial::Measured({{.time = timed(60)}, {.name = "axial", .time = timed(30)}}));
  ASSERT_EQ(library.descriptions().size(), 8u);
  const TestRows& cycle = library["one slow cycle of a strip, to 1.6 and back in 600 s"].test->rows();
  std::vector<double> stretch = steps(1, reach, 10);
  for (const double back : steps(reach, 1 + 0.1 * (reach - 1), 10)) stretch.push_back(back);
  expect_column(cycle.abscissae.at(0).values, stretch);
  expect_column(cycle.time, steps(0, 600, 20));
  const TestRows& hold = library["a strip pulled to 1.6 within 1.5 s and held for 60 s"].test->rows();
  stretch = steps(1, reach, 4);
  stretch.resize(20, reach);
  std::vector<double> time = steps(0, 1.5, 4);
  for (const double later : steps(1.5, 61.5, 16)) time.push_back(later);
  expect_column(hold.abscissae.at(0).values, stretch);
  expect_column(hold.time, time);
  // The order of the tests does not matter.
  EXPECT_EQ(of(trial::Measured({{.time = timed(30)}, {.name = "axial", .time = timed(60)}})).descriptions(),
            library.descriptions());
}

TEST(Library, KnowsTheNoiseOfTheDataAndGuessesTheRest) {
  const Library library = of(trial::Measured({{.sd = 0.5}, {.name = "axial", .sd = 0.3}}));
  const Design& strip = library[axial];
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(strip.sd.at(i), 0.3) << "the smaller of two";
    EXPECT_EQ(strip.sd.at(20 + i), 0.005) << "of a stretch that nobody measured";
  }
  // 1.5 % of the largest value of each unmeasured channel.
  const Design& sheet = library["a sheet stretched twice as far along the axis as along the circumference"];
  const std::vector<double> values = library.predicted(sheet);
  for (std::size_t channel = 0; channel < 2; ++channel) {
    double largest = 0;
    for (std::size_t i = 0; i < 20; ++i) largest = std::max(largest, std::abs(values[20 * channel + i]));
    for (std::size_t i = 0; i < 20; ++i) EXPECT_DOUBLE_EQ(sheet.sd.at(20 * channel + i), 0.015 * largest);
  }
}

/// No row is known better than one of a tenth of the largest value.
TEST(Library, TakesRelativeNoiseOfATenthOfTheLargestAtLeast) {
  trial::Measured measured;
  measured.measure(41);
  for (const char* test : {"circumferential", "axial"})
    measured.experiment["tests"][test]["data"]["noise"] = {{"relative", 0.02}};
  const Library library(measured);
  const Design& strip = library[axial];
  const std::vector<double> values = library.predicted(strip);
  EXPECT_LT(values[0], 0.1 * values[19]);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_NEAR(strip.sd.at(i), 0.02 * std::max(values[i], 0.1 * values[19]), 1e-12 * values[19]);
}

/// However far the data go, a design stretches by 15 % at least.
TEST(Library, StretchesALittleAtLeast) {
  const Library library = of(trial::Measured({{.stretch = testing::evenly(1.01, 1.1, 20)}}));
  EXPECT_THAT(
      library.descriptions(),
      Contains("a strip pulled along the circumferential direction to a stretch of 1.15, its width measured too"));
}

}  // namespace
}  // namespace tunica::diagnosis::designs_test
