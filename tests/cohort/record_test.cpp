// SPDX-License-Identifier: Apache-2.0
#include "cohort/record.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "execution/damage.hpp"

namespace tunica::cohort {
namespace {

Record full_record() {
  Record record;
  record.id = "PA \"1\"";
  record.inputs = "abc";
  record.outcome = Outcome::no_result;
  record.reason = "why";
  record.warnings = {{"at_bound", "mu lies at its bound"}};
  Record::Run run;
  run.label = "gho/lm";
  run.model = "gho";
  run.has_result = true;
  run.objective = 0.1 + 0.2;
  run.parameters = {
      {"mu", "kPa", Scale::log, M_PI, 1e-300, 1e300, std::nextafter(1.0, 2.0), std::nullopt, "upper", true}};
  run.quality = {{"strip", "stress", "kPa", true, std::nullopt, 1.0 / 3, 0.1 + 0.2}};
  run.stable = false;
  run.misfit = 5e-324;
  run.evaluations = 1ULL << 60U;
  record.runs = {run};
  record.seconds = 0.1;
  return record;
}

TEST(CohortRecord, ReadsBackBitForBit) {
  const Record record = full_record();
  const std::string text = to_json(record);
  const auto again = record_of(text);
  ASSERT_TRUE(again);
  EXPECT_EQ(to_json(*again), text);
  const Record::Parameter& parameter = again->runs.at(0).parameters.at(0);
  EXPECT_EQ(parameter.value, M_PI);
  EXPECT_EQ(parameter.lower, std::nextafter(1.0, 2.0));
  EXPECT_EQ(parameter.upper, std::nullopt);
  EXPECT_EQ(again->runs[0].misfit, 5e-324);
  EXPECT_EQ(again->runs[0].evaluations, 1ULL << 60U);
  EXPECT_EQ(again->outcome, Outcome::no_result);
}

TEST(CohortRecord, ThatWasCutOffIsNone) {
  const std::string text = to_json(full_record());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7)
    EXPECT_FALSE(record_of(text.substr(0, length))) << "first " << length << " bytes";
}

// The last digits of a number may be others of the same double.
TEST(CohortRecord, WithAChangedDigitIsNoneOrTheSame) {
  const std::string text = to_json(full_record());
  std::size_t same = 0;
  for (std::size_t place = 0; place + 1 < text.size(); ++place) {
    const auto record = record_of(trial::changed(text, place));
    if (record && to_json(*record) == text)
      ++same;
    else
      EXPECT_FALSE(record) << trial::changed(text, place);
  }
  EXPECT_LT(same, text.size() / 100);
}

TEST(CohortRecord, OfAnotherFormatIsNone) {
  std::string text = to_json(full_record());
  text.replace(text.find("\"format\": 2"), 11, "\"format\": 1");
  EXPECT_FALSE(record_of(text));
  EXPECT_FALSE(record_of("[1, 2]"));
}

}  // namespace
}  // namespace tunica::cohort
