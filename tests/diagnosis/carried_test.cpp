// SPDX-License-Identifier: Apache-2.0
// An effect that several tests should show, and that only one carries.
#include <gmock/gmock.h>

#include "diagnosis/naming/causes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::Eq;
using ::testing::Optional;

constexpr Eigen::Index rows_of_curve = 20;  ///< of each curve

/// Curves of these tests, one unit of an effect of which is the given part of σ in every row of a curve. No parameter
/// absorbs any of it.
struct Case {
  std::vector<std::string> tests{"a", "b"};
  std::vector<double> signature{1, 1}, measured{3, 0};  ///< by curve; measured − predicted
  std::vector<std::string> place{"a", "b"};
  std::vector<double> absorbed{0, 0};  ///< by curve: the column of a parameter

  [[nodiscard]] std::optional<std::string> carried() const {
    const auto n = static_cast<Eigen::Index>(tests.size()) * rows_of_curve;
    const auto spread = [n](const std::vector<double>& by_curve) {
      Eigen::VectorXd all(n);
      for (std::size_t k = 0; k < by_curve.size(); ++k)
        all.segment(static_cast<Eigen::Index>(k) * rows_of_curve, rows_of_curve).setConstant(by_curve[k]);
      return all;
    };
    Analysis analysis;
    for (std::size_t k = 0; k < tests.size(); ++k) {
      Curve curve;
      curve.test = tests[k];
      curve.first = static_cast<Eigen::Index>(k) * rows_of_curve;
      curve.count = rows_of_curve;
      analysis.evidence.curves.push_back(curve);
    }
    analysis.evidence.fit.residuals = -spread(measured);
    analysis.evidence.fit.jacobian = spread(absorbed);
    analysis.evidence.fit.at_bound = {spread(absorbed).isZero()};
    Hypothesis hypothesis;
    hypothesis.addition.id = "force_offset";
    hypothesis.addition.place.tests = place;
    hypothesis.signature = spread(signature);
    Candidate candidate;
    candidate.hypotheses = {hypothesis};
    analysis.hypotheses.candidates = {candidate};
    Direction direction;
    direction.length = hypothesis.signature.norm();
    direction.unit = hypothesis.signature / direction.length;
    return carried_by_one_test(analysis, direction);
  }
};

// σ = 1 and 20 rows a curve: both curves say 1.5 ± 0.16, and the second alone 0 ± 0.22.
TEST(CarriedByOneTest, SaysWhatTheOthersShow) {
  EXPECT_THAT(Case{}.carried(),
              Optional(Eq("without the test 'a' the rest shows force_offset = 0 ± 0.438, but 1.5 was expected")));
  EXPECT_THAT((Case{.measured = {0, -3}}.carried()),
              Optional(Eq("without the test 'b' the rest shows force_offset = 0 ± 0.438, but -1.5 was expected")));
}

TEST(CarriedByOneTest, IsNothingWhereAllCarryIt) {
  EXPECT_EQ((Case{.measured = {3, 3}}.carried()), std::nullopt);
  EXPECT_EQ((Case{.measured = {0, 0}}.carried()), std::nullopt);
}

TEST(CarriedByOneTest, TakesAllCurvesOfATestAway) {
  EXPECT_EQ((Case{{"a", "a"}, {1, 1}, {3, 0}, {}}.carried()), std::nullopt) << "there is no other test";
  const Case three{{"a", "b", "a"}, {1, 1, 1}, {3, 0, 3}, {}, {0, 0, 0}};
  EXPECT_THAT(three.carried(),
              Optional(Eq("without the test 'a' the rest shows force_offset = 0 ± 0.438, but 2 was expected")));
}

TEST(CarriedByOneTest, IsNoQuestionWhereTheEffectIsOfOneTest) {
  EXPECT_EQ((Case{.place = {"a"}}.carried()), std::nullopt);
  EXPECT_NE((Case{.place = {}}.carried()), std::nullopt) << "in the material: all tests should show it";
}

// The second test alone has its share v/√(1 + v²) of the signature, and a standard error of 1/(v √20).
TEST(CarriedByOneTest, LeavesOutTestsThatHardlySeeTheEffect) {
  EXPECT_EQ((Case{.signature = {1, 0.2}, .measured = {6, 0}}.carried()), std::nullopt);
  EXPECT_NE((Case{.signature = {1, 0.21}, .measured = {6, 0}}.carried()), std::nullopt);
  EXPECT_EQ((Case{.absorbed = {0, 1}}.carried()), std::nullopt) << "a parameter absorbs it in the second test";
  EXPECT_EQ((Case{.absorbed = {1, 1}}.carried()), std::nullopt)
      << "in both: without the first it takes all of the second";
  EXPECT_NE((Case{.absorbed = {1, 0}}.carried()), std::nullopt) << "the parameter goes with the test";
}

// Of both 1.5 ± 0.158 and without the first δ ± 0.224: their difference has a standard deviation of 0.158.
TEST(CarriedByOneTest, CountsInStandardDeviations) {
  EXPECT_NE((Case{.measured = {3, 0.43}}.carried()), std::nullopt);
  EXPECT_EQ((Case{.measured = {3, 0.45}}.carried()), std::nullopt) << "1.96 of its own: the rest shows it, too";
  EXPECT_NE((Case{.measured = {1.6, 0}}.carried()), std::nullopt);
  EXPECT_EQ((Case{.measured = {1.54, 0}}.carried()), std::nullopt) << "0.77 would not be seen with 3.5 of 0.224";
  EXPECT_NE((Case{.measured = {1.55, 0.42}}.carried()), std::nullopt) << "off by 0.565, 3.57 of 0.158";
  EXPECT_EQ((Case{.measured = {1.5, 0.42}}.carried()), std::nullopt) << "off by 0.54, 3.42 of 0.158";
}

// σ of all is 0.2, without the first test 0.2236, and 0.1 of the difference between the two.
TEST(CarriedByOneTest, MeasuresTheDifferenceByWhatTheTestLeftOutAdds) {
  EXPECT_THAT((Case{.signature = {0.5, 1}, .measured = {1.285, 0.42}}.carried()),
              Optional(Eq("without the test 'a' the rest shows force_offset = 0.42 ± 0.438, but 0.85 was expected")));
}

TEST(CarriedByOneTest, DoesNotDependOnTheUnitOfTheAmplitude) {
  EXPECT_THAT(
      (Case{.signature = {1e8, 1e8}}.carried()),
      Optional(Eq("without the test 'a' the rest shows force_offset = 0 ± 4.38e-09, but 1.5e-08 was expected")));
}

}  // namespace
}  // namespace tunica::diagnosis
