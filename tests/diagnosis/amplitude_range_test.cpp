// SPDX-License-Identifier: Apache-2.0
// How large amplitudes may be, from the data: ranges of curves over effects that are made by hand.
#include "diagnosis/hypotheses/amplitude_range.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using Side = MechanismFactory::Side;

constexpr double slight = 1e-9;

/// Test "a" with four rows that span 6, test "b" with three that span 2, and a mechanism that shows in both.
struct Ranged : MadeUpCauses {
  explicit Ranged(const std::function<void(MechanismFactory&)>& declare = {}, MadeUp one = shown_in_both())
      : MadeUpCauses({4, 3}, beyond()) {
    one.declare = declare;
    add(one);
    close();
  }
  static Eigen::VectorXd beyond() {
    // 1 + x/10 is what the base shows.
    Eigen::VectorXd wanted(7), base(7);
    wanted << 2, 8, 5, 3, -1, 1, 0.5;
    for (Eigen::Index i = 0; i < 7; ++i) base[i] = 1 + 0.1 * static_cast<double>(i);
    return wanted - base;
  }
  static MadeUp shown_in_both() {
    Eigen::VectorXd shape(7);
    shape << -4, 0.5, 1, 0, 0.25, 0, -0.5;
    return {"m", shape, {{"a"}, {"b"}, {"a", "b"}}};
  }
  [[nodiscard]] const MechanismFactory& mechanism() const { return shelf.mechanisms().at("m").factory; }
  [[nodiscard]] std::optional<AmplitudeRange> range(const Place& place) const {
    const Extension extended(experiment, run, {{"m", place, {}}}, shelf);
    return range_from_data(extended, mechanism(), {{}}, extended.at_null(analysis.evidence.fit.free),
                           *extended.assembly().evaluator().make_workspace());
  }
};

/// An effect of this share of the range is plausible, on both sides of a null.
std::function<void(MechanismFactory&)> effect(double share, double null = 0) {
  return [=](MechanismFactory& factory) {
    factory.plausible_effect = share;
    factory.plausible_min = null - 1e-3;
    factory.plausible_max = null + 1e-3;
  };
}

void expect_range(const std::optional<AmplitudeRange>& range, double null, double plausible) {
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->plausible_min, null - plausible, slight);
  EXPECT_NEAR(range->plausible_max, null + plausible, slight);
  EXPECT_NEAR(range->min, null - 5 * plausible, 5 * slight);
  EXPECT_NEAR(range->max, null + 5 * plausible, 5 * slight);
}

TEST(AmplitudeRange, OfAChannelSpansItsValues) {
  MadeUp one = Ranged::shown_in_both();
  one.null = 3;
  const Ranged causes({}, one);
  expect_range(causes.range({{"a"}, "y"}), 3, 6);
  expect_range(causes.range({{"b"}, "y"}), 3, 2);
}

TEST(AmplitudeRange, OfAChannelThatDoesNotChangeIsThatOfTheMechanism) {
  MadeUpCauses causes({2}, Eigen::Vector2d(0.1, 0));
  causes.add({"m", Eigen::Vector2d(1, 1)});
  causes.close();
  const Extension extended(causes.experiment, causes.run, {{"m", {{"a"}, "y"}, {}}}, causes.shelf);
  EXPECT_FALSE(range_from_data(extended, causes.shelf.mechanisms().at("m").factory, {{}},
                               extended.at_null(causes.analysis.evidence.fit.free),
                               *extended.assembly().evaluator().make_workspace()));
}

TEST(AmplitudeRange, LetsTheLargestEffectFillAShareOfTheCurve) {
  const Ranged causes(effect(0.5));
  expect_range(causes.range({{"a"}}), 0, 0.5 * 6 / 4);
  expect_range(causes.range({{"b"}}), 0, 0.5 * 2 / 0.5);
}

// A model that remembers has no Jacobian: the effect is a difference then. 3 d + d² has the slope 3 at the null.
TEST(AmplitudeRange, IsTheSameFromDifferences) {
  MadeUp one = Ranged::shown_in_both();
  one.null = 2;
  one.by = [](double distance) { return 3 * distance + distance * distance; };
  Ranged causes(effect(1, 2), one);
  causes.model().mechanisms.push_back({"memory", {}, {}, ""});
  const Extension extended(causes.experiment, causes.run, {{"m", {{"a", "b"}}, {}}}, causes.shelf);
  ASSERT_FALSE(extended.assembly().layout().jacobian_is_exact);
  const auto workspace = extended.assembly().evaluator().make_workspace();
  std::vector<double> null(extended.assembly().layout().parameters.size());
  for (std::size_t j = 0; j < null.size(); ++j) null[j] = extended.assembly().layout().parameters[j].initial;
  for (const std::size_t member : extended.parts().front().amplitude) null[member] = 2;
  const auto range = range_from_data(extended, causes.mechanism(), {{}}, null, *workspace);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->plausible_max, 2 + 6 / (3 * 4.0), 1e-6);
  EXPECT_NEAR(range->min, 2 - 5 * 6 / (3 * 4.0), 1e-5);
}

TEST(AmplitudeRange, OfSeveralCurvesIsThatOfTheOneThatAllowsLeast) {
  expect_range(Ranged(effect(1)).range({{"a", "b"}}), 0, 1.5);
  MadeUp weak_in_a = Ranged::shown_in_both();
  weak_in_a.shape.head(4) *= 0.1;
  expect_range(Ranged(effect(1), weak_in_a).range({{"a", "b"}}), 0, 4);
}

TEST(AmplitudeRange, IsThatOfTheMechanismWhereItsSizeDoesNotDependOnTheSpecimen) {
  EXPECT_FALSE(Ranged(effect(0)).range({{"a"}}));
}

TEST(AmplitudeRange, OfWhatShowsNowhereIsThatOfTheMechanism) {
  MadeUp nowhere = Ranged::shown_in_both();
  nowhere.shape.setZero();
  EXPECT_FALSE(Ranged(effect(1), nowhere).range({{"a"}}));
}

TEST(AmplitudeRange, LiesOnTheSideThatIsDeclared) {
  const auto one_side = [](double sign) {
    return [sign](MechanismFactory& factory) {
      factory.plausible_effect = 1;
      (sign > 0 ? factory.plausible_min : factory.plausible_max) = 0;
      (sign > 0 ? factory.parameters.front().min : factory.parameters.front().max) = 0;
    };
  };
  const auto up = Ranged(one_side(1)).range({{"a"}}), down = Ranged(one_side(-1)).range({{"a"}});
  ASSERT_TRUE(up && down);
  EXPECT_EQ(up->plausible_min, 0);
  EXPECT_EQ(up->min, 0);
  EXPECT_NEAR(up->plausible_max, 1.5, slight);
  EXPECT_NEAR(up->max, 7.5, slight);
  EXPECT_EQ(down->plausible_max, 0);
  EXPECT_EQ(down->max, 0);
  EXPECT_NEAR(down->plausible_min, -1.5, slight);
  EXPECT_NEAR(down->min, -7.5, slight);
}

// A number without a unit means the same in every specimen: what is declared stays within the range.
TEST(AmplitudeRange, OfANumberHoldsAtLeastWhatIsDeclared) {
  const auto declared = [](double plausible, double bound) {
    return [=](MechanismFactory& factory) {
      factory.plausible_effect = 1;
      factory.plausible_min = -plausible;
      factory.plausible_max = 2 * plausible;
      factory.parameters.front() = {"v", "1", 0, -bound, 2 * bound, Scale::linear, "", ""};
    };
  };
  const auto wide = Ranged(declared(10, 100)).range({{"a"}}), narrow = Ranged(declared(0.1, 1)).range({{"a"}});
  ASSERT_TRUE(wide && narrow);
  EXPECT_THAT((std::vector{wide->plausible_min, wide->plausible_max, wide->min, wide->max}),
              ElementsAre(-10, 20, -100, 200));
  EXPECT_NEAR(narrow->plausible_min, -1.5, slight);
  EXPECT_NEAR(narrow->plausible_max, 1.5, slight);
  EXPECT_NEAR(narrow->min, -7.5, slight);
  EXPECT_NEAR(narrow->max, 7.5, slight);
}

TEST(AmplitudeRange, FoundBeforeIsTaken) {
  const Ranged causes(effect(1));
  const auto values = [&](const Addition& addition) {
    const AmplitudeRange range = range_of(causes.mechanism(), addition);
    return std::vector{range.plausible_min, range.plausible_max, range.min, range.max};
  };
  EXPECT_THAT(values({"m", {{"a"}}, {}, AmplitudeRange{1, 2, 0, 3}}), ElementsAre(1, 2, 0, 3));
  EXPECT_THAT(values({"m", {{"a"}}, {}}), ElementsAre(-1e-3, 1e-3, -1000, 1000)) << "as the mechanism declares";
}

TEST(Setting, StandsInThePlaceOfNuisanceParametersWithinTheirBounds) {
  MadeUp one = Ranged::shown_in_both();
  one.nuisance = {{"w", one.shape}, {"u", one.shape}};
  const Ranged causes({}, one);
  const Extension extended(causes.experiment, causes.run, {{"m", {{"a", "b"}}, {}}}, causes.shelf);
  const std::vector<double> null = extended.at_null(causes.analysis.evidence.fit.free);
  const auto& nuisance = extended.parts().front().nuisance;
  ASSERT_EQ(nuisance.size(), 2u);
  ASSERT_EQ(nuisance[0].size(), 2u) << "one a test";
  const auto with = [&](const MechanismFactory::Setting& setting) {
    return with_setting(extended, causes.mechanism(), setting, null);
  };
  std::vector<double> expected = null;
  for (const std::size_t member : nuisance[1]) expected[member] = 7;
  EXPECT_EQ(with({{"u", 7}}), expected);
  EXPECT_EQ(with({{"other", 7}}), null);
  expected = null;
  for (const std::size_t member : nuisance[0]) expected[member] = 1000;
  for (const std::size_t member : nuisance[1]) expected[member] = -1000;
  EXPECT_EQ(with({{"w", 1e5}, {"u", -1e5}}), expected);
}

}  // namespace
}  // namespace tunica::diagnosis
