// SPDX-License-Identifier: Apache-2.0
#include "calibration/overrides.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "calibration/fakes.hpp"
#include "experiment/reader.hpp"

namespace tunica {
namespace {

using calibration::Overrides;
using ::testing::HasSubstr;

const plugins::Catalogue no_plugins;

/// An experiment that says everything itself.
experiment::Experiment stated_experiment() {
  experiment::Experiment stated;
  stated.seed = 5;
  stated.analysis.profiles = {"c"};
  stated.analysis.bootstrap_draws = 60;
  stated.input_json = experiment::write_input(stated, no_plugins);
  return stated;
}

nlohmann::json documented(const experiment::Experiment& experiment) {
  return nlohmann::json::parse(experiment.input_json);
}

/// The file with one value replaced.
nlohmann::json stated_but(const char* pointer, const nlohmann::json& value) {
  auto expected = documented(stated_experiment());
  expected[nlohmann::json::json_pointer(pointer)] = value;
  return expected;
}

TEST(Overrides, LeaveTheFileAsItWasWhereNothingIsAsked) {
  auto experiment = stated_experiment();
  calibration::apply({}, no_plugins, experiment);
  EXPECT_EQ(experiment.input_json, stated_experiment().input_json) << "not even written anew";
  EXPECT_EQ(experiment.seed, 5u);
}

TEST(Overrides, PutAnotherSeedInTheFilesPlace) {
  auto experiment = stated_experiment();
  calibration::apply({.seed = 0}, no_plugins, experiment);
  EXPECT_EQ(experiment.seed, 0u);
  EXPECT_EQ(documented(experiment), stated_but("/seed", 0)) << "and leave the rest";
  EXPECT_EQ(experiment.analysis.profiles, std::vector<std::string>{"c"});
  EXPECT_EQ(experiment.analysis.bootstrap_draws, 60u);
  EXPECT_EQ(experiment.kept_evaluations, experiment::KeptEvaluations::all);
}

TEST(Overrides, NameTheProfilesOrAskForAll) {
  auto experiment = stated_experiment();
  calibration::apply({.profiles = {"a", "b"}}, no_plugins, experiment);
  EXPECT_EQ(experiment.analysis.profiles, (std::vector<std::string>{"a", "b"}));
  EXPECT_FALSE(experiment.analysis.all_profiles);
  EXPECT_EQ(documented(experiment), stated_but("/analysis/profiles", {"a", "b"}));

  calibration::apply({.profiles = {"all"}}, no_plugins, experiment);
  EXPECT_TRUE(experiment.analysis.all_profiles);
  EXPECT_TRUE(experiment.analysis.profiles.empty());
  EXPECT_EQ(documented(experiment), stated_but("/analysis/profiles", "all"));

  calibration::apply({.profiles = {"a"}}, no_plugins, experiment);
  EXPECT_FALSE(experiment.analysis.all_profiles) << "some in place of all";
  EXPECT_EQ(experiment.analysis.profiles, std::vector<std::string>{"a"});
}

TEST(Overrides, AskForAsManyDrawsFromThePosteriorAsTheFileCould) {
  auto experiment = stated_experiment();
  for (const std::uint64_t draws : {std::uint64_t{400}, std::uint64_t{1000000}}) {
    calibration::apply({.posterior_draws = draws}, no_plugins, experiment);
    EXPECT_EQ(experiment.analysis.posterior_draws, draws);
    EXPECT_EQ(documented(experiment), stated_but("/analysis/posterior/draws", draws));
  }
  for (const std::uint64_t draws : {std::uint64_t{0}, std::uint64_t{399}, std::uint64_t{1000001}})
    EXPECT_THAT(fakes::message_of([&] { calibration::apply({.posterior_draws = draws}, no_plugins, experiment); }),
                HasSubstr("expected a number from 400 to 1000000"))
        << draws;
  EXPECT_EQ(experiment.analysis.posterior_draws, 1000000u) << "a refused number changes nothing";
}

TEST(Overrides, AskForADiscrepancyOfThePosterior) {
  auto experiment = stated_experiment();
  calibration::apply({.posterior_draws = 800, .discrepancy = true}, no_plugins, experiment);
  EXPECT_TRUE(experiment.analysis.discrepancy);
  EXPECT_EQ(experiment.analysis.posterior_draws, 800u);
  auto alone = stated_experiment();
  alone.analysis.posterior_draws = 0;
  calibration::apply({.discrepancy = true}, no_plugins, alone);
  EXPECT_EQ(alone.analysis.posterior_draws, 4000u) << "as many as --posterior draws";
  EXPECT_TRUE(nlohmann::json::parse(alone.input_json)["analysis"]["posterior"]["discrepancy"]);
}

TEST(Overrides, AskForABootstrapOfAsManyDrawsAsTheFileCould) {
  auto experiment = stated_experiment();
  for (const std::uint64_t draws : {std::uint64_t{40}, std::uint64_t{200}, std::uint64_t{1000000}}) {
    calibration::apply({.bootstrap_draws = draws}, no_plugins, experiment);
    EXPECT_EQ(experiment.analysis.bootstrap_draws, draws);
    EXPECT_EQ(documented(experiment), stated_but("/analysis/bootstrap/draws", draws));
  }
  for (const std::uint64_t draws : {std::uint64_t{0}, std::uint64_t{39}, std::uint64_t{1000001}}) {
    EXPECT_THAT(fakes::message_of([&] { calibration::apply({.bootstrap_draws = draws}, no_plugins, experiment); }),
                HasSubstr("expected a number from 40 to 1000000"))
        << draws;
    EXPECT_EQ(experiment.analysis.bootstrap_draws, 1000000u) << "a refused number changes nothing";
  }
}

TEST(Overrides, SayWhichEvaluationsAreKept) {
  auto experiment = stated_experiment();
  calibration::apply({.keep_evaluations = "improvements"}, no_plugins, experiment);
  EXPECT_EQ(experiment.kept_evaluations, experiment::KeptEvaluations::improvements);
  EXPECT_EQ(documented(experiment), stated_but("/keep_evaluations", "improvements"));
  calibration::apply({.keep_evaluations = "all"}, no_plugins, experiment);
  EXPECT_EQ(experiment.kept_evaluations, experiment::KeptEvaluations::all);
  EXPECT_THAT(fakes::message_of([&] { calibration::apply({.keep_evaluations = "best"}, no_plugins, experiment); }),
              HasSubstr("found 'best'; expected all or improvements"));
}

}  // namespace
}  // namespace tunica
