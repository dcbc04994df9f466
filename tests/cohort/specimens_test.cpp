// SPDX-License-Identifier: Apache-2.0
#include "cohort/specimens.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cohort/files.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {
namespace {

using testing::CohortFiles;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

SpecimenTable table_of(const std::string& text) {
  CohortFiles files;
  files.table = text;
  return read_specimens(files.read());
}

TEST(Specimens, AreTheRowsOfTheTable) {
  const SpecimenTable table = table_of(testing::table_text);
  ASSERT_EQ(table.specimens.size(), 3U);
  EXPECT_EQ(table.specimens[1].id, "b");
  EXPECT_EQ(table.specimens[1].line, 3U);
  ASSERT_EQ(table.factors.size(), 1U);
  EXPECT_THAT(table.factors[0].levels, ElementsAre("control", "treated"));
  EXPECT_THAT(table.factors[0].of, ElementsAre(0U, 1U, 0U));
}

TEST(Specimens, CalledLikeUnitsAreSpecimens) {
  const SpecimenTable table = table_of("id,treatment,width [mm]\ns,K,\nm,Pa,\nN,K,5\n");
  ASSERT_EQ(table.specimens.size(), 3U);
  EXPECT_EQ(table.specimens[0].id, "s");
  EXPECT_EQ(table.specimens[0].line, 2U);
}

TEST(Specimens, FoldersHaveRoomForAFileName) {
  const std::string longest(300, 'x');
  const SpecimenTable table =
      table_of("id,treatment,width [mm]\n" + longest + "a,control,5\n" + longest + "b,treated,5\nc,control,5\n");
  ASSERT_EQ(table.specimens.size(), 3U);
  EXPECT_NE(table.specimens[0].folder, table.specimens[1].folder);
  for (const Specimen& specimen : table.specimens) EXPECT_LT(specimen.folder.size(), 120U);
  EXPECT_EQ(table.specimens[2].folder, "c");
}

TEST(Specimens, BeginUnderTheFirstLine) {
  const SpecimenTable table = table_of("id,treatment,width\na,x,unknown\nb,y,2\nc,x,3\nd,y,4\n");
  EXPECT_EQ(table.specimens.size(), 4U);
}

TEST(Specimens, MayHaveARowOfUnitsThatNamesNobody) {
  const SpecimenTable table = table_of("id,treatment,width\n,,mm\na,control,5\nb,treated,6\n");
  ASSERT_EQ(table.specimens.size(), 2U);
  EXPECT_EQ(table.columns[2].unit, "mm");
}

TEST(Specimens, WithOneIdTwiceAreBothRefusedAndTheOthersGoOn) {
  const SpecimenTable table = table_of("id,treatment,width [mm]\na,control,5\nb,treated,6\na,treated,7\n");
  EXPECT_THAT(table.specimens[0].problem, HasSubstr("the id 'a' stands in lines 2 and 4"));
  EXPECT_THAT(table.specimens[2].problem, HasSubstr("the id 'a' stands in lines 2 and 4"));
  EXPECT_EQ(table.specimens[1].problem, "");
}

TEST(Specimens, WithoutAValueOfAFactorAreRefusedAlone) {
  const SpecimenTable table = table_of("id,treatment,width [mm]\na,control,5\nb,,6\nc,treated,7\n");
  EXPECT_THAT(table.specimens[1].problem, HasSubstr("line 3: the factor 'treatment' has no value"));
  EXPECT_EQ(table.specimens[0].problem, "");
  EXPECT_THAT(table.factors[0].levels, ElementsAre("control", "treated"));
}

TEST(Specimens, OfOneLevelAreNotComparedByIt) {
  const SpecimenTable table = table_of("id,treatment,width [mm]\na,control,5\nb,control,6\n");
  EXPECT_THAT(table.factors[0].refusal, HasSubstr("has one level, 'control'"));
}

TEST(Specimens, WithIdsThatAreNoFileNamesGetFoldersThatDiffer) {
  const SpecimenTable table = table_of("id,treatment,width [mm]\na/1,control,5\na:1,treated,6\n..,treated,6\n");
  EXPECT_NE(table.specimens[0].folder, table.specimens[1].folder);
  for (const Specimen& specimen : table.specimens) {
    EXPECT_EQ(specimen.folder.find_first_of("/:"), std::string::npos);
    EXPECT_NE(specimen.folder.front(), '.');
  }
}

TEST(Specimens, CompareWithTheReferenceThatIsNamed) {
  CohortFiles files;
  files.replace(files.cohort, "[\"treatment\"]", R"({"treatment": {"reference": "treated"}})");
  EXPECT_THAT(read_specimens(files.read()).factors[0].levels, ElementsAre("treated", "control"));
  CohortFiles wrong;
  wrong.replace(wrong.cohort, "[\"treatment\"]", R"({"treatment": {"reference": "treatd"}})");
  EXPECT_THAT(testing::message_of<InputError>([&] { read_specimens(wrong.read()); }),
              HasSubstr("Did you mean 'treated'?"));
}

TEST(Specimens, AreThoseThatMatchWhere) {
  CohortFiles files;
  files.replace(files.cohort, "\"specimens.csv\"", R"({"file": "specimens.csv", "where": {"id": ["a", "c"]}})");
  EXPECT_EQ(read_specimens(files.read()).specimens.size(), 2U);
  CohortFiles none;
  none.replace(none.cohort, "\"specimens.csv\"", R"({"file": "specimens.csv", "where": {"id": "x"}})");
  EXPECT_THAT(testing::message_of<InputError>([&] { read_specimens(none.read()); }),
              HasSubstr("no row is left of the 3"));
}

}  // namespace
}  // namespace tunica::cohort
