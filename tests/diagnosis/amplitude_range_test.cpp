// SPDX-License-Identifier: Apache-2.0
// How large an amplitude may be, by the size of the data. The base shows 1 + x/10, and so do they.
#include "diagnosis/hypotheses/amplitude_range.hpp"

#include <gmock/gmock.h>

#include "diagnosis/search_bed.hpp"

namespace tunica::diagnosis::amplitude_range_test {
namespace {

using Settings = std::vector<MechanismFactory::Setting>;

void expect_range(const std::optional<AmplitudeRange>& found, double plausible_min, double plausible_max, double min,
                  double max) {
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->plausible_min, plausible_min, 1e-6);
  EXPECT_NEAR(found->plausible_max, plausible_max, 1e-6);
  EXPECT_NEAR(found->min, min, 1e-6);
  EXPECT_NEAR(found->max, max, 1e-6);
}

/// "a" at 1, 2, 5 with channels y and z (ten times as large), "b" at 3, 4: they span 0.4, 4 and 0.1.
struct Bed : SearchBed {
  Bed() {
    add("a", {1, 2, 5}, true);
    add("b", {3, 4});
  }
  std::optional<AmplitudeRange> range(MechanismFactory factory, const Place& place,
                                      const Settings& settings = {MechanismFactory::Setting{}}) {
    const std::string id = factory.id;
    put(std::move(factory));
    const MechanismFactory& mechanism = shelf.mechanisms().at(id).factory;
    const Extension extended(experiment, run, {{id, place, settings.front()}}, shelf);
    return range_from_data(extended, mechanism, settings, extended.at_null({}),
                           *extended.assembly().evaluator().make_workspace());
  }
};

MechanismFactory filling(const std::string& id, double share, Effect effect) {
  MechanismFactory factory = acting(id, std::move(effect));
  factory.plausible_effect = share;
  return factory;
}

const Effect proportional = [](double x, auto own, const Options&) { return own[0] * x; };

TEST(RangeFromData, OfAChannelIsItsSpan) {
  MechanismFactory channel = acting("channel", proportional);
  channel.options = {Option::text("channel", "y", "")};
  channel.null = 7;
  expect_range(Bed().range(channel, {{"a"}, "y"}), 6.6, 7.4, 5, 9);
  expect_range(Bed().range(channel, {{"a"}, "z"}), 3, 11, -13, 27);
  expect_range(Bed().range(channel, {{"b"}, "y"}), 6.9, 7.1, 6.5, 7.5);
  Bed flat;
  flat.add("flat", {2, 2});
  EXPECT_FALSE(flat.range(channel, {{"flat"}, "y"})) << "it spans nothing";
}

TEST(RangeFromData, IsTheDeclaredOneUnlessTheMechanismSaysOtherwise) {
  EXPECT_FALSE(Bed().range(acting("p", proportional), {{"a"}}));
}

// v x is 5 v at most in "a" of which the span is 0.4 in y, and 4 v in "b" with a span of 0.1.
TEST(RangeFromData, FillsTheChannelThatItShowsMostIn) {
  expect_range(Bed().range(filling("p", 1, proportional), {{"b"}}), -0.025, 0.025, -0.125, 0.125);
  expect_range(Bed().range(filling("p", 2, proportional), {{"a"}}), -0.16, 0.16, -0.8, 0.8);
  expect_range(Bed().range(filling("p", 0.5, proportional), {{"a", "b"}}), -0.0125, 0.0125, -0.0625, 0.0625);
  const Effect against = [](double x, auto own, const Options&) { return -own[0] * x; };
  expect_range(Bed().range(filling("p", 2, against), {{"a"}}), -0.16, 0.16, -0.8, 0.8);
  EXPECT_FALSE(Bed().range(filling("p", 1, [](double, auto, const Options&) { return 0.0; }), {{"a"}}))
      << "it shows nowhere";
  const Effect first = [](double x, auto own, const Options&) { return x == 1 ? own[0] : 0.0; };
  expect_range(Bed().range(filling("p", 1, first), {{"a"}}), -0.4, 0.4, -2, 2);
}

TEST(RangeFromData, StaysOnTheSidesThatTheMechanismHas) {
  MechanismFactory up = filling("up", 1, proportional), down = filling("down", 1, proportional);
  up.plausible_min = 0;
  expect_range(Bed().range(up, {{"b"}}), 0, 0.025, -0.125, 0.125);
  down.plausible_max = 0;
  expect_range(Bed().range(down, {{"b"}}), -0.025, 0, -0.125, 0.125);
  MechanismFactory bounded = filling("bounded", 1, proportional);
  bounded.parameters.front().min = 0;
  expect_range(Bed().range(bounded, {{"b"}}), -0.025, 0.025, 0, 0.125);
  bounded.parameters.front().min = -10;
  bounded.parameters.front().max = 0;
  expect_range(Bed().range(bounded, {{"b"}}), -0.025, 0.025, -0.125, 0);
}

TEST(RangeFromData, WithoutAUnitIsTheDeclaredOneAtLeast) {
  MechanismFactory share = filling("share", 1, proportional);
  share.parameters.front().unit = "1";
  expect_range(Bed().range(share, {{"b"}}), -1, 1, -10, 10);
  share.plausible_effect = 100;
  expect_range(Bed().range(share, {{"b"}}), -2.5, 2.5, -12.5, 12.5);
}

// v x^w: at w = 0 one unit shows as one unit, at w = 2 as 25.
TEST(RangeFromData, IsThatOfTheSettingThatAllowsMost) {
  MechanismFactory power = acting_with_nuisance(
      "power", [](double x, auto own, const Options&) { return own[0] * std::pow(x, own[1]); }, "1");
  power.plausible_effect = 1;
  const Settings settings{{{"w", 2}}, {{"w", 0}}, {{"w", 1}}};
  expect_range(Bed().range(power, {{"a"}}, settings), -0.4, 0.4, -2, 2);
  expect_range(Bed().range(power, {{"a"}}, {settings.front()}), -0.016, 0.016, -0.08, 0.08);
}

// What remembers has no derivatives: to S a share of the S of the row before is added, 1.1, 1.2 and 1.3 here.
TEST(RangeFromData, IsTakenFromADifferenceWhereThereAreNoDerivatives) {
  Bed bed;
  MechanismFactory memory = bed.shelf.mechanisms().at("memory").factory;
  memory.id = "remembering";
  memory.plausible_effect = 1;
  memory.parameters.front().unit = "kPa";
  memory.parameters.front().min = -1;
  memory.plausible_max = 3;
  const double reach = 0.1 / 1.3;
  expect_range(bed.range(memory, {}), -reach, reach, -5 * reach, 5 * reach);
  SearchBed alone;  // a row without one before it shows nothing
  alone.add("one", {9});
  alone.add("b", {3, 4});
  alone.put(memory);
  const Extension extended(alone.experiment, alone.run, {{"remembering", {}, {}}}, alone.shelf);
  const auto workspace = extended.assembly().evaluator().make_workspace();
  expect_range(range_from_data(extended, memory, {{}}, extended.at_null({}), *workspace), -reach, reach, -5 * reach,
               5 * reach);
}

TEST(WithSetting, PutsNuisanceParametersWhereItSaysWithinTheirBounds) {
  Bed bed;
  bed.put(acting_with_nuisance("p", proportional, "1"));
  const Extension extended(bed.experiment, bed.run, {{"p", {{"a", "b"}}, {}}}, bed.shelf);
  const MechanismFactory& mechanism = bed.shelf.mechanisms().at("p").factory;
  const std::vector<double> null = extended.at_null({});
  const auto values_at = [&](const MechanismFactory::Setting& setting) {
    const std::vector<double> all = with_setting(extended, mechanism, setting, null);
    std::vector<double> nuisance;
    for (const std::size_t member : extended.parts().front().nuisance.front()) nuisance.push_back(all[member]);
    for (const std::size_t member : extended.parts().front().amplitude) EXPECT_EQ(all[member], 0);
    return nuisance;
  };
  EXPECT_EQ(values_at({{"w", 7}}), (std::vector<double>{7, 7}));
  EXPECT_EQ(values_at({{"w", 700}}), (std::vector<double>{100, 100}));
  EXPECT_EQ(values_at({{"v", 7}, {"other", 8}}), (std::vector<double>{1, 1}));
}

}  // namespace
}  // namespace tunica::diagnosis::amplitude_range_test
