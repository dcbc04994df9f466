// SPDX-License-Identifier: Apache-2.0
#include "experiment/limits.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include "experiment/json_document.hpp"
#include "experiment/reading.hpp"

namespace tunica::experiment {
namespace {

using testing::expect_within;
struct Limits : testing::Reading {};

TEST_F(Limits, HoldForEverythingThatIsCounted) {
  expect_within(refusal(R"("realisations": 100)", R"("realisations": 1000000000)"),
                "found the number 1000000000 where a whole number of realisations from 1 to 100000 is expected");
  expect_within(refusal(R"("h": 0.7)", R"("h": 0.7, "points": 1000000000000)"),
                "where a whole number of stretches from 2 to 10000 is expected");
  expect_within(refusal(R"("seed": 7)", R"("seed": 7, "analysis": {"bootstrap": {"draws": 1e9}})"),
                "where a whole number of draws from 40 to 1000000 is expected");
  expect_within(refusal(R"("seed": 7)", R"("seed": 7, "analysis": {"stability": {"points": 1002}})"),
                "where a whole number of points along each parameter from 2 to 1001 is expected");
  expect_within(refusal(R"("stall": 500)", R"("stall": 1e13)"),
                "where a whole number of evaluations from 1 to 1000000000000 is expected");
  expect_within(refusal(R"("rows": "0:240:6")", R"("resample": 100001)"), "a number of points from 5 to 100000");
  expect_within(refusal(R"("rows": "0:240:6")", R"("skip_lines": 1e12)"), "a number of lines from 0 to 1000000000");
  EXPECT_EQ(read(with(R"("realisations": 100)", R"("realisations": 100000)")).runs[0].realisations, 100000u);
}

TEST_F(Limits, HoldForAllRunsTogether) {
  std::string runs;
  for (int run = 0; run < 11; ++run) runs += R"({"model": "gho", "optimizer": "es", "realisations": 100000}, )";
  expect_within(refusal(R"("runs": [)", R"("runs": [)" + runs),
                "with this run there are 1100000 realisations, and an experiment has at most 1000000 (/runs/10");
}

TEST_F(Limits, HoldForListsKeysAndTheFile) {
  std::string runs;
  for (std::size_t run = 0; run < limits::entries; ++run) runs += R"({"model": "gho", "optimizer": "es"}, )";
  expect_within(refusal(R"("runs": [)", R"("runs": [)" + runs), "entries, and at most 10000 are allowed (/runs");
  const std::string key = refusal(R"("seed": 7)", fmt::format(R"("{}": 7)", std::string(1'000'000, 'k')));
  expect_within(key, "has 1000000 bytes, and at most 1000 are allowed");
  EXPECT_LT(key.size(), 300u);
  expect_within(refusal(std::string(limits::file_bytes + 1, ' ')), "the file has 17 MiB; expected at most 16");
  EXPECT_THROW(JsonDocument("made.json", std::string(limits::file_bytes + 1, ' ')), InputError);
}

// Otherwise editors would accept what the reader refuses.
TEST_F(Limits, StandInTheSchema) {
  const std::string schema = compose_schema(testing::fake_catalogue());
  for (const std::uint64_t most : {limits::realisations, limits::stability_points, limits::draws, limits::map_points,
                                   limits::evaluations, limits::resampled, limits::lines})
    expect_within(schema, fmt::format("\"maximum\": {}", most));
  expect_within(schema, fmt::format("\"maxItems\": {}", limits::entries));
  expect_within(schema, fmt::format("\"maxProperties\": {}", limits::entries));
}

TEST_F(Limits, NamesHaveNoMarksThatTurnText) {
  expect_within(refusal(R"("gho": {)", "\"gh\u202Eo\": {"), "the model name 'gh\\u202eo' cannot be part of file");
  expect_within(refusal(R"("gho": {)", R"("gh\u009bo": {)"), "the model name 'gh\\u009bo' cannot be part of file");
}

TEST_F(Limits, ASpecialFileIsNoData) {
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  expect_within(refusal(R"("file": "circ.csv")", R"("file": "pipe")"),
                "the data file 'pipe' is no regular file (/tests/circumferential_strip/data/file");
  expect_within(refusal(R"("file": "circ.csv")", R"("file": ".")"), "the data file '.' is a folder");
}

TEST_F(Limits, FoldersHaveNamesThatJsonCanHold) {
  const auto inside = folder.path() / "d\xFF";
  std::filesystem::create_directory(inside);
  std::filesystem::copy(folder.write("experiment.json", testing::design_example), inside / "experiment.json");
  const std::string message = testing::message_of<InputError>(
      [&] { static_cast<void>(read_experiment(inside / "experiment.json", testing::fake_catalogue())); });
  expect_within(message, "the name of the file, or of a folder above it, is not UTF-8");
}

TEST_F(Limits, TheNoiseIsFinite) {
  expect_within(refusal(R"({"relative": 0.02})", R"({"absolute": "1e308 GPa"})"), "the number is too large");
}

}  // namespace
}  // namespace tunica::experiment
