// SPDX-License-Identifier: Apache-2.0
// Which of several fits with mechanisms is kept, how many there are, and where a fit is searched for again. What the
// fits leave is as a list says, one by one: no fit finds a slope, and each ends where it begins.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/refits.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FieldsAre;
using ::testing::Ge;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::Not;
using ::testing::SizeIs;

constexpr double refused = -1;  ///< in place of the |r|² that is left

/// One row at x = 0, where the base shows 1 whatever its parameters b and c are, and 100 more in the data. The
/// mechanism makes the next prediction leave the next |r|² of a list, the last for all that come behind it.
struct Listed : MadeUpCauses {
  explicit Listed(std::vector<double> squares, double base = 10)
      : MadeUpCauses({1}, Eigen::VectorXd::Constant(1, 100)), list(std::move(squares)) {
    MadeUp one{"m", Eigen::VectorXd::Constant(1, 1), {{"a"}}, MechanismFactory::Side::both, 1, 3};
    one.watch = [this](std::span<const double> model, std::span<const double> own) {
      left = list[std::min(points.size(), list.size() - 1)];
      points.push_back({model[1], model[2], own.front()});
      return left == refused ? Status::failed("as the list says") : Status();
    };
    one.by = [this](double distance) { return steep ? 1e30 * std::exp(-distance) : 100 - std::sqrt(left); };
    add(one);
    free("b", 0.01, 1);
    free("c", -5, 5);
    close();
    analysis.evidence.fit.chi2 = base;
  }
  [[nodiscard]] Addition addition() const { return analysis.hypotheses.candidates.front().hypotheses.front().addition; }
  std::optional<Refit> fit(const Refit* from = nullptr) {
    points.clear();
    return fit_with(inquiry(), analysis, {addition()}, std::vector{2.0}, from);
  }
  /// "5 after 2" fits; "none after 2".
  std::string outcome(bool with_smaller = false) {
    const Refit nothing = bare();
    const auto found = fit(with_smaller ? &nothing : nullptr);
    const std::string after = " after " + std::to_string(points.size());
    return (found ? std::to_string(std::lround(found->fit.chi2)) : "none") + after;
  }
  /// A refit with all additions but the only one.
  [[nodiscard]] Refit bare() const {
    Refit nothing{{}, std::make_shared<const Extension>(experiment, run, std::vector<Addition>(), shelf), {}};
    nothing.fit.free = analysis.evidence.fit.free;
    return nothing;
  }
  /// A refit that ended at these b and c and that amplitude.
  [[nodiscard]] Refit ended(double squares, double b, double c, double amplitude) const {
    Refit refit{{addition()}, {}, {}};
    refit.extension = std::make_shared<const Extension>(experiment, run, refit.additions, shelf);
    refit.fit.free = {b, c, amplitude};
    refit.fit.chi2 = squares;
    return refit;
  }
  /// With c at a bound of the base fit.
  Refit again(const Refit& refit, double enough = 0) {
    analysis.evidence.fit.at_bound = {false, true};
    points.clear();
    return searched_again(inquiry(), analysis, refit, enough);
  }
  /// The fits of a second search that leave these |r|², by how many there were, and what is left in the end.
  std::string again_with(std::vector<double> squares, double squares_before, double enough = 0) {
    const std::size_t draws = request.quick ? 12 : 64;
    list.assign(draws, 1000);
    list.insert(list.end(), squares.begin(), squares.end());
    const Refit found = again(ended(squares_before, 0.1, 0, 5), enough);
    return fmt::format("{:g} after {}", found.fit.chi2, points.size() - draws);
  }
  struct Point {
    double b, c, amplitude;
  };
  std::vector<double> list;
  std::vector<Point> points;  ///< that were asked for
  double left = 0;
  bool steep = false;  ///< falls by a factor of e² at every step, for ever
};

/// But for the rounding of a bound's width.
auto is_point(const Listed::Point& point) {
  return FieldsAre(DoubleNear(point.b, 1e-10), DoubleNear(point.c, 1e-10), DoubleNear(point.amplitude, 1e-10));
}

std::vector<double> amplitudes_of(const std::vector<Listed::Point>& points) {
  std::vector<double> all;
  for (const auto& point : points) all.push_back(point.amplitude);
  return all;
}

TEST(Refits, KeepTheBetterOfTwoStarts) {
  EXPECT_EQ(Listed({5, 3}).outcome(), "3 after 2");
  EXPECT_EQ(Listed({3, 5}).outcome(), "3 after 2");
  Listed second({5, 3}), first({3, 5});
  EXPECT_NEAR(second.fit()->fit.free.back(), 3 + 0.3 * 2, 1e-10);
  EXPECT_NEAR(first.fit()->fit.free.back(), 3 + 2, 1e-10);
}

TEST(Refits, DoWithoutStartsThatCannotBeEvaluated) {
  EXPECT_EQ(Listed({refused, 7}).outcome(), "7 after 2");
  EXPECT_EQ(Listed({7, refused}).outcome(), "7 after 2");
  EXPECT_EQ(Listed({refused}).outcome(), "none after 2");
  EXPECT_EQ(Listed({refused}).outcome(true), "none after 3");
}

// The base is among the extensions.
TEST(Refits, BeginNextToTheBaseWhereTheyEndAboveIt) {
  Listed causes({30, 20, 15});
  const auto found = causes.fit();
  EXPECT_THAT(amplitudes_of(causes.points),
              ElementsAre(DoubleNear(5, 1e-10), DoubleNear(3.6, 1e-10), DoubleNear(3.02, 1e-10)));
  EXPECT_NEAR(found->fit.chi2, 15, 1e-9);
  EXPECT_EQ(Listed({30, 20, 25}).outcome(), "20 after 3");
  EXPECT_EQ(Listed({20, 30, refused}).outcome(), "20 after 3");
  EXPECT_EQ(Listed({30, refused, 5}).outcome(), "5 after 3");
}

TEST(Refits, EndBelowTheBaseAtOnceWhereItIsQuick) {
  const auto quick = [](std::vector<double> squares, bool with_smaller) {
    Listed causes(std::move(squares));
    causes.request.quick = true;
    return causes.outcome(with_smaller);
  };
  EXPECT_EQ(quick({5, 3}, false), "5 after 1");
  EXPECT_EQ(quick({15, 3}, false), "3 after 2");
  EXPECT_EQ(quick({15, 12, 11}, false), "11 after 3");
  EXPECT_EQ(quick({5, 3, 2}, true), "5 after 1");
  EXPECT_EQ(quick({15, 3, 2}, true), "3 after 2");
  EXPECT_EQ(quick({15, 12, 2}, true), "2 after 3");
  EXPECT_EQ(quick({refused, 3, 2}, true), "3 after 2");
}

TEST(Refits, KeepWhatTheyFindFromASmallerRefit) {
  EXPECT_EQ(Listed({4, 5, 6}).outcome(true), "4 after 3");
  EXPECT_EQ(Listed({9, 5, 6}).outcome(true), "5 after 3");
  EXPECT_EQ(Listed({refused, 5, 6}).outcome(true), "5 after 3");
  EXPECT_EQ(Listed({4, refused}).outcome(true), "4 after 3");
}

// From there, at two shares of the way, and next to the base.
TEST(Refits, TakeSixtyPredictionsForAFitAtMost) {
  Listed causes({0});
  causes.steep = true;
  const Refit nothing = causes.bare();
  EXPECT_EQ(causes.fit(&nothing)->fit.evaluations, 60u);
  EXPECT_THAT(causes.points, SizeIs(4 * 60));
}

TEST(SecondSearch, IsForWhatTheBaseFitDroveToABoundAlone) {
  Listed causes({1000});
  const Refit before = causes.ended(20, 0.1, 0, 5);
  causes.again(before);
  EXPECT_THAT(causes.points, Not(IsEmpty()));
  causes.again(before, 20);
  EXPECT_THAT(causes.points, Not(IsEmpty()));
  causes.again(before, 20.5);
  EXPECT_THAT(causes.points, IsEmpty()) << "it is below what is enough";
  causes.analysis.evidence.fit.at_bound = {false, false};
  causes.points.clear();
  EXPECT_EQ(searched_again(causes.inquiry(), causes.analysis, before).fit.chi2, 20);
  EXPECT_THAT(causes.points, IsEmpty());
}

// c is at a bound of the base and is drawn every time, b every second time.
TEST(SecondSearch, DrawsWhatIsAtABoundAndEverySecondTimeTheRest) {
  Listed causes({1000});
  causes.again(causes.ended(20, 0.3, 1.5, 13));
  ASSERT_GE(causes.points.size(), 64u);
  std::vector<double> b, c, amplitudes;  // in the box, and as a share of the way
  for (std::size_t k = 0; k < 64; ++k) {
    const Listed::Point& point = causes.points[k];
    c.push_back((point.c + 5) / 10);
    amplitudes.push_back((point.amplitude - 3) / 10);
    if (k % 2 == 0)
      EXPECT_NEAR(point.b, 0.3, 1e-12);
    else
      b.push_back(std::log(point.b / 0.01) / std::log(1 / 0.01));
  }
  for (std::vector<double>* all : {&b, &c, &amplitudes}) {
    EXPECT_THAT(*all, Each(AllOf(Ge(0.02 - 1e-12), Le(0.98 + 1e-12))));
    std::sort(all->begin(), all->end());
    EXPECT_EQ(std::adjacent_find(all->begin(), all->end()), all->end()) << "no two are alike";
    // Of 32, all on one side of a quarter with probability 1e-4.
    EXPECT_LT(all->front(), 0.25);
    EXPECT_GT(all->back(), 0.75);
  }
}

TEST(SecondSearch, DrawsWithinTheBoxUpToAFiftiethOfItsEnds) {
  double least = 1, most = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Listed causes({1000});
    causes.request.seed = seed;
    causes.again(causes.ended(20, 0.3, 1.5, 13));
    for (std::size_t k = 0; k < 64; ++k) {
      const double share = (causes.points[k].amplitude - 3) / 10;
      least = std::min(least, share);
      most = std::max(most, share);
    }
  }
  // Of 1280 that are even between 0.02 and 0.98, none beyond with probability 2e-6.
  EXPECT_THAT(least, AllOf(Ge(0.02), Le(0.03)));
  EXPECT_THAT(most, AllOf(Ge(0.97), Le(0.98)));
}

TEST(SecondSearch, BeginsFromTheBestOfTheDraws) {
  for (const bool quick : {true, false}) {
    Listed causes({1000});
    causes.request.quick = quick;
    const std::size_t draws = quick ? 12 : 64, starts = quick ? 3 : 16;
    causes.list.clear();
    // The last are best; what the fits leave is worse, so that none is a return.
    for (std::size_t k = 0; k < draws; ++k) causes.list.push_back(500 - static_cast<double>(k));
    causes.list.push_back(1000);
    causes.again(causes.ended(20, 0.3, 1.5, 13));
    ASSERT_THAT(causes.points, SizeIs(draws + starts));
    for (std::size_t k = 0; k < starts; ++k)
      EXPECT_THAT(causes.points[draws + k], is_point(causes.points[draws - 1 - k])) << k;
  }
}

TEST(SecondSearch, LeavesOutDrawsThatCannotBeEvaluated) {
  Listed causes(std::vector<double>(12, refused));
  causes.request.quick = true;
  causes.list[4] = 300;
  causes.list[7] = 200;
  causes.list.push_back(1000);
  causes.again(causes.ended(20, 0.3, 1.5, 13));
  ASSERT_THAT(causes.points, SizeIs(12 + 2));
  EXPECT_THAT(causes.points[12], is_point(causes.points[7]));
  EXPECT_THAT(causes.points[13], is_point(causes.points[4]));
}

TEST(SecondSearch, KeepsTheBestAndEndsOnceItComesBackToIt) {
  Listed causes({1000});
  causes.request.quick = true;
  EXPECT_EQ(causes.again_with({20.04, 1}, 20), "20 after 1");
  EXPECT_EQ(causes.again_with({19.96, 1}, 20), "19.96 after 1");
  EXPECT_EQ(causes.again_with({20.06, 20.04, 1}, 20), "20 after 2");
  EXPECT_EQ(causes.again_with({15, 15.04, 1}, 20), "15 after 2") << "another minimum, and back to that";
  EXPECT_EQ(causes.again_with({refused, 18, 25, 1}, 20), "18 after 3");
}

TEST(SecondSearch, ComesBackFourTimesUnlessItIsQuick) {
  Listed causes({1000});
  EXPECT_EQ(causes.again_with({20.01, 20.02, 19.97, 25, 20.01, 1}, 20), "19.97 after 5");
  EXPECT_EQ(causes.again_with({20.01, 20.02, 20.03, 15, 15.01, 15.02, 15.03, 20, 15.04, 1}, 20), "15 after 9")
      << "counted anew from a better minimum";
}

TEST(SecondSearch, EndsBelowWhatIsEnough) {
  Listed causes({1000});
  EXPECT_EQ(causes.again_with({25, 12, 9, 1}, 20, 10), "9 after 3");
  EXPECT_EQ(causes.again_with({25, 10, 9, 1}, 20, 10), "9 after 3");
}

TEST(SecondSearch, TakesSixtyPredictionsForAFitAtMost) {
  Listed causes({0});
  causes.steep = true;
  causes.request.quick = true;
  EXPECT_EQ(causes.again(causes.ended(1e300, 0.1, 0, 5)).fit.evaluations, 60u);
  EXPECT_THAT(causes.points, SizeIs(12 + 3 * 60));
}

}  // namespace
}  // namespace tunica::diagnosis
