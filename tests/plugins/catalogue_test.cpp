// SPDX-License-Identifier: Apache-2.0
#include "plugins/catalogue.hpp"

#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/guarded.hpp"

namespace tunica::plugins {
namespace {

using ::testing::HasSubstr;

ModelFactory model(const std::string& type) {
  return {type, "", "", {}, [](const Options&) -> std::unique_ptr<Model> { return nullptr; }};
}

MechanismFactory mechanism(const std::string& id, tunica::Stage stage) {
  MechanismFactory factory{};
  factory.id = id;
  factory.stage = stage;
  return factory;
}

std::string refusal(Catalogue& catalogue, Catalogue::Registration stage, const std::string& plugin) {
  try {
    catalogue.commit(std::move(stage), plugin);
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "accepted";
}

TEST(Catalogue, RemembersWhichPluginAnEntryCameFrom) {
  Catalogue catalogue;
  Catalogue::Registration stage;
  stage.add(model("gho"));
  catalogue.commit(std::move(stage), "gho 0.1.0");
  ASSERT_EQ(catalogue.models().size(), 1u);
  EXPECT_EQ(catalogue.models().at("gho").plugin, "gho 0.1.0");
}

TEST(Catalogue, RefusesATakenNameAndNamesItsOwner) {
  Catalogue catalogue;
  Catalogue::Registration first, second;
  first.add(model("gho"));
  catalogue.commit(std::move(first), "gho 0.1.0");
  second.add(model("hgo"));
  second.add(model("gho"));
  EXPECT_EQ(refusal(catalogue, std::move(second), "copycat 9.9"),
            "the model 'gho' is already provided by plugin 'gho 0.1.0', and names must be unique; rename it, or "
            "leave one of the two plugins out of the plugin path");
  EXPECT_EQ(catalogue.models().count("hgo"), 0u) << "all or nothing";
}

TEST(Catalogue, TakesNothingWhenALaterKindIsRefused) {
  Catalogue catalogue;
  Catalogue::Registration stage;
  stage.add(model("gho"));
  stage.add(mechanism("fibre_dispersion", tunica::Stage::invariants));
  EXPECT_THAT(refusal(catalogue, std::move(stage), "x 1"), HasSubstr("no wrap_model function"));
  EXPECT_TRUE(catalogue.models().empty());
}

TEST(Catalogue, RefusesANameThatOnePluginRegistersTwice) {
  Catalogue catalogue;
  Catalogue::Registration stage;
  stage.add(model("gho"));
  stage.add(model("gho"));
  EXPECT_EQ(refusal(catalogue, std::move(stage), "x 1"),
            "the plugin registers the model 'gho' twice; rename one of them");
}

TEST(Catalogue, AllowsTheSameNameForDifferentKinds) {
  Catalogue catalogue;
  Catalogue::Registration stage;
  stage.add(model("identity"));
  stage.add(
      OptimizerFactory{"identity", "", "", {}, [](const Options&) -> std::unique_ptr<Optimizer> { return nullptr; }});
  EXPECT_EQ(refusal(catalogue, std::move(stage), "x 1"), "accepted");
}

TEST(Catalogue, RefusesNamesThatAreNoPlainIdentifiers) {
  for (const char* name : {"", "a.b", "4fibre", "neo hooke", "gho-2", "µ"}) {
    Catalogue catalogue;
    Catalogue::Registration stage;
    stage.add(model(name));
    EXPECT_EQ(refusal(catalogue, std::move(stage), "x 1"),
              std::string("the model name '") + name +
                  "' is not a plain identifier; expected letters, digits and underscores, with a letter first");
  }
}

TEST(Catalogue, RefusesFactoriesThatCannotBeCalled) {
  Catalogue catalogue;
  Catalogue::Registration uncreatable, unwrappable;
  uncreatable.add(ModelFactory{"gho", "", "", {}, {}});
  EXPECT_EQ(refusal(catalogue, std::move(uncreatable), "x 1"),
            "the model 'gho' has no create function; set it before registering");
  unwrappable.add(mechanism("force_offset", tunica::Stage::test));
  EXPECT_EQ(refusal(catalogue, std::move(unwrappable), "x 1"),
            "the mechanism 'force_offset' has no wrap_test function, which its stage needs; set it before registering");
}

/// What a catalogue says of an optimiser with this option.
std::string refusal_of(Option option) {
  Catalogue catalogue;
  Catalogue::Registration stage;
  OptimizerFactory factory{
      "es", "", "", {std::move(option)}, [](const Options&) { return std::unique_ptr<Optimizer>(); }};
  stage.add(std::move(factory));
  return refusal(catalogue, std::move(stage), "x 1");
}

TEST(Catalogue, RefusesDefaultsOfOptionsThatTheOptionItselfForbids) {
  EXPECT_EQ(refusal_of(Option::integer("starts", 20, {1, 10}, "")),
            "the optimiser 'es': the option 'starts' has the default 20, outside its own bounds; expected 10 or less; "
            "correct the declaration");
  EXPECT_EQ(refusal_of(Option::number("step", 0, {1e-6, 1}, "")),
            "the optimiser 'es': the option 'step' has the default 0, outside its own bounds; expected 1e-06 or more; "
            "correct the declaration");
  EXPECT_THAT(refusal_of(Option::number("step", std::nan(""), {0, 1}, "")), HasSubstr("has the default nan"));
  EXPECT_EQ(refusal_of(Option::quantity("width", "mm", 1, "", 0.5)),
            "the optimiser 'es': the option 'width' has the default 0.5, outside its own bounds; expected 1 or more; "
            "correct the declaration");
  EXPECT_EQ(refusal_of(Option::choice("selection", {"plus", "comma"}, "minus", "")),
            "the optimiser 'es': the option 'selection' has the default 'minus', which is none of its choices; "
            "expected one of 'plus', 'comma'; correct the declaration");
  Option kind = Option::integer("starts", 2, {1, 10}, "");
  kind.fallback = 2.0;
  EXPECT_THAT(refusal_of(kind), HasSubstr("has a default of another kind than it declares"));
  EXPECT_EQ(refusal_of(Option::integer("starts", 10, {1, 10}, "")), "accepted");
  EXPECT_EQ(refusal_of(Option::choice("selection", {"plus", "comma"}, {}, "")), "accepted") << "none is no default";
}

TEST(Catalogue, RefusesParametersThatBeginOutsideTheirBounds) {
  Catalogue catalogue;
  Catalogue::Registration stage;
  MechanismFactory drift = mechanism("drift", tunica::Stage::test);
  drift.wrap_test = [](std::unique_ptr<tunica::Test> base, const Options&) { return base; };
  drift.parameters = {{"amplitude", "1", 2, -1, 1, Scale::linear, "", ""}};
  stage.add(std::move(drift));
  EXPECT_EQ(refusal(catalogue, std::move(stage), "x 1"),
            "the mechanism 'drift': the parameter 'amplitude' begins at 2, outside its own bounds; expected a value "
            "from -1 to 1; correct the declaration");
}

/// Parameters of a model depend on its options, so they are looked at when it is made, whoever makes it.
TEST(Catalogue, MakesNoModelWhoseParametersBeginOutsideTheirBounds) {
  class Stiff final : public Model {
   public:
    Stiff() { description_.parameters = {{"mu", "kPa", 500, 1, 200, Scale::log, "", ""}}; }
    [[nodiscard]] const ModelDescription& describe() const override { return description_; }
    Status evaluate(const MaterialPoints&, const MaterialResponse&) const override { return {}; }

   private:
    ModelDescription description_;
  };
  Catalogue catalogue;
  Catalogue::Registration stage;
  stage.add(ModelFactory{"stiff", "", "", {}, [](const Options&) { return std::make_unique<Stiff>(); }});
  catalogue.commit(std::move(stage), "rubbers 0.1.0");
  try {
    create(catalogue.models().at("stiff"), {});
    ADD_FAILURE() << "it was made";
  } catch (const InputError& problem) {
    EXPECT_STREQ(problem.what(),
                 "plugin 'rubbers 0.1.0': the model 'stiff': the parameter 'mu' begins at 500, outside its own bounds; "
                 "expected a value from 1 to 200; correct the declaration");
  }
}

}  // namespace
}  // namespace tunica::plugins
