// SPDX-License-Identifier: Apache-2.0
// An experiment with what was added: entries, parameters and where they begin.
#include "diagnosis/hypotheses/extension.hpp"

#include <gmock/gmock.h>

#include "diagnosis/search_bed.hpp"
#include "plugins/guarded.hpp"

namespace tunica::diagnosis::extension_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const Effect proportional = [](double x, auto own, const Options&) { return own[0] * x; };

/// Tests "a" and "b", of which the base has a free parameter "a".
struct Bed : SearchBed {
  Bed() {
    add("a", {1, 2});
    add("b", {3, 4});
    auto& setting = parameter("a");
    setting.fixed.reset();
    setting.initial = 2;
  }
  [[nodiscard]] Extension with(const std::vector<Addition>& additions) const {
    return {experiment, run, additions, shelf};
  }
};

std::vector<std::string> names_of(const Extension& extended, const Variable& variable) {
  std::vector<std::string> names;
  for (const std::size_t j : variable) names.push_back(extended.assembly().layout().parameters[j].name);
  return names;
}

TEST(ExtensionParts, AreAmplitudesAndNuisanceParametersOfAllTheirTests) {
  Bed bed;
  bed.put(acting_with_nuisance("p", proportional, "1"));
  const Extension extended = bed.with({{"p", {{"a", "b"}}, {{"w", 7}}}, {"cubic", {}, {}}});
  ASSERT_EQ(extended.parts().size(), 2u);
  EXPECT_THAT(names_of(extended, extended.parts()[0].amplitude), ElementsAre("a.p.v", "b.p.v"));
  EXPECT_THAT(names_of(extended, extended.parts()[0].nuisance[0]), ElementsAre("a.p.w", "b.p.w"));
  EXPECT_EQ(extended.parts()[0].nuisance_start[0], 7) << "as the setting says";
  EXPECT_THAT(names_of(extended, extended.parts()[1].amplitude), ElementsAre("cubic.beta"));
  EXPECT_EQ(bed.with({{"p", {{"a"}}, {{"v", 7}}}}).parts()[0].nuisance_start[0], 1) << "its initial value";

  std::vector<std::vector<std::string>> all, without;
  for (const Variable& one : extended.variables()) all.push_back(names_of(extended, one));
  for (const Variable& one : extended.variables(false)) without.push_back(names_of(extended, one));
  using Names = std::vector<std::string>;
  EXPECT_THAT(all, ElementsAre(Names{"a"}, Names({"a.p.v", "b.p.v"}), Names({"a.p.w", "b.p.w"}), Names{"cubic.beta"}));
  EXPECT_THAT(without, ElementsAre(Names{"a"}, Names({"a.p.v", "b.p.v"}), Names{"cubic.beta"}));

  const std::vector<double> base{5};
  const std::vector<double> null = extended.at_null(base);
  EXPECT_EQ(null[extended.base().front()], 5);
  for (const std::size_t j : extended.parts()[0].amplitude) EXPECT_EQ(null[j], 0);
  for (const std::size_t j : extended.parts()[0].nuisance[0]) EXPECT_EQ(null[j], 7);
}

TEST(ExtensionEntries, HaveTheBoundsThatTheDataAllow) {
  Bed bed;
  MechanismFactory factory = acting("p", proportional);
  factory.null = 1;
  bed.put(factory);
  const auto entry_with = [&](const AmplitudeRange& range) {
    const Extension extended = bed.with({{"p", {{"b"}}, {}, range}});
    EXPECT_THAT(extended.experiment().tests[0].mechanisms, IsEmpty());
    return extended.experiment().tests[1].mechanisms.at(0).parameters.at("v");
  };
  const auto wide = entry_with({-3, 5, -20, 30});
  EXPECT_EQ(wide.min, -20);
  EXPECT_EQ(wide.max, 30);
  EXPECT_NEAR(*wide.initial, 1.4, 1e-12) << "a tenth of the way to what is plausible";
  EXPECT_NEAR(*entry_with({-3, 5, -20, 1.2}).initial, 1.2, 1e-12) << "within the bounds";
  EXPECT_THAT(bed.with({{"p", {{"b"}}, {}}}).experiment().tests[1].mechanisms.at(0).parameters, IsEmpty());
}

TEST(ExtensionEntries, HaveTheOptionsOfTheirPlaceAndSetting) {
  Bed bed;
  MechanismFactory factory = acting("p", proportional);
  factory.options = {Option::text("channel", "none", ""), Option::text("rows", "all", ""),
                     Option::number("power", 1, {0, 9}, ""), Option::number("other", 2, {0, 9}, "")};
  bed.put(factory);
  Addition addition{"p", {{"a"}, "y"}, {{"power", 4}, {"nothing", 5}}};
  const auto options = [&] { return bed.with({addition}).experiment().tests[0].mechanisms.at(0).options; };
  EXPECT_EQ(options().text("channel"), "y");
  EXPECT_EQ(options().text("rows"), "all");
  EXPECT_EQ(options().number("power"), 4);
  EXPECT_EQ(options().number("other"), 2);
  addition.place.row = 1;
  EXPECT_EQ(options().text("rows"), "1:2:1");
}

TEST(ExtensionEntries, OfAModelGoToTheModel) {
  const Bed bed;
  const Extension extended = bed.with({{"cubic", {}, {}}});
  ASSERT_EQ(extended.experiment().models[0].mechanisms.size(), 1u);
  EXPECT_EQ(extended.experiment().models[0].mechanisms[0].type, "cubic");
  for (const auto& test : extended.experiment().tests) EXPECT_THAT(test.mechanisms, IsEmpty());
}

TEST(ExtensionParts, AreMissedWhereAMechanismHasNotWhatItDeclares) {
  Bed bed;
  MechanismFactory factory = acting("p", proportional);
  factory.parameters.push_back({"w", "1", 0, 0, 1, Scale::linear, "", ""});
  bed.put(factory);
  EXPECT_THROW(static_cast<void>(bed.with({{"p", {{"a"}}, {}}})), plugins::PluginFailure);
}

}  // namespace
}  // namespace tunica::diagnosis::extension_test
