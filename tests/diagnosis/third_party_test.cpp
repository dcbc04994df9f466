// SPDX-License-Identifier: Apache-2.0
// A mechanism that tunica has never heard of, in a plugin of somebody else's, takes part in a diagnosis as its own do.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "cli/process.hpp"
#include "diagnosis/measured.hpp"

namespace tunica::trial {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// Both strips with a ripple of 1.5 kPa, five times the noise.
class ThirdParty : public ::testing::Test {
 protected:
  ThirdParty() {
    measured.measure(11, {},
                     [](const Strip&, double stretch) { return 1.5 * std::sin(2 * std::numbers::pi * stretch / 0.1); });
    measured.save();
  }
  [[nodiscard]] Ended tunica(std::vector<std::string> arguments, bool with_plugin = true) const {
    if (with_plugin) arguments.insert(arguments.begin(), {"--plugin-path", TUNICA_THIRD_PARTY_DIR});
    return trial::tunica(std::move(arguments), measured.folder.path());
  }
  [[nodiscard]] json diagnosis(const std::string& directory) const {
    return json::parse(text_of(measured.folder.path() / directory / "result.json"))["diagnosis"];
  }
  Measured measured;
};

TEST_F(ThirdParty, IsListedAndDescribedLikeTheOthers) {
  EXPECT_THAT(tunica({"list", "mechanisms"}).out, HasSubstr("grip_ripple"));
  EXPECT_THAT(tunica({"describe", "grip_ripple"}).out, HasSubstr("The spindle of the grips runs out of true"));
}

TEST_F(ThirdParty, IsNamedWhereItIsTheCauseAndItsExtensionRuns) {
  const Ended ended = tunica({"diagnose", "experiment.json", "-o", "out", "--quick", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("NAMED: consistent with grip_ripple"));
  const json found = diagnosis("out");
  ASSERT_EQ(found["verdict"], "named");
  ASSERT_EQ(found["causes"].size(), 1u);
  const json& cause = found["causes"][0];
  EXPECT_EQ(cause["id"], "grip_ripple");
  EXPECT_EQ(cause["target"]["tests"], json({"axial", "circumferential"}));
  EXPECT_GT(cause["probability"], 0.99);
  // Seed 11; the interval of 95 %, doubled: false alarm 1e-4.
  const double low = cause["amplitude"]["ci95"][0], high = cause["amplitude"]["ci95"][1];
  EXPECT_NEAR(cause["amplitude"]["value"], 1.5, high - low);
  EXPECT_LT(high - low, 0.5);
  EXPECT_THAT(cause["explanation"], HasSubstr("the stress ripples once a turn"));
  EXPECT_THAT(found["next_experiment"]["description"], HasSubstr("a run with a spring in the grips"));

  const Ended ran = tunica({"run", "out/extended.json", "-o", "extended", "--quiet"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const json result = json::parse(text_of(measured.folder.path() / "extended" / "result.json"));
  const double after = found["gain"]["after"];
  EXPECT_NEAR(result["runs"][0]["best"]["objective"].get<double>(), after, 1e-4 * after);
  EXPECT_THAT(result["provenance"]["plugins"].dump(), HasSubstr("our_machine 0.3"));
}

TEST_F(ThirdParty, IsNotNamedByThoseWhoDoNotHaveIt) {
  ASSERT_EQ(tunica({"diagnose", "experiment.json", "-o", "out", "--quick", "--quiet"}, false).code, 0);
  EXPECT_NE(diagnosis("out")["verdict"], "named");
  const Ended ended = tunica({"diagnose", "experiment.json", "-o", "other", "--mechanisms", "grip_ripple"}, false);
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("no loaded plugin provides the mechanism 'grip_ripple'"));
}

}  // namespace
}  // namespace tunica::trial
