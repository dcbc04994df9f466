// SPDX-License-Identifier: Apache-2.0
#include "cohort/specification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cohort/files.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {
namespace {

using testing::CohortFiles;
using ::testing::HasSubstr;

std::string refusal(const std::string& from, const std::string& to) {
  CohortFiles files;
  files.replace(files.cohort, from, to);
  return testing::message_of<InputError>([&] { (void)files.read(); });
}

TEST(CohortFile, IsReadWithItsDefaults) {
  CohortFiles files;
  const Specification cohort = files.read();
  EXPECT_EQ(cohort.name, "cohort");
  EXPECT_EQ(cohort.experiment, files.folder.path() / "strip.json");
  EXPECT_EQ(cohort.table, files.folder.path() / "specimens.csv");
  ASSERT_EQ(cohort.bindings.size(), 2U);
  EXPECT_EQ(cohort.bindings[0].pointer, "/tests/strip/data/file");
  ASSERT_EQ(cohort.factors.size(), 1U);
  EXPECT_EQ(cohort.factors[0].column, "treatment");
  EXPECT_EQ(cohort.spread, SpreadStructure::automatic);
}

TEST(CohortFile, RefusesAnExperimentInItsPlace) {
  CohortFiles files;
  files.cohort = R"({ "format": 1, "models": {}, "tests": {} })";
  EXPECT_THAT(testing::message_of<InputError>([&] { (void)files.read(); }), HasSubstr("this is an experiment"));
}

TEST(CohortFile, NamesTheNearestKey) { EXPECT_THAT(refusal("\"factors\"", "\"factor\""), HasSubstr("factors")); }

TEST(CohortFile, RefusesACohortInWhichNothingIsBound) {
  CohortFiles files;
  files.cohort = R"({ "format": 1, "experiment": "strip.json", "specimens": "specimens.csv", "bind": {} })";
  EXPECT_THAT(testing::message_of<InputError>([&] { (void)files.read(); }), HasSubstr("nothing is bound"));
}

TEST(CohortFile, WantsExactlyOneKindOfReading) {
  const std::string begin = R"("readings": {"r": {"test": "strip", "channel": "stress")";
  EXPECT_THAT(refusal("\"factors\": [\"treatment\"]", begin + "}}"),
              HasSubstr("has 0 of the keys at, slope, integral"));
  EXPECT_THAT(refusal("\"factors\": [\"treatment\"]", begin + R"(, "at": 1, "slope": [1, 2]}})"),
              HasSubstr("has 2 of the keys"));
  EXPECT_THAT(refusal("\"factors\": [\"treatment\"]", begin + R"(, "slope": [1]}})"), HasSubstr("from and to"));
}

TEST(CohortFile, RefusesTooFewPermutations) {
  EXPECT_THAT(refusal("\"factors\": [\"treatment\"]", R"("population": {"permutations": 5})"), HasSubstr("from 99"));
}

}  // namespace
}  // namespace tunica::cohort
