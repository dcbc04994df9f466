// SPDX-License-Identifier: Apache-2.0
#include "cohort/template.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cohort/files.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {
namespace {

using testing::CohortFiles;
using ::testing::HasSubstr;

std::string bound(const CohortFiles& files, std::size_t specimen) {
  const Specification cohort = files.read();
  const SpecimenTable table = read_specimens(cohort);
  return Template(cohort, table).of(table.specimens.at(specimen));
}

std::string refusal(const CohortFiles& files) {
  return testing::message_of<InputError>([&] { bound(files, 0); });
}

TEST(Template, ReplacesOnlyTheValuesOfItsPointers) {
  const std::string text = bound({}, 1);
  std::string expected = testing::template_text;
  expected.replace(expected.find("\"width\": 5"), 10, "\"width\": \"6 mm\"");
  expected.replace(expected.find("\"a.csv\""), 7, "\"b.csv\"");
  EXPECT_EQ(text, expected) << "lines, comments and order stay, so that messages name the lines of the template";
}

// Found by the fuzz target.
TEST(Template, RefusesATableThatIsNotUtf8) {
  CohortFiles files;
  files.replace(files.table, "width [mm]", "width [m\x8A]");
  EXPECT_THAT(refusal(files), HasSubstr("specimens.csv, line 1, column 3: found 'width [m\\x8a]'"));
  EXPECT_THAT(refusal(files), HasSubstr("is not UTF-8. Save the file as UTF-8 text."));
}

TEST(Template, PutsANumberWhereTheTemplateHasOneAndTheTableNoUnit) {
  CohortFiles files;
  files.replace(files.table, "width [mm]", "width");
  EXPECT_THAT(bound(files, 2), HasSubstr("\"width\": 7,"));
}

TEST(Template, EscapesCells) {
  CohortFiles files;
  files.replace(files.table, "c,control", "\"c\"\"\\\",control");
  const auto json = nlohmann::json::parse(bound(files, 2), nullptr, true, true);
  EXPECT_EQ(json["tests"]["strip"]["data"]["file"], "c\"\\.csv");
}

TEST(Template, RefusesAPointerThatLeadsNowhere) {
  CohortFiles files;
  files.replace(files.cohort, "/tests/strip/width", "/tests/strip/wdth");
  const std::string message = refusal(files);
  EXPECT_THAT(message, HasSubstr("no value at '/tests/strip/wdth'"));
  EXPECT_THAT(message, HasSubstr("'/tests/strip' holds: type, width, data"));
}

TEST(Template, RefusesToReplaceAnObject) {
  CohortFiles files;
  files.replace(files.cohort, "/tests/strip/width", "/tests/strip/data");
  EXPECT_THAT(refusal(files), HasSubstr("'/tests/strip/data' is an object"));
}

TEST(Template, RefusesWhatIsNoPointer) {
  CohortFiles files;
  files.replace(files.cohort, "/tests/strip/width", "tests.strip.width");
  EXPECT_THAT(refusal(files), HasSubstr("is no JSON pointer"));
}

TEST(Template, NamesTheNearestColumn) {
  CohortFiles files;
  files.replace(files.cohort, "{width}", "{with}");
  EXPECT_THAT(refusal(files), HasSubstr("Did you mean 'width'?"));
  CohortFiles open;
  open.replace(open.cohort, "{width}", "{width");
  EXPECT_THAT(refusal(open), HasSubstr("a brace opens and does not close"));
}

TEST(Template, RefusesAnEmptyCell) {
  CohortFiles files;
  files.replace(files.table, "a,control,5", "a,control,");
  EXPECT_THAT(refusal(files), HasSubstr("line 2: the column 'width' is empty"));
}

}  // namespace
}  // namespace tunica::cohort
