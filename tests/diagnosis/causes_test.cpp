// SPDX-License-Identifier: Apache-2.0
// A cause in words and numbers: amplitudes with their intervals, what the parameters had made up for, the sentence.
#include "diagnosis/naming/causes.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using Side = MechanismFactory::Side;

constexpr double normal_quantile_975 = 1.959963984540054;

/// A cause whose sentence is of one interval, and what its mechanism says of itself.
struct ToldCause {
  Cause cause;
  MechanismFactory mechanism;
  ToldCause() {
    cause.id = "force_offset";
    cause.place.tests = {"strip"};
    cause.amplitude = {"value", "kPa", 3.14159, 2.5, 3.9};
    mechanism.cause = "The force reads too high.";
  }
  [[nodiscard]] std::string text() const { return explanation_of(cause, mechanism); }
};

TEST(ExplanationOfACause, SaysWhereWhatAndHowMuch) {
  EXPECT_EQ(ToldCause{}.text(),
            "The misfit is consistent with force_offset in the test 'strip': The force reads too high. Here value = "
            "3.14 kPa (2.5 … 3.9).");
  ToldCause plain;
  plain.cause.amplitude.unit = "1";
  plain.cause.nuisance = {{"tau", "s", 12.345, 1, 2}, {"share", "1", 0.25, 0, 1}};
  EXPECT_THAT(plain.text(), EndsWith("Here value = 3.14 (2.5 … 3.9), tau = 12.3 s, share = 0.25."));
}

TEST(ExplanationOfACause, LeavesOutAnIntervalThatIsNotKnown) {
  for (double Amplitude::*end : {&Amplitude::low, &Amplitude::high}) {
    ToldCause said;
    said.cause.amplitude.*end = NAN;
    EXPECT_THAT(said.text(), EndsWith("Here value = 3.14 kPa."));
  }
}

TEST(ExplanationOfACause, NamesWhatItResembles) {
  ToldCause said;
  const std::string resembles = "(2.5 … 3.9). Beyond the range of these data it resembles ";
  said.mechanism.look_alikes = {"first"};
  EXPECT_THAT(said.text(), EndsWith(resembles + "first."));
  said.mechanism.look_alikes = {"first", "second"};
  EXPECT_THAT(said.text(), EndsWith(resembles + "first and second."));
  said.mechanism.look_alikes = {"first", "second", "third"};
  EXPECT_THAT(said.text(), EndsWith(resembles + "first, second and third."));
}

/// Six rows and a parameter a of the base that moves them all. m shows in the first two rows up and down, its nuisance
/// parameter w in the next two, idle in none; n shows in the first two alike, which a absorbs some of.
struct TwoCauses : MadeUpCauses {
  // 3 + 5 · (0.4, −0.4) + 2 · (3, −3) + 7 · (2, 2) in their rows, a beginning at 1; in the last two what nothing
  // explains
  explicit TwoCauses(double most_of_a = 50)
      : MadeUpCauses({6}, at_rows(6, {{0, 19}, {1, 15}, {2, 9}, {3, -3}, {4, 5}, {5, 1}})) {
    free("a", -50, most_of_a);
    const auto of_material = [](MechanismFactory& factory) { factory.origin = MechanismFactory::Origin::material; };
    add({"m",
         at_rows(6, {{0, 0.4}, {1, -0.4}}),
         {{"a"}},
         Side::both,
         1,
         0,
         {{"idle", at_rows(6, {})}, {"w", at_rows(6, {{2, 3}, {3, -3}})}}});
    add({"n", at_rows(6, {{0, 2}, {1, 2}}), {{"a"}}, Side::both, 1, 0, {}, of_material});
    close();
    both = *group_of({direction("m"), direction("n")}).refit;
  }
  [[nodiscard]] Cause cause(std::size_t which) const {
    Direction direction;
    direction.retained = 0.25;
    return cause_of(inquiry(), analysis, both, which, direction);
  }
  Refit both;
};

void expect_interval(const Amplitude& amplitude, const std::string& name, double value, double sd) {
  EXPECT_EQ(amplitude.name, name);
  EXPECT_NEAR(amplitude.value, value, 1e-3 * sd) << name;
  EXPECT_NEAR(amplitude.low, value - normal_quantile_975 * sd, 2e-3 * sd) << name;
  EXPECT_NEAR(amplitude.high, value + normal_quantile_975 * sd, 2e-3 * sd) << name;
  EXPECT_FALSE(amplitude.at_bound) << name;
  EXPECT_TRUE(amplitude.plausible) << name;
}

// Standard deviations are reciprocal lengths of what the others leave of a column: √0.32 of m, √18 of w,
// and of n, with (2, 2, 0, 0, 0, 0) − 2/3, √(16/3).
TEST(CauseOfARefit, HasEveryAmplitudeWithItsInterval) {
  const TwoCauses causes;
  const Cause first = causes.cause(0), second = causes.cause(1);
  EXPECT_EQ(first.id, "m");
  EXPECT_EQ(first.place.tests, std::vector<std::string>{"a"});
  EXPECT_EQ(first.group, CauseGroup::rig);
  EXPECT_EQ(first.retained, 0.25);
  expect_interval(first.amplitude, "v", 5, 1 / std::sqrt(0.32));
  EXPECT_EQ(first.amplitude.unit, "kPa");
  ASSERT_THAT(first.nuisance, SizeIs(2));
  expect_interval(first.nuisance[1], "w", 2, 1 / std::sqrt(18));
  EXPECT_EQ(first.nuisance[1].unit, "s");
  EXPECT_EQ(first.nuisance[0].name, "idle");
  EXPECT_TRUE(std::isnan(first.nuisance[0].low)) << "no row depends on it";
  EXPECT_THAT(first.explanation, Not(IsEmpty()));
  EXPECT_EQ(first.explanation, explanation_of(first, causes.inquiry().mechanism("m")));

  EXPECT_EQ(second.id, "n");
  EXPECT_EQ(second.group, CauseGroup::material);
  EXPECT_THAT(second.nuisance, IsEmpty());
  expect_interval(second.amplitude, "v", 7, std::sqrt(3) / 4);
}

// Without causes a takes a third of n, 2/3 · 7, and leaves 49 · 16/3 of its squares. All of 5 m and 2 w are left.
TEST(CauseOfARefit, SaysWhatTheParametersHadMadeUpFor) {
  const Cause cause = TwoCauses().cause(1);
  EXPECT_NEAR(cause.gain, 49 * 16 / 3.0 + 25 * 0.32 + 4 * 18, 1e-4);
  ASSERT_THAT(cause.shifts, SizeIs(1));
  EXPECT_EQ(cause.shifts[0].name, "a");
  EXPECT_EQ(cause.shifts[0].unit, "kPa");
  EXPECT_NEAR(cause.shifts[0].before, 1 + 3 + 14 / 3.0, 1e-4);
  EXPECT_NEAR(cause.shifts[0].after, 4, 1e-3);
}

// With a held at 3.5, n is as uncertain as its two rows alone, √8 long, and takes half of what a leaves there.
TEST(CauseOfARefit, HoldsWhatLiesAtABound) {
  const TwoCauses causes(3.5);
  const Amplitude amplitude = causes.cause(1).amplitude;
  EXPECT_NEAR((amplitude.high - amplitude.low) / 2, normal_quantile_975 / std::sqrt(8), 1e-6);
  EXPECT_NEAR(amplitude.value, 7 + 0.5 / 2, 1e-3);
}

/// The amplitude of one mechanism of this declaration that shows 1/sd in one row, where the data show `value` of it.
Amplitude amplitude_of(double value, double sd, Side side, const std::function<void(MechanismFactory&)>& declare) {
  MadeUpCauses causes({1}, Eigen::VectorXd::Constant(1, value / sd));
  causes.add({"m", Eigen::VectorXd::Constant(1, 1 / sd), {{"a"}}, side, 1, 0, {}, declare});
  causes.close();
  const Refit refit = *causes.single("m").best;
  return cause_of(causes.inquiry(), causes.analysis, refit, 0, causes.analysis.hypotheses.directions[0]).amplitude;
}

/// Plausible between these, and bounds twice as far out.
std::function<void(MechanismFactory&)> plausible_between(double min, double max) {
  return [min, max](MechanismFactory& factory) {
    factory.plausible_min = min;
    factory.plausible_max = max;
    factory.parameters.front().min = 2 * min;
    factory.parameters.front().max = 2 * max;
  };
}

TEST(AmplitudeOfACause, IsImplausibleBeyondItsUncertainty) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(amplitude_of(sign * 101.9, 1, Side::both, plausible_between(-100, 100)).plausible) << sign;
    EXPECT_FALSE(amplitude_of(sign * 102.1, 1, Side::both, plausible_between(-100, 100)).plausible) << sign;
  }
}

TEST(AmplitudeOfACause, HasAnIntervalWithinItsBounds) {
  const Amplitude high = amplitude_of(199, 2, Side::both, plausible_between(-100, 100));
  EXPECT_EQ(high.high, 200);
  EXPECT_NEAR(high.low, 199 - 2 * normal_quantile_975, 1e-2);
  const Amplitude low = amplitude_of(-199, 2, Side::both, plausible_between(-100, 100));
  EXPECT_EQ(low.low, -200);
  EXPECT_NEAR(low.high, -199 + 2 * normal_quantile_975, 1e-2);
}

TEST(AmplitudeOfACause, StaysOnTheSideOfItsNull) {
  const auto both_bounds = [](double plausible_min, double plausible_max) {
    return [=](MechanismFactory& factory) {
      factory.plausible_min = plausible_min;
      factory.plausible_max = plausible_max;
    };
  };
  const Amplitude up = amplitude_of(3, 2, Side::positive, both_bounds(0, 100));
  EXPECT_EQ(up.low, 0);
  EXPECT_NEAR(up.high, 3 + 2 * normal_quantile_975, 1e-2);
  const Amplitude down = amplitude_of(-3, 2, Side::positive, both_bounds(-100, 0));
  EXPECT_EQ(down.high, 0);
  EXPECT_NEAR(down.low, -3 - 2 * normal_quantile_975, 1e-2);
  EXPECT_LT(amplitude_of(3, 2, Side::both, both_bounds(-100, 100)).low, 0);
}

TEST(AmplitudeOfACause, IsAtABoundUnlessThatIsItsNull) {
  const Amplitude at_bound = amplitude_of(1000, 1, Side::both, plausible_between(-100, 100));
  EXPECT_TRUE(at_bound.at_bound);
  EXPECT_EQ(at_bound.value, 200);
  EXPECT_TRUE(std::isnan(at_bound.low)) << "nothing is left to move";
  EXPECT_FALSE(at_bound.plausible) << "twice as far as plausible";
  const Amplitude at_null = amplitude_of(-50, 1, Side::positive, plausible_between(0, 100));
  EXPECT_EQ(at_null.value, 0);
  EXPECT_FALSE(at_null.at_bound);
  EXPECT_TRUE(at_null.plausible);
  EXPECT_FALSE(amplitude_of(50, 1, Side::positive, plausible_between(0, 100)).at_bound);
}

// What w does, three times the amplitude does as well: the data say nothing about one without the other.
TEST(AmplitudeOfACause, IsOpenWhereItsNuisanceDoesTheSame) {
  MadeUpCauses causes({2}, at_rows(2, {{0, 6}, {1, -6}}));
  causes.add({"m",
              at_rows(2, {{0, 1}, {1, -1}}),
              {{"a"}},
              Side::both,
              1,
              0,
              {{"w", at_rows(2, {{0, 3}, {1, -3}})}},
              plausible_between(-100, 100)});
  causes.close();
  const Refit refit = *causes.single("m").best;
  const Cause cause =
      cause_of(causes.inquiry(), causes.analysis, refit, 0, causes.analysis.hypotheses.directions.front());
  EXPECT_EQ(cause.amplitude.low, -200);
  EXPECT_EQ(cause.amplitude.high, 200);
  EXPECT_TRUE(cause.amplitude.plausible);
}

}  // namespace
}  // namespace tunica::diagnosis
