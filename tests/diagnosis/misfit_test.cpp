// SPDX-License-Identifier: Apache-2.0
// Which curves are wrong, where on them, and on which side.
#include "diagnosis/naming/misfit.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/hand_made.hpp"

namespace tunica::diagnosis::misfit_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Curves "a", "b", … with so many rows at 1, 2, 3 …, the abscissa of each 100 behind that of the last.
struct Curves : HandMade {
  explicit Curves(const std::vector<std::size_t>& sizes) {
    for (std::size_t c = 0; c < sizes.size(); ++c) {
      std::vector<double> x;
      for (std::size_t i = 0; i < sizes[c]; ++i) x.push_back(static_cast<double>(100 * c + i + 1));
      add(std::string(1, static_cast<char>('a' + c)), x, x, {1, 0, 0});
    }
    close();
    analysis.alarm.detection.by_curve.assign(sizes.size(), 1.0);
  }
  /// What is measured less what is predicted, in σ.
  void show(const std::string& name, const Eigen::VectorXd& above) {
    evidence.fit.residuals.segment(curve(name).first, above.size()) = -above;
  }
  [[nodiscard]] std::vector<Misfit> found(const Claim& claim = {}) {
    analysis.evidence = evidence;
    return misfits({experiment, request, shelf, progress}, analysis, claim);
  }

  Analysis analysis;
  Request request;
  Progress progress;
};

Eigen::VectorXd plateau(Eigen::Index rows, Eigen::Index first, Eigen::Index last, double value) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(rows);
  r.segment(first, last - first + 1).setConstant(value);
  return r;
}

// Twenty rows, so windows of five. Those around rows 6 … 13 hold three or more of the eight rows that are off, and they
// reach two rows further on either side: 16 σ over twelve rows.
TEST(MisfitOfACurve, IsWhereItsWindowsAreHalfAsFarOffAsTheWorst) {
  Curves curves({20});
  curves.analysis.alarm.detection.by_curve = {0.01};
  for (const double value : {2.0, -2.0}) {
    curves.show("a", plateau(20, 6, 13, value));
    const auto found = curves.found();
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(found[0].test, "a");
    EXPECT_EQ(found[0].channel, "y");
    EXPECT_EQ(found[0].p_value, 0.01);
    EXPECT_EQ(found[0].from, 5) << "row 4";
    EXPECT_EQ(found[0].to, 16);
    EXPECT_THAT(found[0].where, HasSubstr("x 5 … 16: measured"));
    EXPECT_THAT(found[0].where,
                HasSubstr(value > 0 ? "above the prediction by 1.3 σ" : "below the prediction by 1.3 σ"));
    EXPECT_THAT(found[0].where, HasSubstr("over 12 rows"));
  }
}

TEST(MisfitOfACurve, EndsWhereTheCurveDoes) {
  Curves curves({20});
  curves.analysis.alarm.detection.by_curve = {0.01};
  curves.show("a", plateau(20, 0, 3, 2));
  EXPECT_EQ(curves.found()[0].from, 1);
  curves.show("a", plateau(20, 16, 19, 2));
  EXPECT_EQ(curves.found()[0].to, 20);
  curves.show("a", Eigen::VectorXd::Ones(20));
  EXPECT_EQ(curves.found()[0].from, 1);
  EXPECT_EQ(curves.found()[0].to, 20);
}

/// The same by brute force: rows of windows that touch the worst one without a gap.
std::pair<double, double> region_of(const Eigen::VectorXd& r) {
  const auto n = static_cast<int>(r.size()), half = std::max(1, n / 10);
  std::vector<double> mean;
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    int count = 0;
    for (int k = 0; k < n; ++k)
      if (std::abs(k - i) <= half) {
        sum += r[k];
        ++count;
      }
    mean.push_back(sum / std::sqrt(count));
  }
  int worst = 0;
  for (int i = 0; i < n; ++i)
    if (std::abs(mean[static_cast<std::size_t>(i)]) > std::abs(mean[static_cast<std::size_t>(worst)])) worst = i;
  const double largest = mean[static_cast<std::size_t>(worst)];
  const auto belongs = [&](int i) { return i >= 0 && i < n && mean[static_cast<std::size_t>(i)] / largest > 0.5; };
  int first = worst, last = worst;
  while (belongs(first - 1)) --first;
  while (belongs(last + 1)) ++last;
  return {std::max(0, first - half) + 1, std::min(n - 1, last + half) + 1};
}

TEST(MisfitOfACurve, IsTheSameByBruteForce) {
  for (const std::size_t rows : {1u, 2u, 5u, 9u, 12u, 20u, 31u, 47u}) {
    Curves curves({rows});
    curves.analysis.alarm.detection.by_curve = {0.01};
    for (int seed = 1; seed <= 8; ++seed) {
      const auto n = static_cast<Eigen::Index>(rows);
      const Eigen::VectorXd slow = Eigen::ArrayXd::LinSpaced(n, 0, 6 + seed).sin();
      const Eigen::VectorXd r = slow + 0.8 * rough(n, seed);
      curves.show("a", r);
      const auto found = curves.found();
      ASSERT_THAT(found, SizeIs(1));
      EXPECT_EQ(std::pair(found[0].from, found[0].to), region_of(r)) << rows << ' ' << seed;
    }
  }
}

// Holm: the smallest of three is worth three times as much, the next twice; behind the first that is not, none.
TEST(MisfitOfACurve, IsSignificantAmongAllCurves) {
  Curves curves({20, 10, 12});
  curves.show("a", plateau(20, 0, 9, 3));
  curves.show("b", plateau(10, 0, 9, -1));
  curves.show("c", plateau(12, 0, 5, 2));
  const auto tests_at = [&curves](const std::vector<double>& p) {
    curves.analysis.alarm.detection.by_curve = p;
    std::vector<std::string> found;
    for (const Misfit& one : curves.found()) found.push_back(one.test);
    return found;
  };
  EXPECT_THAT(tests_at({0.02, 0.01, 0.5}), ElementsAre("b", "a"));
  EXPECT_THAT(tests_at({0.04, 0.01, 0.02}), ElementsAre("b", "c", "a"));
  EXPECT_THAT(tests_at({0.03, 0.01, 0.04}), ElementsAre("b")) << "though 0.04 · 1 would be";
  EXPECT_THAT(tests_at({0.017, 0.5, 0.5}), IsEmpty());
  EXPECT_THAT(tests_at({0.016, 0.5, 0.5}), ElementsAre("a"));
  curves.request.alpha = 0.06;
  EXPECT_THAT(tests_at({0.017, 0.5, 0.5}), ElementsAre("a"));
  curves.analysis.alarm.detection.by_curve = {0.5, 0.01, 0.5};
  EXPECT_EQ(curves.found()[0].from, 101) << "the abscissa is its own";
  EXPECT_THAT(curves.found()[0].where, HasSubstr("below the prediction by 1.0 σ"));
}

// No curve is wrong by itself. The cause takes 2 off every row of half of "b", and 1 off two rows of "a".
TEST(MisfitOfACurve, IsWhereTheCauseExplainsMostIfNoneIsSignificant) {
  Curves curves({20, 20});
  curves.show("a", plateau(20, 0, 1, 5));
  curves.show("b", plateau(20, 10, 19, 2));
  Claim claim;
  claim.best.emplace();
  claim.best->fit.residuals = curves.evidence.fit.residuals;
  claim.best->fit.residuals.segment(0, 2) += Eigen::Vector2d(1, 1);
  claim.best->fit.residuals.segment(30, 10).setZero();
  EXPECT_THAT(curves.found(claim), IsEmpty()) << "no alarm";
  curves.analysis.alarm.raised = true;
  EXPECT_THAT(curves.found(), IsEmpty()) << "no cause";
  const auto found = curves.found(claim);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].test, "b");
  EXPECT_EQ(found[0].to, 120);
  EXPECT_EQ(found[0].from, 109) << "windows of five: from row 10 less two";
  EXPECT_THAT(found[0].where, HasSubstr("above"));
  curves.analysis.alarm.detection.by_curve = {0.001, 1};
  ASSERT_THAT(curves.found(claim), SizeIs(1));
  EXPECT_EQ(curves.found(claim)[0].test, "a") << "a curve that is wrong by itself";
}

}  // namespace
}  // namespace tunica::diagnosis::misfit_test
