// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "experiment/reading.hpp"

namespace tunica::experiment {
namespace {

using testing::expect_within;

struct AnalysisBlock : testing::Reading {
  /// The example with this block in front of "diagnosis".
  static std::string block(const std::string& text) {
    return with(R"("diagnosis": {)", "\"analysis\": " + text + ", \"diagnosis\": {");
  }
};

TEST_F(AnalysisBlock, IsAbsentUnlessAskedFor) {
  const Experiment e = read(testing::design_example);
  EXPECT_FALSE(e.analysis.wanted());
  EXPECT_FALSE(nlohmann::json::parse(e.input_json).contains("analysis"));
}

TEST_F(AnalysisBlock, NamesProfilesBootstrapAndOptimizer) {
  const Experiment e =
      read(block(R"({"profiles": ["mu", "viscoelasticity.tau"], "bootstrap": {"draws": 200}, "optimizer": "lm"})"));
  EXPECT_TRUE(e.analysis.wanted());
  EXPECT_FALSE(e.analysis.all_profiles);
  EXPECT_EQ(e.analysis.profiles, (std::vector<std::string>{"mu", "viscoelasticity.tau"}));
  EXPECT_EQ(e.analysis.bootstrap_draws, 200u);
  EXPECT_EQ(e.analysis.optimizer, "lm");
  const auto input = nlohmann::json::parse(e.input_json);
  EXPECT_EQ(input["analysis"]["bootstrap"]["draws"], 200);
  EXPECT_EQ(input["analysis"]["profiles"].size(), 2u);
  const Experiment again = read(e.input_json);
  EXPECT_EQ(again.input_json, e.input_json);
}

TEST_F(AnalysisBlock, AsksForAllProfilesInOneWord) {
  const Experiment e = read(block(R"({"profiles": "all"})"));
  EXPECT_TRUE(e.analysis.all_profiles);
  EXPECT_EQ(e.analysis.bootstrap_draws, 0u);
  EXPECT_EQ(nlohmann::json::parse(e.input_json)["analysis"]["profiles"], "all");
}

TEST_F(AnalysisBlock, AsksForDrawsFromThePosterior) {
  const Experiment e = read(block(R"({"posterior": {"draws": 4000}})"));
  EXPECT_EQ(e.analysis.posterior_draws, 4000u);
  EXPECT_TRUE(e.analysis.wanted());
  EXPECT_FALSE(e.analysis.refits());
  EXPECT_EQ(nlohmann::json::parse(e.input_json)["analysis"]["posterior"]["draws"], 4000);
  EXPECT_EQ(read(e.input_json).input_json, e.input_json);
}

TEST_F(AnalysisBlock, AsksForADiscrepancyBesideTheModel) {
  const Experiment e = read(block(R"({"posterior": {"draws": 4000, "discrepancy": true}})"));
  EXPECT_TRUE(e.analysis.discrepancy);
  EXPECT_EQ(nlohmann::json::parse(e.input_json)["analysis"]["posterior"]["discrepancy"], true);
  EXPECT_EQ(read(e.input_json).input_json, e.input_json);
  EXPECT_FALSE(read(block(R"({"posterior": {"draws": 4000, "discrepancy": false}})")).analysis.discrepancy);
}

TEST_F(AnalysisBlock, IsRefusedWithAReason) {
  const auto refused = [&](const char* text) { return refusal(block(text)); };
  expect_within(refused(R"({"profile": "all"})"), "unknown key 'profile' in \"analysis\" (/analysis/profile");
  expect_within(refused(R"({"profiles": "every"})"), "unknown set of profiles 'every' (/analysis/profiles");
  expect_within(refused(R"({"profiles": [3]})"), "where the name of a parameter, as in results");
  expect_within(refused(R"({"bootstrap": 200})"), "an object, {\"draws\": 200},");
  expect_within(refused(R"({"bootstrap": {"draws": 5}})"), "a whole number of draws from 40");
  expect_within(refused(R"({"posterior": true})"), "an object, {\"draws\": 4000},");
  expect_within(refused(R"({"posterior": {"draws": 400, "discrepancy": 1}})"), "true or false");
  expect_within(refused(R"({"posterior": {"draws": 399}})"), "a whole number of draws from 400");
  expect_within(refused(R"({"optimizer": "lmm"})"), "unknown optimizer 'lmm' (/analysis/optimizer");
  expect_within(refused(R"({"optimizer": "hybrid"})"), "the optimizer 'hybrid' has stages (/analysis/optimizer");
}

TEST_F(AnalysisBlock, AsksForStabilityFurtherOutAndForAMap) {
  const Experiment e = read(block(R"({"stability": {"to": 2.5, "map": ["kappa", "k2"]}})"));
  EXPECT_EQ(e.analysis.stability_to, 2.5);
  EXPECT_EQ(e.analysis.stability_map, (std::vector<std::string>{"kappa", "k2"}));
  EXPECT_EQ(e.analysis.map_points, 41u);
  EXPECT_FALSE(e.analysis.wanted());
  EXPECT_EQ(read(e.input_json).input_json, e.input_json);
  expect_within(refusal(block(R"({"stability": {"to": 1}})")), "Expected a stretch above 1, up to 100.");
  expect_within(refusal(block(R"({"stability": {"map": ["kappa"]}})")), "two names of parameters");
  expect_within(refusal(block(R"({"stability": {"points": 1}})")),
                "a whole number of points along each parameter from 2");
}

}  // namespace
}  // namespace tunica::experiment
