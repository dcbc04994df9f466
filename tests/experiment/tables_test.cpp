// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "data/dataset.hpp"
#include "experiment/reading.hpp"

/// Data of a test in several tables.
namespace tunica::experiment {
namespace {

using testing::expect_within;

class Tables : public testing::Reading {
 protected:
  Tables() {
    for (const char* frame : {"frame_2.csv", "frame_10.csv", "frame_x.csv"})
      static_cast<void>(folder.write(frame, "stress [kPa],q\n1,0.5\n2,-1\n3,0.2\n4,0.9\n"));
  }
  /// The example, its strip with this value of "data".
  static std::string strip(std::string_view data) {
    constexpr std::string_view block = R"({
        "file": "circ.csv",
        "columns": {"stretch": "stretch", "stress": "stress"},
        "stress_measure": "cauchy",
        "rows": "0:240:6",
        "noise": {"relative": 0.02}
      })";
    return with(block, data);
  }
  static constexpr std::string_view table =
      R"({"file": "circ.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "noise": {"relative": 0.02}})";
};

TEST_F(Tables, AreReadOneAfterTheOther) {
  const auto experiment = read(strip(
      R"([{"file": "circ.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "noise": {"relative": 0.02}},
                     {"file": "circ2.csv", "columns": {"stretch": "stretch", "transverse_stretch": "stretch"}}])"));
  const data::DataRequest& request = experiment.test("circumferential_strip").data;
  ASSERT_EQ(request.tables.size(), 2u);
  EXPECT_EQ(request.columns.size(), 3u);
  EXPECT_EQ(request.files.size(), 2u);
  const data::Dataset all =
      data::read_dataset(request, testing::fake_catalogue().tests().at("uniaxial").factory.observables);
  const data::Dataset one =
      data::read_dataset(request.tables[0], testing::fake_catalogue().tests().at("uniaxial").factory.observables);
  ASSERT_EQ(all.count, 2 * one.count);
  ASSERT_EQ(all.channels.size(), 2u);
  for (std::size_t i = 0; i < one.count; ++i) {
    EXPECT_EQ(all.channels[0].values[i], one.channels[0].values[i]);
    EXPECT_TRUE(std::isnan(all.channels[1].values[i])) << "not measured in the first table";
    EXPECT_TRUE(std::isnan(all.channels[0].values[one.count + i]));
    EXPECT_EQ(all.channels[1].values[one.count + i], one.abscissae[0].second[i]);
    EXPECT_EQ(all.abscissae[0].second[one.count + i], one.abscissae[0].second[i]);
  }
  EXPECT_EQ(all.channels[0].noise->relative, 0.02);
  EXPECT_FALSE(all.channels[1].noise);
  // What is written as input.json reads back the same.
  EXPECT_EQ(read(experiment.input_json).input_json, experiment.input_json);
}

/// A force becomes a stress by the size of the specimen, in a table as elsewhere.
TEST_F(Tables, TakeWhatAMachineWrites) {
  static_cast<void>(folder.write("raw.csv", "stretch,F [mN],S [kPa]\n1,0,0\n1.1,8,2\n1.2,20,5\n"));
  const auto experiment =
      read(strip(R"([{"file": "raw.csv", "columns": {"stretch": "stretch", "force": "F"}, "specimen": {"area": 4},
                 "stress_measure": "first_piola_kirchhoff", "noise": {"absolute": "1 kPa"}},
                {"file": "raw.csv", "columns": {"stretch": "stretch", "stress": "S"},
                 "stress_measure": "first_piola_kirchhoff", "noise": {"absolute": "1 kPa"}},
                {"file": "circ2.csv", "columns": {"stretch": "stretch", "transverse_stretch": "stretch"}}])"));
  const auto& observables = testing::fake_catalogue().tests().at("uniaxial").factory.observables;
  const data::Dataset all = data::read_dataset(experiment.test("circumferential_strip").data, observables);
  ASSERT_EQ(all.channels.size(), 2u);
  EXPECT_EQ(all.channels[0].observable, "stress");
  EXPECT_DOUBLE_EQ(all.channels[0].values[2], 5);
  EXPECT_DOUBLE_EQ(all.channels[0].values[5], 5) << "a stress as it is continues the channel";
  EXPECT_EQ(experiment.test("circumferential_strip").weights.size(), 2u);
  EXPECT_EQ(all.channels[0].noise->absolute, 1);
  EXPECT_EQ(experiment.test("circumferential_strip").data.stress_measure, "first_piola_kirchhoff");
  EXPECT_EQ(read(experiment.input_json).input_json, experiment.input_json)
      << "a table without stress states no measure";
  EXPECT_EQ(read(experiment.input_json).test("circumferential_strip").data.noise.size(), 1u) << "noise is written too";
}

TEST_F(Tables, AreOneAFileWithItsNumber) {
  const auto experiment = read(strip(
      R"({"numbered_files": "frame_*.csv", "columns": {"stress": "stress"}, "where": {"q": [">= 0", "< 0.6"]}, "noise": {"relative": 0.02}})"));
  const data::Dataset all = data::read_dataset(experiment.test("circumferential_strip").data,
                                               testing::fake_catalogue().tests().at("uniaxial").factory.observables);
  EXPECT_EQ(all.abscissae[0].second, (std::vector<double>{2, 2, 10, 10})) << "by number, not by name";
  EXPECT_EQ(all.channels[0].values, (std::vector<double>{1, 3, 1, 3})) << "q below 0 and above 0.6 is left out";
  EXPECT_EQ(read(experiment.input_json).input_json, experiment.input_json);
}

TEST_F(Tables, AreRefusedWithAReason) {
  const auto refused = [&](const std::string& data) { return refusal(strip(data)); };
  expect_within(refused("[]"), "the list of tables of test 'circumferential_strip' is empty");
  expect_within(
      refused(
          "[" + std::string(table) +
          R"(, {"file": "circ2.csv", "columns": {"stretch": "stretch", "stress": "stress"}, "noise": {"relative": 0.1}}])"),
      "state another noise of 'stress'");
  expect_within(
      refused(R"([{"files": ["circ.csv", "circ2.csv"], "columns": {"stretch": "stretch", "stress": "stress"}}])"),
      "replicates are given in one of several tables");
  expect_within(refused(R"({"numbered_files": "frame.csv", "columns": {"stress": "stress"}})"), "has not one star");
  expect_within(refused(R"({"numbered_files": "shot_*.csv", "columns": {"stress": "stress"}})"),
                "no file 'shot_*.csv'");
  expect_within(refused(R"({"numbered_files": "frame_*.csv", "columns": {"stretch": "stress", "stress": "stress"}})"),
                "the number of a file means nothing");
  expect_within(refused(R"({"file": "circ.csv", "columns": {"stress": "stress"}, "constant": {"stress": 1}})"),
                "'stress' is no prescribed quantity");
  expect_within(refused(R"({"file": "circ.csv", "columns": {"stretch": "stretch"}, "constant": {"stretch": 1}})"),
                "has a column and a constant");
}

}  // namespace
}  // namespace tunica::experiment
