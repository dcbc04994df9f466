// SPDX-License-Identifier: Apache-2.0
// Terms in an experiment: their ranges, their names, and what they replace.
#include "discovery/bound_set.hpp"

#include <gmock/gmock.h>

#include "discover/fitting.hpp"
#include "discovery/curves.hpp"

namespace tunica::discovery::bound_set_test {
namespace {

using ::testing::ElementsAre;
using trial::FittedRubber;

const assembly::FreeParameter& parameter(const BoundSet& set, const std::string& name) {
  return set.assembly().layout().parameters[trial::index_named(set.assembly(), name)];
}

KindPointer shared(Kind kind) { return std::make_shared<const Kind>(std::move(kind)); }

/// An amplitude goes up to the largest that is looked for, and begins at a hundredth of it.
TEST(TermsInAnExperiment, HaveTheRangesOfTheirKind) {
  const FittedRubber rubber;
  const auto law = rubber.kind("I2_exponential", [](Kind& kind) {
    kind.largest = 700;
    kind.shapes = {{"b", 0.02, 0.3, Scale::log, {0.05, 0.1}}};
  });
  const BoundSet set(rubber.subject, {law});
  EXPECT_EQ(set.terms().front().name, "I2_exponential");
  const auto& amplitude = parameter(set, "I2_exponential.mu");
  EXPECT_EQ(amplitude.min, 0);
  EXPECT_EQ(amplitude.max, 700);
  EXPECT_EQ(amplitude.initial, 7);
  EXPECT_EQ(amplitude.scale, Scale::linear);
  const auto& shape = parameter(set, "I2_exponential.b");
  EXPECT_EQ(shape.min, 0.02);
  EXPECT_EQ(shape.max, 0.3);
  EXPECT_EQ(shape.initial, 0.05);
  EXPECT_EQ(shape.scale, Scale::log);
  const auto power = rubber.kind("I1_power", [](Kind& kind) {
    kind.largest = 0;
    kind.shapes[0].scale = Scale::log;
  });
  const BoundSet open(rubber.subject, {power});
  EXPECT_EQ(parameter(open, "I1_power.k").max, 1e5) << "as declared";
  EXPECT_EQ(parameter(open, "I1_power.k").initial, 0.01);
  EXPECT_EQ(parameter(open, "I1_power.m").scale, Scale::log) << "as the kind says";
}

/// Amplitudes of powers of the stretches have the sign of their exponent.
TEST(TermsInAnExperiment, OfStretchesHaveASign) {
  const FittedRubber rubber;
  const auto of = [&](const char* name, double largest) {
    const BoundSet set(rubber.subject, {rubber.kind(name, [&](Kind& kind) { kind.largest = largest; })});
    const auto& amplitude = parameter(set, std::string(name) + ".mu");
    return std::vector<double>{amplitude.min, amplitude.initial, amplitude.max};
  };
  EXPECT_THAT(of("stretches_rising", 800), ElementsAre(0, 8, 800));
  EXPECT_THAT(of("stretches_falling", -800), ElementsAre(-800, -8, 0));
  EXPECT_THAT(of("stretches_falling", 0), ElementsAre(-5000, -50, 0));
}

/// A curve is one amplitude a knot, all in the same range, and its knots are those of the kind.
TEST(TermsInAnExperiment, OfACurveHaveOneHeightAKnot) {
  const FittedRubber rubber;
  Kind kind = curve_of(*rubber.kind("I1_linear"), 4);
  kind.largest = 500;
  for (const bool from_nothing : {false, true}) {
    const Subject subject{rubber.subject.experiment, rubber.subject.run, "rubber", from_nothing, testing::catalogue()};
    const BoundSet set(subject, {shared(kind)});
    const BoundTerm& term = set.terms().front();
    ASSERT_EQ(term.heights.size(), 5U);
    for (const std::size_t j : term.heights) {
      EXPECT_EQ(set.assembly().layout().parameters[j].max, 500);
      EXPECT_EQ(set.assembly().layout().parameters[j].initial, 5);
      EXPECT_EQ(set.assembly().layout().parameters[j].scale, Scale::linear);
    }
    EXPECT_EQ(set.assembly().layout().parameters.size(), from_nothing ? 6U : 7U);
  }
}

/// Copies of a kind are numbered from 2.
TEST(TermsInAnExperiment, OfOneKindAreNumbered) {
  const FittedRubber rubber;
  const auto power = rubber.kind("stretches_rising");
  const BoundSet set(rubber.subject, {power, power, power});
  ASSERT_EQ(set.terms().size(), 3U);
  EXPECT_EQ(set.terms()[0].name, "stretches_rising");
  EXPECT_EQ(set.terms()[1].name, "stretches_rising_2");
  EXPECT_EQ(set.terms()[2].name, "stretches_rising_3");
  EXPECT_NE(set.terms()[0].amplitude, set.terms()[1].amplitude);
  EXPECT_EQ(set.terms()[2].amplitude, trial::index_named(set.assembly(), "stretches_rising_3.mu"));
  EXPECT_EQ(set.terms()[2].shapes.front(), trial::index_named(set.assembly(), "stretches_rising_3.alpha"));
}

/// From nothing the terms are the whole model: nothing is left of what it was.
TEST(TermsInAnExperiment, FromNothingAreTheModel) {
  trial::ToFit what;
  what.with = [](nlohmann::json& experiment) {
    auto& model = experiment["models"]["rubber"];
    model["type"] = "gho";
    model["parameters"] = {{"kappa", {{"fixed", 0.1}}}, {"theta", {{"fixed", 40}}}};
    model["mechanisms"] = {{{"type", "added_term"}, {"invariant", "I1"}, {"law", "cubic"}}};
  };
  const FittedRubber rubber(what);
  const Subject subject{rubber.subject.experiment, rubber.subject.run, "rubber", true, testing::catalogue()};
  const BoundSet set(subject, {rubber.kind("I2_linear"), rubber.kind("fibre_diagonal_quadratic")});
  ASSERT_EQ(set.assembly().layout().parameters.size(), 3U);
  const auto& model = set.experiment().models.front();
  EXPECT_EQ(model.type, "composed");
  EXPECT_TRUE(model.mechanisms.empty());
  EXPECT_EQ(model.parameters.size(), 3U);
  EXPECT_EQ(model.options.values().size(), 1U);
  EXPECT_EQ(set.terms()[0].amplitude, trial::index_named(set.assembly(), "I2_linear_mu"));
  EXPECT_EQ(set.terms()[1].amplitude, trial::index_named(set.assembly(), "fibre_diagonal_quadratic_k"));
  EXPECT_EQ(set.terms()[1].shapes.front(), trial::index_named(set.assembly(), "fibre_diagonal_quadratic_theta"));
}

TEST(IndexOfAParameter, IsThatOfItsTermOrNone) {
  const FittedRubber rubber;
  const BoundSet set(rubber.subject, {rubber.kind("I2_linear")});
  EXPECT_EQ(set.terms()[0].amplitude, index_of(set.assembly(), rubber.subject, "I2_linear", "mu"));
  EXPECT_THROW((void)index_of(set.assembly(), rubber.subject, "I2_linear", "nu"), std::logic_error);
}

}  // namespace
}  // namespace tunica::discovery::bound_set_test
