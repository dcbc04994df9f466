// SPDX-License-Identifier: Apache-2.0
// The mend of a mistaken file as changes for programs: taken as a JSON Patch, they leave noise. Noise is 1 % of each
// range; seeds are stated. A true base raises a false alarm in 1 of 20 files.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/file/correction.hpp"
#include "diagnosis/output/outputs.hpp"
#include "diagnosis/wall.hpp"

namespace tunica::trial {
namespace {

using diagnosis::Change;
using diagnosis::Correction;
using diagnosis::Corrections;
using diagnosis::Diagnosis;
using diagnosis::FileCause;
using diagnosis::FileKind;
using diagnosis::Record;
using diagnosis::Verdict;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

json patched(const json& experiment, const std::vector<Change>& changes) {
  json patch = json::array();
  for (const Change& change : changes)
    patch.push_back({{"op", "add"}, {"path", change.path}, {"value", json::parse(change.value)}});
  return experiment.patch(patch);
}

/// The experiment with the first mistake of a kind mended as its changes say, a JSON Patch.
json taken_as_a_patch(const Wall& wall, const Diagnosis& found, FileKind kind) {
  const auto& causes = found.explanation.file.causes;
  const auto one =
      std::find_if(causes.begin(), causes.end(), [&](const FileCause& cause) { return cause.kind == kind; });
  const std::vector<Change> changes = one == causes.end() ? std::vector<Change>() : one->changes;
  EXPECT_FALSE(changes.empty()) << diagnosis::summary(found).plain();
  return patched(wall.experiment, changes);
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
  for (const char* const sheet : {"sheet_1", "sheet_2", "sheet_3"})
    EXPECT_EQ(gain.experiment["tests"][sheet]["mechanisms"][0]["parameters"],
              json::parse(R"({"gain": {"share": "sheet_force_scale_error_gain"}})"))
        << "the fit that was weighed has one amplitude for all sheets";
}

const std::vector<std::string> sheets{"sheet_1", "sheet_2", "sheet_3"};

experiment::Experiment read(const Wall& wall, const json& experiment) {
  return experiment::read_experiment(wall.folder.write("read.json", experiment.dump(2)), testing::catalogue());
}

Record record_of(const Wall& wall, const std::vector<std::string>& tests) {
  return {read(wall, wall.experiment), tests, testing::catalogue()};
}

/// The first correction of these tests that `is` accepts; there is one.
template <class Is>
Correction first_of(const Corrections& all, const std::vector<std::string>& tests, const Is& is) {
  const auto one = std::ranges::find_if(all, [&](const Correction& each) { return each.tests == tests && is(each); });
  if (one == all.end()) throw std::runtime_error("no such correction");
  return *one;
}

/// Both directions of the sheets stretched before the zero, by two amplitudes that all of them share.
Correction both_directions(const Wall& wall, const std::vector<std::string>& tests) {
  Corrections all;
  diagnosis::add_calibrations(record_of(wall, tests), tests, testing::catalogue(), all);
  return first_of(all, tests, [](const Correction& one) { return one.additions.size() == 2; });
}

std::vector<std::string> names_in(const experiment::TestEntry& test) {
  std::vector<std::string> names;
  for (const auto& mechanism : test.mechanisms) names.push_back(mechanism.name());
  return names;
}

TEST(FileChanges, TwoDirectionsOfASheetHaveNamesOfTheirOwn) {
  Wall wall;
  const Correction fresh = both_directions(wall, sheets);
  const auto read_back = read(wall, patched(wall.experiment, fresh.changes));
  for (const std::string& sheet : sheets) {
    const auto& mechanisms = read_back.test(sheet).mechanisms;
    ASSERT_THAT(names_in(read_back.test(sheet)), ElementsAre("sheet_prestretch", "sheet_prestretch_2"));
    EXPECT_EQ(mechanisms[0].parameters.at("stretch").share, "sheet_prestretch_stretch");
    EXPECT_EQ(mechanisms[1].parameters.at("stretch").share, "sheet_prestretch_2_stretch");
    EXPECT_NE(mechanisms[0].options.text("channel"), mechanisms[1].options.text("channel"));
  }
  EXPECT_THAT(fresh.mend, HasSubstr(R"("as": "sheet_prestretch_2")"));
  const Correction single = both_directions(wall, {"sheet_2"});
  EXPECT_THAT(single.mend, Not(HasSubstr("share"))) << "a group of one parameter is refused";
  EXPECT_THAT(names_in(read(wall, patched(wall.experiment, single.changes)).test("sheet_2")),
              ElementsAre("sheet_prestretch", "sheet_prestretch_2"));
}

TEST(FileChanges, AMechanismThatATestHasAlreadyKeepsItsName) {
  Wall wall;
  wall.experiment["tests"]["sheet_2"]["mechanisms"] = {
      mechanism("sheet_prestretch", "stretch", 0.01, {{"channel", "stress_axial"}})};
  const Correction one = both_directions(wall, sheets);
  const auto read_back = read(wall, patched(wall.experiment, one.changes));
  EXPECT_THAT(names_in(read_back.test("sheet_1")), ElementsAre("sheet_prestretch_2", "sheet_prestretch_3"));
  EXPECT_THAT(names_in(read_back.test("sheet_2")),
              ElementsAre("sheet_prestretch", "sheet_prestretch_2", "sheet_prestretch_3"));
}

/// Another measure for these strips, of which "axial" has these data.
std::vector<Change> measure_of_strips(Wall& wall, const std::vector<std::string>& strips, const json& data) {
  wall.experiment["tests"]["axial"]["data"] = data;
  Corrections all;
  diagnosis::add_stress_measures(record_of(wall, {"axial", "circumferential"}), {"axial", "circumferential"}, all);
  return first_of(all, strips, [](const Correction&) { return true; }).changes;
}

TEST(FileChanges, NumberedFilesAreOneObjectOfTheFile) {
  Wall wall;
  for (const char* const stretch : {"1.10", "1.2"})
    wall.folder.write(std::string("axial_") + stretch + ".csv", "stress [kPa]\n1\n2\n");
  const json numbered = json::parse(R"({"numbered_files": "axial_*.csv", "columns": {"stress": "stress"},
                                        "noise": {"absolute": 1}})");
  EXPECT_THAT(measure_of_strips(wall, {"axial"}, numbered), IsEmpty());
  EXPECT_THAT(measure_of_strips(wall, {"axial", "circumferential"}, numbered), IsEmpty()) << "half a mend is none";
  EXPECT_THAT(measure_of_strips(wall, {"circumferential"}, numbered), ::testing::SizeIs(1));
  EXPECT_THAT(measure_of_strips(wall, {"axial"}, json::array({numbered})), IsEmpty());
}

TEST(FileChanges, EachTableWithAStressGetsItsMeasure) {
  Wall wall;
  wall.folder.write("aside.csv", "stretch [1],aside [1]\n1.1,0.95\n1.2,0.9\n");
  const json tables = json::parse(R"([
      {"file": "aside.csv", "columns": {"stretch": "stretch", "transverse_stretch": "aside"}, "noise": {"absolute": 0.01}},
      {"file": "axial.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "noise": {"absolute": 1}}])");
  const std::vector<Change> changes = measure_of_strips(wall, {"axial"}, tables);
  ASSERT_THAT(changes, ::testing::SizeIs(1));
  EXPECT_EQ(changes.front().path, "/tests/axial/data/1/stress_measure");
  EXPECT_EQ(read(wall, patched(wall.experiment, changes)).test("axial").data.stress_measure,
            json::parse(changes.front().value).get<std::string>());
}

/// The stresses of these sheets a thousandfold.
Correction thousandfold(const Wall& wall, const std::vector<std::string>& tests) {
  Corrections all;
  diagnosis::add_units(record_of(wall, sheets), sheets, false, all);
  return first_of(all, tests, [](const Correction& one) {
    return one.sentence.starts_with("the stresses") && std::abs(one.rung - std::log(1000)) < 1e-9;
  });
}

TEST(FileChanges, UnitsOfSeveralTablesOrOfSeveralKindsAreNotMendedByHalves) {
  Wall wall;
  EXPECT_THAT(thousandfold(wall, {"sheet_1"}).changes, ::testing::SizeIs(1));
  json& sheet = wall.experiment["tests"]["sheet_1"]["data"];
  sheet["units"] = {{"stress_axial", "Pa"}};
  const Correction mixed = thousandfold(wall, {"sheet_1"});
  EXPECT_THAT(mixed.changes, IsEmpty()) << "one unit for both would change the axial stresses by another factor";
  EXPECT_THAT(mixed.mend, HasSubstr("times 1000"));
  EXPECT_THAT(thousandfold(wall, {"sheet_2"}).changes, ::testing::SizeIs(1));
  sheet.erase("units");
  sheet = json::array({sheet});
  EXPECT_THAT(thousandfold(wall, {"sheet_1"}).changes, IsEmpty());
  EXPECT_THAT(thousandfold(wall, {"sheet_2"}).changes, ::testing::SizeIs(1));
}

}  // namespace
}  // namespace tunica::trial
