// SPDX-License-Identifier: Apache-2.0
#include "experiment/reading.hpp"

/// The keys of "data" for files as a testing machine writes them.
namespace tunica::experiment {
namespace {

using testing::expect_within;

class RigKeys : public testing::Reading {
 protected:
  /// The message about a strip whose data block ends with these keys.
  [[nodiscard]] std::string strip(std::string_view keys, std::string_view columns = force_and_way) const {
    return refusal(block(keys, columns));
  }
  [[nodiscard]] static std::string block(std::string_view keys, std::string_view columns = force_and_way) {
    std::string text = with(R"({"stretch": "stretch", "stress": "stress"})", columns);
    return with(R"("rows": "0:240:6")", keys, std::move(text));
  }
  static constexpr std::string_view force_and_way = R"({"displacement": "Way", "force": "Force"})";
  static constexpr std::string_view sizes =
      R"("specimen": {"width": 4, "thickness": "500 um", "gauge_length": "1 cm"})";
};

TEST_F(RigKeys, BecomeTyped) {
  const auto experiment = read(block(R"(
    "skip_lines": 6, "delimiter": "tab", "decimal": ",", "units": {"Way": "um"}, "where": {"set": ["a", 2], "side": "left"},
    "specimen": {"width": "4 mm", "thickness": "500 um", "gauge_length": "preload", "grip_distance": "1 cm"},
    "cycle": [2, 3], "cycles_from": 4, "branch": "loading", "preload": "0.1 N", "rows": "-50:",
    "compression": {"Way": "positive", "Force": "negative"})"));
  const data::DataRequest& data = experiment.test("circumferential_strip").data;
  EXPECT_EQ(data.layout.skip_lines, 6u);
  EXPECT_EQ(data.layout.delimiter, '\t');
  EXPECT_EQ(data.layout.decimal, ',');
  EXPECT_EQ(data.where.size(), 3u);
  EXPECT_EQ(data.where[1].second, "2");
  EXPECT_EQ(data.specimen.thickness, 0.5);
  EXPECT_TRUE(data.specimen.gauge_at_preload);
  EXPECT_EQ(data.specimen.all.grip_distance, 10);
  EXPECT_EQ(data.cycle->numbers, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(data.cycles_from, "#4");
  EXPECT_EQ(data.branch, data::BranchChoice::loading);
  EXPECT_DOUBLE_EQ(data.preload->value, 100);
  EXPECT_EQ(data.rows.first, -50);
  EXPECT_EQ(data.compression.columns, std::vector<std::string>{"Way"});
  EXPECT_FALSE(data.compression.all);
  EXPECT_EQ(experiment.test("circumferential_strip").weights.size(), 1u) << "a force counts as the stress it gives";
  // What is written as input.json reads back the same.
  const auto again = read(experiment.input_json);
  EXPECT_EQ(again.input_json, experiment.input_json);
}

TEST_F(RigKeys, KeepAStatedSignOfCompression) {
  const std::string with_sizes = std::string(sizes) + ", ";
  for (const char* said : {R"("compression": "negative")", R"("compression": {"Way": "negative"})"}) {
    const auto experiment = read(block(with_sizes + said));
    const auto again = read(experiment.input_json);
    const data::CompressionPositive& compression = again.test("circumferential_strip").data.compression;
    EXPECT_TRUE(compression.said) << said;
    EXPECT_FALSE(compression.all) << said;
    EXPECT_TRUE(compression.columns.empty()) << said;
    EXPECT_EQ(again.input_json, experiment.input_json);
  }
  EXPECT_FALSE(read(read(block(sizes)).input_json).test("circumferential_strip").data.compression.said);
}

TEST_F(RigKeys, RefuseSizesThatCannotBe) {
  EXPECT_EQ(strip(R"("specimen": {"width": 4, "thickness": "-1.2 mm", "gauge_length": 10})"),
            "experiment.json: the thickness is -1.2 mm (/tests/circumferential_strip/data/specimen/thickness, line 22, "
            "column 34). It must be greater than zero. Correct it.");
  expect_within(strip(R"("specimen": {"width": 4, "thickness": 1, "gauge_length": 0})"), "the gauge length is 0 mm");
  expect_within(strip(R"("specimen": {"width": 4, "thickness": 1})"),
                "'displacement' of test 'circumferential_strip' needs the size \"gauge_length\" of the specimen");
  expect_within(strip(R"("order": "loading")"), "needs the size \"gauge_length\"");
  expect_within(strip(R"("specimen": {"width": 4, "gauge_length": 1})"), "needs the size \"thickness\"");
  expect_within(strip(R"("specimen": {"with": 4})"), "Did you mean 'width'?");
  expect_within(strip(R"("specimen": {"area": 4, "width": 2, "gauge_length": 1})"), "the specimen has \"area\", and");
  expect_within(strip(R"("specimen": {"area": 4, "gauge_length": "preload"})"), "there is no \"preload\"");
  expect_within(strip(R"("specimen": {"area": "4 mm", "gauge_length": 1})"), "cannot be converted to 'mm2'");
  for (const char* idle : {R"({})", R"({"width": 4})", R"({"gauge_length": "preload"})"})
    expect_within(
        strip(R"("preload": "0.1 N", "specimen": {"width": 4, "thickness": 1, "gauge_length": 10, "transverse": )" +
              std::string(idle) + "}"),
        "the sizes along 'transverse' change nothing in test 'circumferential_strip'");
}

TEST_F(RigKeys, RefuseWhatTheyDoNotKnow) {
  const std::string with_sizes = std::string(sizes) + ", ";
  const auto refused = [&](const char* key) { return strip(with_sizes + key); };
  expect_within(refused(R"("cycle": "latest")"), "\"last\", \"all\", the number of a cycle from 1, or a list");
  expect_within(refused(R"("cycle": 0)"), "the number of a cycle from 1");
  expect_within(refused(R"("cycle": [])"), "the list of cycles is empty");
  expect_within(refused(R"("cycles_from": "Cycle")"), "no \"cycle\" is chosen");
  expect_within(refused(R"("branch": "upward")"), "unknown branch 'upward'");
  expect_within(refused(R"("delimiter": "|")"), "\"tab\" or \"space\" is expected");
  expect_within(refused(R"("delimiter": ",", "decimal": ",")"), "the comma is the delimiter and the decimal mark");
  expect_within(refused(R"("units": {"Way": "parsec per"})"), "unknown unit 'parsec per'");
  expect_within(refused(R"("compression": "upward")"), "unknown sign of compression 'upward'");
  expect_within(refused(R"("preload": 0)"), "the preload is 0");
  expect_within(refused(R"("preload": "1 kPa")"), "the unit 'kPa' cannot be converted to 'mN'");
  expect_within(refused(R"("where": {"set": []})"), "the list of values is empty");
}

TEST_F(RigKeys, RefuseTwoSourcesOfOneObservable) {
  expect_within(strip(sizes, R"({"displacement": "Way", "length": "Size", "force": "Force"})"),
                "'displacement' and 'length' both give the stretch of test 'circumferential_strip'");
  expect_within(strip(sizes, R"({"force": "Force"})"),
                "no column is mapped to 'stretch', which test 'circumferential_strip' needs");
  expect_within(strip(sizes, R"({"displacment": "Way", "force": "Force"})"), "Did you mean 'displacement'?");
}

}  // namespace
}  // namespace tunica::experiment
