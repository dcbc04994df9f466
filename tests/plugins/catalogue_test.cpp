// SPDX-License-Identifier: Apache-2.0
#include "plugins/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tunica::plugins
