// SPDX-License-Identifier: Apache-2.0
#include "report/folder.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "report/report.hpp"
#include "scratch.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace {

std::string refusal(const std::filesystem::path& path) {
  try {
    report::Folder folder(path);
    return "";
  } catch (const InputError& problem) {
    return problem.what();
  }
}

}  // namespace

TEST(ResultFolder, ThatIsNotThereIsRefusedWithWhatToName) {
  EXPECT_THAT(refusal("/nowhere"), HasSubstr("no such folder; name one that `tunica run`"));
}

TEST(ResultFolder, WithoutResultsIsRefused) {
  const trial::Scratch scratch;
  EXPECT_THAT(refusal(scratch.path()), HasSubstr("holds neither result.json nor a table"));
}

TEST(ResultFolder, WithABrokenResultIsRefused) {
  const trial::Scratch scratch;
  scratch.write("result.json", "{\"name\": ");
  EXPECT_THAT(refusal(scratch.path()), HasSubstr("is not JSON (parse error at line 1, column 10: "));
  scratch.write("result.json", "[1]");
  EXPECT_THAT(refusal(scratch.path()), HasSubstr("expected an object at the top"));
}

TEST(ResultFolder, OfAnotherFormatIsRefused) {
  const trial::Scratch scratch;
  scratch.write("result.json", R"({"format": 2, "runs": []})");
  EXPECT_THAT(refusal(scratch.path()), HasSubstr("\"format\" is 2, and this version of tunica reads 1"));
  scratch.write("result.json", R"({"format": 1, "runs": []})");
  EXPECT_NO_THROW(report::Folder{scratch.path()});
}

TEST(ResultFolder, WithoutAFormatIsRefused) {
  const trial::Scratch scratch;
  scratch.write("result.json", R"({"answer": 42})");
  EXPECT_THAT(refusal(scratch.path()), HasSubstr("has no \"format\""));
}

TEST(ResultFolder, NoFolderAtAllIsRefused) { EXPECT_THROW(report::report({}, "."), InputError); }

TEST(ResultFolder, KnowsWhatWroteIt) {
  const trial::Scratch scratch;
  scratch.write("tube.csv", "pressure [kPa],diameter [1]\n0,1\n");
  EXPECT_EQ(report::Folder(scratch.path()).kind(), report::Folder::Kind::simulation);
  scratch.write("result.json", R"({"format": 1})");
  EXPECT_EQ(report::Folder(scratch.path()).kind(), report::Folder::Kind::run);
  scratch.write("result.json", R"({"format": 1, "diagnosis": {"verdict": "unknown"}})");
  EXPECT_EQ(report::Folder(scratch.path()).kind(), report::Folder::Kind::diagnosis);
}

TEST(ResultFolder, RemembersTablesThatCannotBeRead) {
  const trial::Scratch scratch;
  scratch.write("result.json", R"({"format": 1})");
  scratch.write("good.csv", "# a\nrun,x [kPa]\na,1\nb,text\n");
  scratch.write("broken.csv", "run,x\n\"open,1\n");
  scratch.write("header.csv", "# only\nrun,x\n");
  const report::Folder folder(scratch.path());
  EXPECT_FALSE(folder.table("absent.csv"));
  EXPECT_FALSE(folder.table("header.csv"));
  EXPECT_THAT(folder.problems(), IsEmpty());
  EXPECT_FALSE(folder.table("broken.csv"));
  EXPECT_FALSE(folder.table("broken.csv"));
  EXPECT_THAT(folder.problems(), ElementsAre(HasSubstr("broken.csv")));
  const auto table = folder.table("good.csv");
  ASSERT_TRUE(table);
  EXPECT_EQ(table->number(0, "x"), 1);
  EXPECT_TRUE(std::isnan(table->number(1, "x")));
  EXPECT_TRUE(std::isnan(table->number(0, "y")));
  EXPECT_EQ(table->title(1), "x [kPa]");
  EXPECT_EQ(table->groups("run").size(), 2u);
}
