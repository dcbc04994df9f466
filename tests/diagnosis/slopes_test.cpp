// SPDX-License-Identifier: Apache-2.0
// Signatures of one mechanism whose effect is a function made by hand: with a Jacobian, and by differences without.
#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/hypotheses/signatures.hpp"
#include "diagnosis/made_up_causes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;
using Side = MechanismFactory::Side;

const Eigen::Vector3d shape(1, -2, 0.5);

/// A mechanism of that side and effect by the distance from its null; a base that has a Jacobian, or none.
struct OneMechanism : MadeUpCauses {
  OneMechanism(Side side, const std::function<double(double)>& by, bool exact, double sign = 1,
               const std::function<void(MechanismFactory&)>& declare = {})
      : MadeUpCauses({3}, Eigen::VectorXd::Zero(3)) {
    MadeUp one{"m", shape, {{"a"}}, side, sign, 2};
    one.by = by;
    one.declare = declare;
    add(one);
    close();
    if (!exact) model().mechanisms.push_back({"memory", {}, {}, ""});
  }
  /// `native`: it is an imperfection that the simulation has itself.
  [[nodiscard]] std::vector<Slope> slopes(bool quick = false, const std::string& native = "") const {
    MechanismFactory mechanism = shelf.mechanisms().at("m").factory;
    mechanism.native = native;
    const Extension extended(experiment, run, {{"m", {{"a"}}, {}}}, shelf);
    const assembly::Layout& layout = extended.assembly().layout();
    std::vector<double> null;
    for (const auto& parameter : layout.parameters) null.push_back(parameter.initial);
    for (const std::size_t member : extended.parts().front().amplitude) null[member] = 2;
    const auto workspace = extended.assembly().evaluator().make_workspace();
    Eigen::VectorXd bare;
    Eigen::MatrixXd J;
    EXPECT_TRUE(whitened(extended.assembly(), null, *workspace, bare, layout.jacobian_is_exact ? &J : nullptr).ok());
    return slopes_of(extended, mechanism, null, bare, J, *workspace, quick);
  }
};

void expect_slope(const Slope& found, double slope, Side side, double within) {
  ASSERT_EQ(found.signature.size(), 3);
  EXPECT_LT((found.signature - slope * shape).norm(), within) << found.signature.transpose();
  EXPECT_EQ(found.side, side);
}

double cubic(double d) { return 3 * d + 4 * d * d + d * d * d; }

TEST(Slopes, AreThoseOfTheJacobian) {
  const auto both = OneMechanism(Side::both, cubic, true).slopes();
  ASSERT_THAT(both, SizeIs(1));
  expect_slope(both[0], 3, Side::both, 1e-6);
}

TEST(Slopes, FollowTheSideThatIsPlausible) {
  const auto down_only = [](MechanismFactory& factory) { factory.plausible_max = factory.null; };
  for (const bool exact : {true, false}) {
    const auto up = OneMechanism(Side::positive, cubic, exact).slopes();
    const auto down = OneMechanism(Side::positive, cubic, exact, -1, down_only).slopes();
    ASSERT_TRUE(up.size() == 1 && down.size() == 1) << exact;
    expect_slope(up[0], 3, Side::positive, 2e-3);
    EXPECT_EQ(up[0].sign, 1);
    expect_slope(down[0], -3, Side::positive, 2e-3);
    EXPECT_EQ(down[0].sign, -1);
  }
}

TEST(Slopes, AreDifferencesOfSecondOrderWithoutAJacobian) {
  const auto found = OneMechanism(Side::both, cubic, false).slopes();
  ASSERT_THAT(found, SizeIs(1));
  expect_slope(found[0], 3, Side::both, 1e-3);
  const auto quick = OneMechanism(
                         Side::both, [](double d) { return 3 * d; }, false)
                         .slopes(true);
  expect_slope(quick.at(0), 3, Side::both, 1e-6);
}

TEST(Slopes, AreLookedForOnTheOtherSideWhereTheFirstCannotBeEvaluated) {
  const auto found = OneMechanism(
                         Side::both, [](double d) { return d > 1e-7 ? NAN : 3 * d; }, false)
                         .slopes();
  ASSERT_THAT(found, SizeIs(1));
  expect_slope(found[0], 3, Side::both, 1e-3);
}

TEST(Slopes, OfASimulationWithAKinkAreOneForEachSide) {
  const OneMechanism kinked(
      Side::both, [](double d) { return d > 0 ? 5 * d : d; }, true);
  const auto two = kinked.slopes(false, "tilt");
  ASSERT_THAT(two, SizeIs(2));
  expect_slope(two[0], 5, Side::positive, 1e-6);
  EXPECT_EQ(two[0].sign, 1);
  expect_slope(two[1], -1, Side::positive, 1e-6);
  EXPECT_EQ(two[1].sign, -1);
  EXPECT_THAT(kinked.slopes(), SizeIs(1)) << "others have none";
  const auto smooth = OneMechanism(Side::both, cubic, true).slopes(false, "tilt");
  ASSERT_THAT(smooth, SizeIs(1));
  expect_slope(smooth[0], 3, Side::both, 1e-6);
}

// By the square of the amplitude; what goes with the fourth power does not disturb.
TEST(Slopes, OfAnEvenEffectAreThoseByTheSquare) {
  const auto found = OneMechanism(
                         Side::even, [](double d) { return 3 * d * d + 1e-3 * d * d * d * d; }, true)
                         .slopes();
  ASSERT_THAT(found, SizeIs(1));
  expect_slope(found[0], 3, Side::even, 1e-6);
}

// 3d + 4d² over a step h is 3 + 4h.
TEST(Slopes, AreOverAThousandthOfAPlausibleAmplitudeWhereTheyHaveToBeQuick) {
  const auto parabola = [](double d) { return 3 * d + 4 * d * d; };
  for (const bool above : {true, false}) {
    const auto range = [above](MechanismFactory& factory) {
      factory.plausible_max = factory.null + (above ? 100 : 1);
      factory.plausible_min = factory.null - (above ? 1 : 100);
    };
    const auto found = OneMechanism(Side::both, parabola, false, 1, range).slopes(true);
    expect_slope(found.at(0), 3.4, Side::both, 1e-6);
  }
  const auto near_only = OneMechanism(
                             Side::both, [&](double d) { return d > 0.007 ? NAN : parabola(d); }, false)
                             .slopes(true);
  expect_slope(near_only.at(0), 3 + 4 * 0.005, Side::both, 1e-6);  // a hundredth of that is the first within reach
}

// With 0.1d + 0.12d³ half a step and a whole one give 0.1 − 0.06h².
TEST(Slopes, AreOverWhatChangesResidualsByATenthOfTheirNoise) {
  const auto cubic = [](double d) { return 0.1 * d + 0.12 * d * d * d; };
  const double first = 0.5, h = first * 0.1 / (cubic(first) * shape.norm());
  ASSERT_LT(h, first);
  const auto found = OneMechanism(Side::both, cubic, false).slopes();
  expect_slope(found.at(0), 0.1 - 0.06 * h * h, Side::both, 1e-6);
}

TEST(Slopes, AreOverASmallerStepWhereThatPlaceCannotBeEvaluated) {
  const double aimed_at = 0.1 / (3 * shape.norm());
  const auto found = OneMechanism(
                         Side::both, [=](double d) { return std::abs(d / aimed_at - 1) < 0.01 ? NAN : 3 * d; }, false)
                         .slopes();
  expect_slope(found.at(0), 3, Side::both, 1e-6);
}

TEST(Slopes, AreNotLookedForNearerThanRoundingAllows) {
  const auto odd = OneMechanism(
                       Side::both, [](double d) { return std::abs(d) > 1e-9 ? NAN : 3 * d; }, false)
                       .slopes();
  EXPECT_EQ(odd.at(0).signature.size(), 0);
  EXPECT_THAT(OneMechanism(
                  Side::even, [](double d) { return std::abs(d) > 1e-4 ? NAN : 3 * d * d; }, true)
                  .slopes(),
              IsEmpty());
}

TEST(Slopes, OfAnEvenEffectAreGoodToAMillionthOrLookedForNearer) {
  // What goes with the sixth power makes two millionths over a twenty-fifth of the plausible amplitude.
  const auto smooth = OneMechanism(
                          Side::even, [](double d) { return 3 * d * d * (1 + 1.25e-11 * std::pow(d, 4)); }, true)
                          .slopes();
  expect_slope(smooth.at(0), 3, Side::even, 3e-6 * shape.norm());
  for (const double reach : {0.5, 0.0021}) {
    const auto near = OneMechanism(
                          Side::even, [=](double d) { return std::abs(d) > reach ? NAN : 3 * d * d; }, true)
                          .slopes();
    ASSERT_THAT(near, SizeIs(1)) << reach;
    expect_slope(near[0], 3, Side::even, 1e-4);
  }
}

TEST(Slopes, HaveNoKinkWhereASideCannotBeEvaluated) {
  // Plausible amplitudes so large that no step is short enough.
  const auto wide = [](MechanismFactory& factory) {
    factory.plausible_min = -1e6;
    factory.plausible_max = 1e6;
  };
  for (const auto& [up, down] : {std::pair{true, false}, {false, true}, {true, true}}) {
    const OneMechanism bed(
        Side::both, [up = up, down = down](double d) { return (up && d > 4e-4) || (down && d < -4e-4) ? NAN : 3 * d; },
        true, 1, wide);
    const auto found = bed.slopes(false, "tilt");
    ASSERT_THAT(found, SizeIs(1)) << up << down;
    expect_slope(found[0], 3, Side::both, 1e-6);
  }
}

TEST(Slopes, HaveNoKinkWhereTheSidesDifferByAHundredth) {
  const auto found = OneMechanism(
                         Side::both, [](double d) { return d > 0 ? 100 * d : 99 * d; }, true)
                         .slopes(false, "tilt");
  EXPECT_THAT(found, SizeIs(1));
  const auto kinked = OneMechanism(
                          Side::both, [](double d) { return d > 0 ? 100 * d : 94 * d; }, true)
                          .slopes(false, "tilt");
  EXPECT_THAT(kinked, SizeIs(2));
}

}  // namespace
}  // namespace tunica::diagnosis
