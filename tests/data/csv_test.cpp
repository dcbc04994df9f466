// SPDX-License-Identifier: Apache-2.0
#include "data/csv.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "data/dataset.hpp"
#include "data/sha256.hpp"
#include "data/strip.hpp"
#include "data/written_file.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

using testing::read_strip;
using testing::strip_refusal;

TEST(Csv, ReadsHeaderUnitsCommentsAndNumbers) {
  const Dataset strip =
      read_strip("# a strip\n\nstretch [-],stress [MPa],note\n1,0,a\n# pause\n1.1,2.5e-3,\"b, c\"\n+1.2,0.005,\n");
  ASSERT_EQ(strip.count, 3u);
  EXPECT_EQ(strip.abscissae[0].second, (std::vector<double>{1, 1.1, 1.2}));
  EXPECT_EQ(strip.channels[0].values, (std::vector<double>{0, 2.5, 5}));
  EXPECT_EQ(strip.channels[0].unit, "kPa");
  EXPECT_EQ(strip.lines, (std::vector<std::size_t>{4, 6, 7}));
  EXPECT_EQ(strip.source_columns[1].second, (std::pair<std::string, std::string>{"stress", "MPa"}));
  EXPECT_TRUE(strip.warnings.empty());
  EXPECT_EQ(strip.rows().count, 3u);
  EXPECT_EQ(strip.rows().channels, std::vector<std::string>{"stress"});
  EXPECT_EQ(strip.rows().abscissae[0].values[2], 1.2);
}

TEST(Csv, SniffsTheDelimiter) {
  const std::vector<double> stress = {0, 2.5, 5};
  for (const std::string_view text :
       {"stretch [-],stress [kPa]\n1,0\n1.1,2.5\n1.2,5\n", "stretch [-];stress [kPa]\n1;0\n1.1;2.5\n1.2;5\n",
        "stretch [-]\tstress [kPa]\n1\t0\n1.1\t2.5\n1.2\t5\n",
        "  stretch [-]   stress [kPa]\n 1  0\n  1.1 2.5 \n1.2\t5\n", "stretch stress [kPa]\n1 0\n1.1 2.5\n1.2 5\n",
        "stretch [-] , stress [kPa] ,\n1, 0,\n1.1 ,2.5,\n1.2,5,\n"})
    EXPECT_EQ(read_strip(text).channels[0].values, stress) << text;
}

TEST(Csv, ReadsDecimalCommasWhereTheDelimiterAllowsThem) {
  const Dataset strip = read_strip("stretch [-];stress [kPa];date\n1,0;0;1.2.2020\n1,1;2,5;1.2.2020\n");
  EXPECT_EQ(strip.abscissae[0].second, (std::vector<double>{1, 1.1}));
  EXPECT_EQ(strip.channels[0].values, (std::vector<double>{0, 2.5}));
}

TEST(Csv, AcceptsByteOrderMarkAndAnyLineEnd) {
  EXPECT_EQ(read_strip("\xEF\xBB\xBFstretch,stress [kPa]\r\n1,0\r\n1.1,2.5\r\n").channels[0].values,
            (std::vector<double>{0, 2.5}));
  EXPECT_EQ(read_strip("stretch,stress [kPa]\r1,0\r1.1,2.5\r").lines, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(read_strip("stretch,stress [kPa]\n1,0\n1.1,2.5").count, 2u) << "no line end after the last row";
}

TEST(Csv, ReadsQuotedFields) {
  const Dataset strip =
      read_strip("\"stretch\",\"stress [kPa]\",\"a \"\"note\"\", quoted\"\n\"1\",\"0\",\"two\nlines\"\n1.1,2.5,x\n");
  EXPECT_EQ(strip.count, 2u);
  EXPECT_EQ(strip.lines, (std::vector<std::size_t>{2, 4}));
}

// Found by the fuzz target: in a file delimited by white space an empty quoted cell is none.
TEST(Csv, RefusesAHeaderWithoutCells) {
  TableLayout layout;
  layout.row_names = "";
  const std::string message =
      testing::message_of<InputError>([&] { parse_csv("strip.csv", "\"\"\n ,tam\n!,4,,6id\t2,65,6#\n", layout); });
  EXPECT_NE(message.find("strip.csv, line 1"), std::string::npos) << message;
  EXPECT_NE(message.find("where the header is expected"), std::string::npos) << message;
}

TEST(Csv, FindsAColumnByItsNameOrItsWholeHeader) {
  EXPECT_EQ(read_strip("lambda 1 [-],sigma (true),stress [Pa]\n1,0,7\n1.1,1,8\n",
                       {{"stretch", "lambda 1"}, {"stress", "stress [Pa]"}})
                .channels[0]
                .values[0],
            0.007);
}

TEST(Csv, ParsesMappedColumnsAndSelectedRowsOnly) {
  DataRequest request;
  request.rows = {1, 3, 1};
  const Dataset strip =
      read_strip("stretch,stress [kPa],remark\nstart,none,x\n1,0,y\n1.1,2.5,z\nend,none,x\n", {}, request);
  EXPECT_EQ(strip.channels[0].values, (std::vector<double>{0, 2.5}));
}

TEST(Csv, TakesEveryNthRowOfThoseThatMatch) {
  DataRequest request;
  request.where = {{"specimen", "7"}, {"side", "left"}};
  request.rows = {0, 4, 2};
  const Dataset strip = read_strip(
      "specimen,side,stretch,stress "
      "[kPa]\n7,left,1,0\n8,left,1,9\n7.0,left,1.1,1\n7,right,1,9\n7,left,1.2,2\n7,left,1.3,3\n",
      {}, request);
  EXPECT_EQ(strip.channels[0].values, (std::vector<double>{0, 2}));
  EXPECT_EQ(strip.lines, (std::vector<std::size_t>{2, 6}));
}

TEST(Csv, MakesTimeFromARateAlongTheWholePath) {
  DataRequest request;
  request.time_rate = 0.1;
  request.rows = {0, {}, 2};
  const Dataset strip = read_strip("stretch,stress [kPa]\n1.1,1\n1.3,3\n1.1,1.5\n1.0,0.1\n1.2,2\n", {}, request);
  ASSERT_EQ(strip.time.size(), 3u);
  EXPECT_NEAR(strip.time[0], 1, 1e-12);  // from rest, stretch 1
  EXPECT_NEAR(strip.time[1], 5, 1e-12);  // up to 1.3 and back: the turning point is not skipped
  EXPECT_NEAR(strip.time[2], 8, 1e-12);
}

TEST(Csv, KeepsTheHashOfTheFile) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-4
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const std::string text = "stretch,stress [kPa]\n1,0\n";
  EXPECT_EQ(read_strip(text).sha256, std::vector{sha256(text)});
}

TEST(Csv, NamesLineAndColumnOfATextCell) {
  EXPECT_EQ(strip_refusal("# c\nstretch,stress [kPa]\n1,0\n1.1,n/a\n"),
            "strip.csv, line 4, column 2 ('stress'): found 'n/a' where a number is expected. Correct the cell, or "
            "leave the row out "
            "with \"rows\" or \"where\".");
  EXPECT_NE(strip_refusal("stretch,stress [kPa]\n1,12 kPa\n").find("line 2, column 2 ('stress'): found '12 kPa'"),
            std::string::npos);
}

TEST(Csv, NamesLineAndColumnOfAnEmptyCell) {
  EXPECT_NE(strip_refusal("stretch,stress [kPa]\n1,0\n1.1,\n")
                .find("strip.csv, line 3, column 2 ('stress'): found an empty cell"),
            std::string::npos);
  EXPECT_NE(strip_refusal("stretch,stress [kPa]\n1,0\n1.1\n").find("line 3, column 2 ('stress'): found an empty cell"),
            std::string::npos);
}

TEST(Csv, RefusesNumbersThatAreNotFinite) {
  for (const std::string cell : {"nan", "NaN", "inf", "-inf", "1e999"})
    EXPECT_NE(strip_refusal("stretch,stress [kPa]\n1," + cell + "\n")
                  .find("line 2, column 2 ('stress'): found '" + cell + "'"),
              std::string::npos)
        << strip_refusal("stretch,stress [kPa]\n1," + cell + "\n");
  EXPECT_EQ(read_strip("stretch,stress [kPa]\n1,1e-999\n").channels[0].values[0], 0)
      << "too small for a double is zero";
}

TEST(Csv, ExplainsDecimalCommas) {
  EXPECT_NE(strip_refusal("stretch,stress [kPa]\n1,0,5\n")
                .find("line 2, column 3: found '5' beyond the last of the 2 columns"),
            std::string::npos);
  EXPECT_NE(
      strip_refusal("stretch;stress [kPa]\n1;0,5\n1.1;2,5\n").find("Use a decimal point, or decimal commas throughout"),
      std::string::npos);
}

TEST(Csv, AnswersAMissingColumnWithTheNearest) {
  EXPECT_EQ(strip_refusal("stretch,strss [kPa]\n1,0\n"),
            "strip.csv, line 1: there is no column 'stress'. Did you mean 'strss'? Known: stretch, strss.");
  EXPECT_NE(strip_refusal("stretch,stress (true)\n1,0\n").find("Did you mean 'stress (true)'?"), std::string::npos)
      << "what stands in the brackets is no unit";
}

TEST(Csv, RefusesAmbiguousColumns) {
  EXPECT_NE(
      strip_refusal("stretch,stress [kPa],stress [Pa]\n1,0,0\n").find("the columns 2 and 3 are both called 'stress'"),
      std::string::npos);
}

TEST(Csv, SaysWhyAFileHasNoData) {
  EXPECT_NE(strip_refusal("").find("strip.csv, line 1: the file is empty."), std::string::npos);
  EXPECT_NE(strip_refusal("# only\n\n# comments\n").find("the file is empty but for comments"), std::string::npos);
  EXPECT_NE(
      strip_refusal("# c\nstretch,stress [kPa]\n# end\n").find("strip.csv, line 2: the file ends after its header"),
      std::string::npos);
  EXPECT_NE(strip_refusal("1,0\n1.1,2.5\n")
                .find("strip.csv, line 1, column 1: found the number 1 where the header is expected"),
            std::string::npos);
  EXPECT_NE(strip_refusal(std::string_view("stretch,stress\n1,\0\n", 19)).find("line 2: found a zero byte"),
            std::string::npos);
  EXPECT_NE(
      strip_refusal("stretch,stress [kPa]\n1,\"0\n1.1,2\n").find("line 2: a quoted field opens here and never closes"),
      std::string::npos);
}

TEST(Csv, SaysWhyAFileCannotBeRead) {
  const testing::Folder folder;
  EXPECT_NE(testing::message_of<InputError>([&] {
              read_bytes(folder.path() / "no.csv");
            }).find("no.csv: there is no such file"),
            std::string::npos);
  EXPECT_NE(testing::message_of<InputError>([&] { read_bytes(folder.path()); }).find("this is a folder"),
            std::string::npos);
  EXPECT_NE(testing::message_of<InputError>([&] { read_bytes("/dev/null"); }).find("not a regular file"),
            std::string::npos);
}

TEST(Csv, RefusesUnitsThatDoNotFitTheObservable) {
  EXPECT_EQ(strip_refusal("stretch,stress [kPaa]\n1,0\n")
                .find("strip.csv, line 1, column 2 ('stress'): unknown unit 'kPaa'. Did you mean 'kPa'?"),
            0u);
  EXPECT_NE(strip_refusal("stretch,stress [mm]\n1,0\n")
                .find("the unit 'mm' cannot be converted to 'kPa': they measure different things. The observable "
                      "'stress' is in kPa: correct the unit in the header."),
            std::string::npos);
  EXPECT_NE(strip_refusal("stretch [mm],stress [kPa]\n1,0\n").find("line 1, column 1 ('stretch'): the unit 'mm'"),
            std::string::npos);
}

TEST(Csv, WarnsOfAMissingUnit) {
  const Dataset strip = read_strip("stretch,stress\n1,0\n1.1,2\n");
  ASSERT_EQ(strip.warnings.size(), 1u);
  EXPECT_EQ(strip.warnings[0],
            "strip.csv, line 1, column 2 ('stress'): the header gives no unit; kPa is assumed. Write 'stress [kPa]'.");
}

/// The unit may be the end of the name, where the quantity can have it.
TEST(Csv, ReadsAUnitAtTheEndOfAName) {
  const auto read = [](const std::string& name, const std::string& header) {
    return read_strip("stretch," + header + "\n1,0\n1.1,2\n", {{"stretch", "stretch"}, {"stress", name}});
  };
  const Dataset in_megapascal = read("S11_MPa", "S11_MPa");
  EXPECT_EQ(in_megapascal.channels[0].values[1], 2000);
  EXPECT_TRUE(in_megapascal.warnings.empty());
  EXPECT_EQ(read("S11_MPa", "S11_MPa [Pa]").channels[0].values[1], 0.002) << "what the header says goes first";
  for (const char* name : {"S11_s", "S_m", "stress_MPA", "_MPa"}) {
    const Dataset plain = read(name, name);
    EXPECT_EQ(plain.channels[0].values[1], 2) << name;
    EXPECT_EQ(plain.warnings.size(), 1u) << name;
  }
}

TEST(Csv, RefusesSelectionsThatLeaveNothing) {
  DataRequest request;
  request.where = {{"specimen", "conrtol1"}};
  EXPECT_NE(strip_refusal("specimen,stretch,stress [kPa]\ncontrol1,1,0\n", {}, request)
                .find("line 1, column 1 ('specimen'): no row left has the value 'conrtol1' that \"where\" asks for. "
                      "Did you mean 'control1'?"),
            std::string::npos);
  request = {};
  request.rows = {5, 9, 1};
  EXPECT_NE(strip_refusal("stretch,stress [kPa]\n1,0\n1.1,1\n", {}, request)
                .find("\"rows\" begins at 5 and ends before 9, but there are rows 0 to 1"),
            std::string::npos);
  request.rows = {0, 9, 1};
  const Dataset strip = read_strip("stretch,stress [kPa]\n1,0\n1.1,1\n", {}, request);
  ASSERT_EQ(strip.warnings.size(), 1u);
  EXPECT_NE(strip.warnings[0].find("\"rows\" ends at 9, but there are only 2 rows"), std::string::npos);
}

TEST(Csv, RefusesRequestsTheTestCannotServe) {
  const std::string text = "stretch,stress [kPa],time [s]\n1,0,0\n";
  EXPECT_NE(strip_refusal(text, {{"stretch", "stretch"}, {"strss", "stress"}})
                .find("the test has no observable 'strss'. Did you mean 'stress'?"),
            std::string::npos);
  EXPECT_NE(strip_refusal(text, {{"stress", "stress"}}).find("no column is mapped to 'stretch'"), std::string::npos);
  const Dataset predicted = read_strip(text, {{"stretch", "stretch"}});
  ASSERT_EQ(predicted.channels.size(), 1u) << "the stress along the mapped stretch";
  EXPECT_EQ(predicted.channels[0].observable, "stress");
  EXPECT_TRUE(std::isnan(predicted.channels[0].values[0]));
  EXPECT_NE(
      strip_refusal(text, {{"stretch", "stretch"}, {"stress", "stress"}, {"stress", "time"}}).find("mapped twice"),
      std::string::npos);
  DataRequest request;
  request.stress_measure = "cauchi";
  EXPECT_NE(strip_refusal(text, {}, request).find("unknown stress measure 'cauchi'. Did you mean 'cauchy'?"),
            std::string::npos);
  request = {};
  request.time_rate = 1;
  EXPECT_NE(strip_refusal(text, {{"stretch", "stretch"}, {"stress", "stress"}, {"time", "time"}}, request)
                .find("leave out one"),
            std::string::npos);
  EXPECT_NE(testing::message_of<InputError>([] { read_dataset({}, {}); }).find("no data file is named"),
            std::string::npos);
}

}  // namespace
}  // namespace tunica::data
