// SPDX-License-Identifier: Apache-2.0
// The mend of a mistaken file as changes for programs: taken as a JSON Patch, they leave noise. Noise is 1 % of each
// range; seeds are stated. A true base raises a false alarm in 1 of 20 files.
#include <algorithm>

#include <gtest/gtest.h>

#include "diagnosis/output/outputs.hpp"
#include "diagnosis/wall.hpp"

namespace tunica::trial {
namespace {

using diagnosis::Diagnosis;
using diagnosis::FileCause;
using diagnosis::FileKind;
using diagnosis::Verdict;
using nlohmann::json;

/// The experiment with the first mistake of a kind mended as its changes say, a JSON Patch.
json taken_as_a_patch(const Wall& wall, const Diagnosis& found, FileKind kind) {
  const auto& causes = found.explanation.file.causes;
  const auto one =
      std::find_if(causes.begin(), causes.end(), [&](const FileCause& cause) { return cause.kind == kind; });
  json patch = json::array();
  if (one != causes.end())
    for (const auto& change : one->changes)
      patch.push_back({{"op", "add"}, {"path", change.path}, {"value", json::parse(change.value)}});
  EXPECT_FALSE(patch.empty()) << diagnosis::summary(found).plain();
  return wall.experiment.patch(patch);
}

TEST(File, ChangesOfTheFileLeaveNoise) {
  const auto mends = [](Wall& wall, FileKind kind) {
    wall.experiment = taken_as_a_patch(wall, wall.diagnose(), kind);
    EXPECT_EQ(wall.diagnose().explanation.verdict, Verdict::nothing_detected) << wall.experiment.dump(1);
  };
  Wall measures, units, angle, gain;
  measures.measure(2,
                   [](json& truth) { truth["tests"]["sheet_1"]["data"]["stress_measure"] = "second_piola_kirchhoff"; });
  mends(measures, FileKind::stress_measure);
  units.measure(4);
  units.scale("sheet_2", "stress_circumferential", 0.001);
  units.scale("sheet_2", "stress_axial", 0.001);
  const Diagnosis stated = units.diagnose();
  ASSERT_FALSE(stated.explanation.file.causes.empty());
  EXPECT_TRUE(stated.explanation.file.causes.front().changes.empty()) << "the noise would have to change too";
  units.experiment["tests"]["sheet_2"]["data"].erase("noise");
  units.experiment["tests"]["sheet_2"]["data"]["units"] = {{"stretch_axial", "1"}};  // it stays
  mends(units, FileKind::unit);
  EXPECT_EQ(units.experiment["tests"]["sheet_2"]["data"]["units"],
            json({{"stretch_axial", "1"}, {"stress_axial", "MPa"}, {"stress_circumferential", "MPa"}}));
  angle.measure(7);
  angle.experiment["models"]["gho"]["parameters"]["theta"]["fixed"] = 52;
  mends(angle, FileKind::angle);
  gain.measure(9, [](json& truth) {
    json one = mechanism("sheet_force_scale_error", "gain", 0.25);
    one["channel"] = "stress_axial";
    for (const char* const sheet : {"sheet_1", "sheet_2", "sheet_3"}) truth["tests"][sheet]["mechanisms"] = {one};
  });
  mends(gain, FileKind::calibration);
}

}  // namespace
}  // namespace tunica::trial
