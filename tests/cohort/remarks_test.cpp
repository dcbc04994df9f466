// SPDX-License-Identifier: Apache-2.0
#include "cohort/remarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tunica::cohort {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// So many fitted specimens "0", "1", … with one parameter each.
Collection collection(const std::vector<double>& values) {
  Collection found;
  for (std::size_t k = 0; k < values.size(); ++k) {
    Record record;
    record.id = std::to_string(k);
    record.data = "data of " + record.id;
    record.outcome = Outcome::fitted;
    Record::Run run;
    run.label = "gho/lm";
    run.parameters = {{"mu", "kPa", Scale::log, values[k], 0.1, 1e6, {}, {}, "", true}};
    record.runs = {run};
    found.records.push_back(record);
  }
  return found;
}

std::vector<Remark> remarks(const Collection& found) { return remarks_of(SpecimenTable{}, found); }

TEST(CohortRemarks, AreNoneOfACleanCohort) { EXPECT_TRUE(remarks(collection({1, 2, 3, 4})).empty()); }

TEST(CohortRemarks, NameASpecimenWhoseUnitIsProbablyWrong) {
  const auto found = remarks(collection({20, 25, 18, 22, 21e3}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, RemarkKind::far_off);
  EXPECT_THAT(found[0].specimens, ElementsAre("4"));
  EXPECT_THAT(found[0].sentence, HasSubstr("mu is 2.1e+04 kPa, the median of the cohort 22"));
}

TEST(CohortRemarks, NameASpecimenWhoseCurvesAreAThousandTimesTooHigh) {
  auto found = collection({20, 25, 18, 22});
  for (std::size_t k = 0; k < 4; ++k)
    found.records[k].runs[0].quality = {
        {"strip", "stress", "kPa", false, 0.99, 1, k == 2 ? 31e3 : 30 + 9.0 * static_cast<double>(k)}};
  const auto said = remarks(found);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].kind, RemarkKind::far_off);
  EXPECT_THAT(said[0].specimens, ElementsAre("2"));
  EXPECT_THAT(said[0].sentence, HasSubstr("stress of 'strip' reaches 3.1e+04 kPa"));
}

TEST(CohortRemarks, KeepStillAboutParametersThatTheDataDoNotFix) {
  auto found = collection({20, 25, 18, 22, 21e3});
  found.records[4].runs[0].parameters[0].identified = false;
  EXPECT_TRUE(remarks(found).empty());
}

TEST(CohortRemarks, FindDataThatWereEnteredTwice) {
  auto found = collection({1, 2, 3, 4});
  found.records[3].data = found.records[1].data;
  const auto said = remarks(found);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].kind, RemarkKind::same_data);
  EXPECT_THAT(said[0].specimens, ElementsAre("1", "3"));
}

TEST(CohortRemarks, CountWhatWasNotFitted) {
  auto found = collection({1, 2, 3, 4, 5});
  found.records[2].outcome = Outcome::unreadable;
  found.records[2].runs.clear();
  const auto said = remarks(found);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].kind, RemarkKind::not_fitted);
  EXPECT_THAT(said[0].sentence, HasSubstr("1 of 5 specimens was not fitted"));
}

TEST(CohortRemarks, SayThatTwoSpecimensAreFew) {
  const auto said = remarks(collection({1, 2}));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].kind, RemarkKind::few_specimens);
}

TEST(CohortRemarks, SayWhereAFifthLiesAtABound) {
  auto found = collection({1, 2, 3, 4, 5});
  EXPECT_TRUE(remarks(found).empty());
  found.records[2].runs[0].parameters[0].at_bound = "lower";
  EXPECT_EQ(remarks(found).at(0).kind, RemarkKind::often_at_bound);
}

}  // namespace
}  // namespace tunica::cohort
