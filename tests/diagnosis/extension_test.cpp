// SPDX-License-Identifier: Apache-2.0
// Mechanisms that are added to an experiment: where they stand, with which options, and which parameters are theirs.
#include "diagnosis/hypotheses/extension.hpp"

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Two tests, and a mechanism with options and two nuisance parameters.
struct Extended : MadeUpCauses {
  Extended() : MadeUpCauses({3, 3}, Eigen::VectorXd::Zero(6)) {
    free("a", -10, 10);
    free("b", 0.01, 5);
    const Eigen::VectorXd shape = Eigen::VectorXd::Ones(6);
    MadeUp one{"m", shape, {{"a"}, {"b"}, {"a", "b"}}};
    one.null = 3;
    one.nuisance = {{"w", shape}, {"u", shape}};
    one.declare = [](MechanismFactory& factory) {
      factory.options = {Option::text("channel", "", "A channel."), Option::text("rows", "all", "Rows."),
                         Option::number("order", 2, {1, 9}, "A number."),
                         Option::quantity("time", "s", 0, "One without a default.")};
      factory.parameters[1].initial = 0.5;
      factory.parameters[2].initial = -0.25;
      factory.parameters[2].max = 40;
    };
    add(one);
    close();
  }
  [[nodiscard]] Extension with(const Addition& addition) const { return {experiment, run, {addition}, shelf}; }
  /// The parameter of that name.
  static std::size_t index(const Extension& extended, const std::string& name) {
    const auto& parameters = extended.assembly().layout().parameters;
    for (std::size_t j = 0; j < parameters.size(); ++j)
      if (parameters[j].name == name) return j;
    ADD_FAILURE() << "no parameter " << name;
    return 0;
  }
};

TEST(Extension, StandsInTheTestsOfItsPlace) {
  const Extended bed;
  const Extension both = bed.with({"m", {{"a", "b"}}, {}});
  for (const auto& test : both.experiment().tests) {
    ASSERT_THAT(test.mechanisms, SizeIs(1)) << test.name;
    EXPECT_EQ(test.mechanisms[0].type, "m");
  }
  const Extension one = bed.with({"m", {{"b"}}, {}, {}, "second"});
  EXPECT_THAT(one.experiment().tests[0].mechanisms, IsEmpty());
  ASSERT_THAT(one.experiment().tests[1].mechanisms, SizeIs(1));
  EXPECT_EQ(one.experiment().tests[1].mechanisms[0].as, "second");
  EXPECT_THAT(one.parts().at(0).amplitude, ElementsAre(bed.index(one, "b.second.v")));
  EXPECT_THAT(bed.experiment.tests[1].mechanisms, IsEmpty()) << "the experiment is as it was";
}

TEST(Extension, NamesApartWhatStandsBesideItsLike) {
  const Extended bed;
  const Addition addition{"m", {{"b"}}, {}};
  const Extension three(bed.experiment, bed.run, {addition, addition, {"m", {{"a"}}, {}}}, bed.shelf);
  ASSERT_THAT(three.additions(), SizeIs(3));
  EXPECT_EQ(three.additions()[0].as, "");
  EXPECT_EQ(three.additions()[1].as, "m_2");
  EXPECT_EQ(three.additions()[2].as, "") << "in another test";
  EXPECT_THAT(three.parts().at(1).amplitude, ElementsAre(bed.index(three, "b.m_2.v")));
}

TEST(Extension, HasOptionsFromTheirDefaultsThePlaceAndTheSetting) {
  const Extended bed;
  const auto options = [&](const Addition& addition) {
    return bed.with(addition).experiment().tests[0].mechanisms.at(0).options;
  };
  const Options plain = options({"m", {{"a"}}, {}});
  EXPECT_EQ(plain.text("channel"), "");
  EXPECT_EQ(plain.text("rows"), "all");
  EXPECT_EQ(plain.number("order"), 2);
  EXPECT_EQ(plain.values().count("time"), 0u);
  const Options set = options({"m", {{"a"}, "y", 1}, {{"w", 5.0}, {"order", 4.0}}});
  EXPECT_EQ(set.text("channel"), "y");
  EXPECT_EQ(set.text("rows"), "1:2:1");
  EXPECT_EQ(set.number("order"), 4);
  EXPECT_EQ(set.values().count("w"), 0u) << "a parameter is no option";
}

TEST(Extension, WritesDownTheRangeOfItsAmplitude) {
  const Extended bed;
  const auto amplitude = [&](std::optional<AmplitudeRange> range) {
    const Extension extended = bed.with({"m", {{"a"}}, {}, range});
    const auto& settings = extended.experiment().tests[0].mechanisms.at(0).parameters;
    return settings.empty() ? experiment::ParameterSetting() : settings.at("v");
  };
  EXPECT_FALSE(amplitude({}).min);
  const experiment::ParameterSetting set = amplitude(AmplitudeRange{-7, 13, -40, 50});
  EXPECT_EQ(set.min, -40);
  EXPECT_EQ(set.max, 50);
  EXPECT_DOUBLE_EQ(set.initial.value(), 0.1 * 13 + 0.9 * 3) << "a tenth of the way from the null";
  EXPECT_EQ(amplitude(AmplitudeRange{-7, 13, -40, 3.5}).initial, 3.5) << "within the bounds";
}

TEST(Extension, KnowsWhichParametersAreWhose) {
  const Extended bed;
  const Extension extended = bed.with({"m", {{"a", "b"}}, {{"u", 4.0}}});
  EXPECT_THAT(extended.base(), ElementsAre(bed.index(extended, "a"), bed.index(extended, "b")));
  const Extension::Part& part = extended.parts().at(0);
  const auto of_both = [&](const std::string& name) {
    return Variable{bed.index(extended, "a.m." + name), bed.index(extended, "b.m." + name)};
  };
  EXPECT_EQ(part.amplitude, of_both("v"));
  EXPECT_THAT(part.nuisance, ElementsAre(of_both("w"), of_both("u")));
  EXPECT_THAT(part.nuisance_start, ElementsAre(0.5, 4.0)) << "as declared, and as the setting has it";
  EXPECT_EQ(part.null, 3);
  const Variable a{extended.base()[0]}, b{extended.base()[1]};
  EXPECT_THAT(extended.variables(), ElementsAre(a, b, of_both("v"), of_both("w"), of_both("u")));
  EXPECT_THAT(extended.variables(false), ElementsAre(a, b, of_both("v")));
}

TEST(Extension, AtItsNullIsTheBareExperiment) {
  const Extended bed;
  const Extension extended = bed.with({"m", {{"a", "b"}}, {{"u", 1e4}}});
  const std::vector<double> base{7, 0.5}, null = extended.at_null(base);
  EXPECT_EQ(null.at(bed.index(extended, "a")), 7);
  EXPECT_EQ(null.at(bed.index(extended, "b")), 0.5);
  for (const std::string test : {"a.m.", "b.m."}) {
    EXPECT_EQ(null.at(bed.index(extended, test + "v")), 3);
    EXPECT_EQ(null.at(bed.index(extended, test + "w")), 0.5);
    EXPECT_EQ(null.at(bed.index(extended, test + "u")), 40) << "within its bounds";
  }
}

TEST(Extension, OfAMaterialStandsInItsModel) {
  const Extended bed;
  const Extension extended = bed.with({"cubic", {}, {}});
  for (const auto& test : extended.experiment().tests) EXPECT_THAT(test.mechanisms, IsEmpty());
  ASSERT_THAT(extended.experiment().models.at(0).mechanisms, SizeIs(1));
  EXPECT_EQ(extended.experiment().models[0].mechanisms[0].type, "cubic");
  EXPECT_THAT(extended.parts().at(0).amplitude, ElementsAre(bed.index(extended, "cubic.beta")));
}

// A wall of the layers v, m and v: the mechanism is in the material of one of them.
TEST(Extension, OfOneMaterialOfSeveralStandsInThatModel) {
  fakes::Bench bench;
  bench.experiment.models.push_back({"v", "valley", {}, {}, {}});
  auto& wall = bench.add_test("wall", {1, 2}, {1, 2});
  wall.type = "stack", wall.layers = {{"v", 1}, {"m", 3}, {"v", 0.5}};
  Place in_m{{}};
  in_m.model = "m";
  const Extension extended(bench.experiment, bench.run, {{"cubic", in_m, {}}}, bench.shelf);
  for (const auto& model : extended.experiment().models)
    EXPECT_THAT(model.mechanisms, SizeIs(model.name == "m" ? 1 : 0)) << model.name;
  EXPECT_THAT(extended.parts().at(0).amplitude, ElementsAre(Extended::index(extended, "m.cubic.beta")));
}

}  // namespace
}  // namespace tunica::diagnosis
