// SPDX-License-Identifier: Apache-2.0
// `tunica plugin check --experiment`: tests and mechanisms as a file has them, with its data.
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "execution/folder.hpp"

namespace tunica {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const trial::Folder folder;
const std::string strips = TUNICA_SOURCE_DIR "/examples/lamb_aorta/experiment.json";

trial::Ended check(const std::string& plugin, const std::string& experiment) {
  return trial::tunica(
      {"plugin", "check", TUNICA_PLUGIN_DIR "/" + plugin + ".so", "--experiment", experiment, "--json"}, folder.path());
}

/// Of the findings with that outcome.
std::set<std::string> every(const std::string& what, const nlohmann::json& findings, const std::string& outcome) {
  std::set<std::string> values;
  for (const auto& one : findings)
    if (one["outcome"] == outcome) values.insert(one.value(what, ""));
  return values;
}

}  // namespace

// Its first rows are at rest, where the strip has a kink: the fibres begin to pull.
TEST(CheckWithAnExperiment, TakesTestsAsTheyStandThere) {
  const auto ended = check("uniaxial", strips);
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  const auto findings = nlohmann::json::parse(ended.out)["findings"];
  EXPECT_THAT(every("with", findings, "ok"),
              ElementsAre("", "as 'axial_strip' in the experiment, with model 'holzapfel_2015'",
                          "as 'circumferential_strip' in the experiment, with model 'holzapfel_2015'"));
  EXPECT_TRUE(every("with", findings, "not checked").empty()) << findings;
}

TEST(CheckWithAnExperiment, SaysOfWhatItHasNoTest) {
  const auto ended = check("biaxial", strips);
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_THAT(every("reason", nlohmann::json::parse(ended.out)["findings"], "not checked"),
              ElementsAre("the experiment has no test of this type"));
}

TEST(CheckWithAnExperiment, PutsMechanismsOnItsTests) {
  const auto ended = check("channel_errors", strips);
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  const auto all = nlohmann::json::parse(ended.out);
  std::set<std::string> on_strips;
  for (const auto& one : all["findings"])
    if (one["with"] == "on uniaxial" && one["outcome"] == "ok") on_strips.insert(one["name"].get<std::string>());
  EXPECT_THAT(on_strips, ElementsAre("force_offset", "force_scale_error", "outliers", "signal_drift"));
}

TEST(CheckWithAnExperiment, RefusesAFileThatIsNotThere) {
  const auto ended = check("uniaxial", "nothing.json");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("nothing.json: there is no such file"));
}

}  // namespace tunica
