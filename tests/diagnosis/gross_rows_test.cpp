// SPDX-License-Identifier: Apache-2.0
// Single rows that are wrong. Every seed is fixed; where a verdict could be missed by bad luck, it says how likely that
// was.
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>

#include "diagnosis/measured.hpp"
#include "diagnosis/output/outputs.hpp"

namespace tunica::trial {
namespace {

using diagnosis::Diagnosis;
using diagnosis::Verdict;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

// Ten standard deviations in row 14.
TEST(GrossRows, AWrongRowIsSuspectData) {
  const Measured measured;
  measured.measure(34, {}, [](const Strip& strip, double stretch) {
    return strip.name == "axial" && std::abs(stretch - 1.3) < 0.01 ? 3.0 : 0;
  });
  const Diagnosis found = measured.diagnose();
  ASSERT_EQ(found.explanation.verdict, Verdict::suspect_data);
  EXPECT_EQ(found.explanation.claim.causes[0].id, "outliers");
  EXPECT_EQ(found.explanation.claim.causes[0].place.row, 14u);
  EXPECT_EQ(found.explanation.claim.causes[0].place.tests, std::vector<std::string>{"axial"});
  const json written = diagnosis::diagnosis_json(found);
  EXPECT_EQ(written["causes"][0]["id"], "outliers");
  EXPECT_EQ(written["causes"][0]["target"]["row"], 14);
  EXPECT_EQ(written["causes"][0]["target"]["channel"], "stress");
  EXPECT_THAT(diagnosis::summary(found).plain(), AllOf(HasSubstr("SUSPECT DATA"), HasSubstr("row 14")));
}

// Only causes that a single row is none of are asked for; the row is said all the same, and nothing is named for it.
TEST(GrossRows, AWrongRowIsSuspectDataWhereOutliersAreNotAskedFor) {
  Measured measured;
  measured.experiment["diagnosis"]["mechanisms"] = {"force_offset", "axial_fibres"};
  measured.measure(34, {}, [](const Strip& strip, double stretch) {
    return strip.name == "axial" && std::abs(stretch - 1.3) < 0.01 ? 4.0 : 0;
  });
  const Diagnosis found = measured.diagnose();
  ASSERT_EQ(found.explanation.verdict, Verdict::suspect_data);
  EXPECT_THAT(found.explanation.reasons.front().text, HasSubstr("nothing is wrong but row 14"));
  EXPECT_TRUE(found.explanation.claim.causes.empty());
  EXPECT_FALSE(found.explanation.claim.best);
}

// Twenty standard deviations of a noise that is estimated: without that row, which would make it four times as large.
// Seed 37: four standard deviations of σ, 6e-5.
TEST(GrossRows, AWrongRowIsNoNoise) {
  Measured measured;
  measured.measure(
      37, [](json& truth) { truth["models"]["gho"]["mechanisms"] = {mechanism("axial_fibres", "k", 0.1)}; },
      [](const Strip& strip, double stretch) {
        return strip.name == "circumferential" && std::abs(stretch - 1.3) < 0.01 ? 6.0 : 0;
      });
  for (auto& test : measured.experiment["tests"]) test["data"].erase("noise");
  const Diagnosis found = measured.diagnose();
  ASSERT_EQ(found.analysis.evidence.gross.size(), 1u);
  EXPECT_EQ(found.analysis.evidence.gross.front().row, 14u);
  EXPECT_THAT(found.analysis.evidence.gross.front().where, HasSubstr("measured "));
  for (const auto& source : found.analysis.evidence.noise)
    EXPECT_NEAR(source.noise.absolute, 0.3, 4 * 0.3 / std::sqrt(2 * source.freedom)) << source.test;
  // In the table it is as far off as it is.
  diagnosis::write_tables(measured.folder.path(), found);
  std::istringstream table(text_of(measured.folder.path() / "residuals.csv"));
  for (std::string line; std::getline(table, line);)
    if (line.starts_with("circumferential,stress,14,")) {
      std::vector<std::string> cells;
      std::istringstream cut(line);
      for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
      EXPECT_GT(std::stod(cells[12]), 10) << line;
      return;
    }
  FAIL() << "no such row";
}

// Axial fibres, and twenty standard deviations in row 14: both are said, and the extension has both.
TEST(GrossRows, AWrongRowBesideACauseIsNamedWithIt) {
  const Measured measured;
  measured.measure(
      35, [](json& truth) { truth["models"]["gho"]["mechanisms"] = {mechanism("axial_fibres", "k", 0.03)}; },
      [](const Strip& strip, double stretch) {
        return strip.name == "circumferential" && std::abs(stretch - 1.3) < 0.01 ? 6.0 : 0;
      });
  const Diagnosis found = measured.diagnose();
  ASSERT_EQ(found.explanation.verdict, Verdict::named);
  ASSERT_EQ(found.explanation.left_out.size(), 1u);
  const auto& row = found.explanation.left_out.front();
  EXPECT_EQ(row.place.row, 14u);
  // The noise of the row itself, and an interval of 95 % twice: false alarm 1e-4.
  EXPECT_NEAR(row.amplitude.value, 6, row.amplitude.high - row.amplitude.low);
  EXPECT_NEAR(row.amplitude.high - row.amplitude.low, 2 * 1.96 * 0.3, 1e-3);
  const json written = diagnosis::diagnosis_json(found);
  ASSERT_EQ(written["causes"].size(), 2u);
  EXPECT_EQ(written["causes"][0]["id"], "axial_fibres");
  EXPECT_EQ(written["causes"][1]["id"], "outliers");
  EXPECT_EQ(written["extension"]["mechanisms"][1]["target"]["row"], 14);
  EXPECT_THAT(diagnosis::extended_experiment(found, testing::catalogue()),
              AllOf(HasSubstr("axial_fibres"), HasSubstr("\"14:15:1\"")));
  EXPECT_THAT(
      in_one_line(diagnosis::summary(found).plain()),
      HasSubstr(
          "NAMED: consistent with axial_fibres and outliers in the channel 'stress' of the test 'circumferential', "
          "row 14"));
}

// What the extension does not take out is left to explain: 40 standard deviations in all.
TEST(GrossRows, OfTwoWrongRowsTheOneThatIsNotInTheExtensionIsTold) {
  const Measured measured;
  measured.measure(41, {}, [](const Strip& strip, double stretch) {
    const bool first = std::abs(stretch - 1.2) < 0.01, second = std::abs(stretch - 1.46) < 0.01;
    return strip.name == "axial" && (first || second) ? first ? 6.0 : -5.0 : 0;
  });
  const Diagnosis found = measured.diagnose();
  ASSERT_EQ(found.explanation.verdict, Verdict::suspect_data);
  ASSERT_TRUE(found.explanation.claim.best);
  EXPECT_EQ(found.explanation.claim.best->additions.size(), 1u);
  EXPECT_LT(found.explanation.p_after, 1e-4);
  EXPECT_THAT(warning_texts(found), Contains(AllOf(HasSubstr("extended.json takes out one gross row of a test"),
                                                   HasSubstr("of axial, stress. Remove them from the data file"))));
}

}  // namespace
}  // namespace tunica::trial
