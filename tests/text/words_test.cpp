// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "text/csv.hpp"
#include "text/lists.hpp"
#include "text/misfit_words.hpp"
#include "text/terminal.hpp"
#include "text/units.hpp"

using namespace tunica::text;

TEST(Lists, JoinAsASentenceDoes) {
  EXPECT_EQ(joined(std::vector<std::string>{}), "");
  EXPECT_EQ(joined(std::vector<std::string>{"a"}), "a");
  EXPECT_EQ(joined(std::vector<std::string>{"a", "b"}), "a and b");
  EXPECT_EQ(joined(std::vector<std::string>{"a", "b", "c"}), "a, b and c");
}

TEST(Lists, CountInWords) {
  EXPECT_EQ(counted(1, "search", "searches"), "1 search");
  EXPECT_EQ(counted(0, "search", "searches"), "0 searches");
  EXPECT_EQ(agreeing(1, "was", "were"), "was");
  EXPECT_EQ(agreeing(2, "was", "were"), "were");
}

TEST(Lists, BeginASentence) {
  EXPECT_EQ(capitalised("mu and k1"), "Mu and k1");
  EXPECT_EQ(capitalised(""), "");
  EXPECT_EQ(capitalised("fibre_recruitment: imaging"), "fibre_recruitment: imaging");
  EXPECT_EQ(capitalised("k1 is uncertain"), "k1 is uncertain");
  const std::vector<std::string> names{"mu"};
  EXPECT_EQ(capitalised("mu: the profile", names), "mu: the profile");
  EXPECT_EQ(capitalised("music", names), "Music");
}

TEST(Units, StandBesideWhatHasADimension) {
  EXPECT_EQ(unit_suffix("kPa"), " kPa");
  EXPECT_EQ(unit_suffix("1"), "");
  EXPECT_EQ(unit_suffix(""), "");
  EXPECT_EQ(titled("mu", "kPa"), "mu [kPa]");
  EXPECT_EQ(titled("k2", "1"), "k2");
  EXPECT_TRUE(is_dimensionless("1"));
  EXPECT_FALSE(is_dimensionless("deg"));
}

TEST(Csv, QuotesWhatWouldBreakACell) {
  EXPECT_EQ(csv_cell("plain"), "plain");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"a\""), "\"say \"\"a\"\"\"");
  EXPECT_EQ(csv_cell("two\nlines"), "two\\nlines");
}

TEST(Csv, CellsActNeitherInASpreadsheetNorOnATerminal) {
  EXPECT_EQ(csv_cell("=cmd|' /C calc'!A0"), "'=cmd|' /C calc'!A0");
  EXPECT_EQ(csv_cell("=SUM(A1,A2)"), "\"'=SUM(A1,A2)\"");
  EXPECT_EQ(csv_cell("@x"), "'@x");
  EXPECT_EQ(csv_cell("+x"), "'+x");
  EXPECT_EQ(csv_cell("-x"), "'-x");
  EXPECT_EQ(csv_cell("-"), "-");
  EXPECT_EQ(csv_cell("red\033[31m"), "red\\x1b[31m");
  EXPECT_EQ(csv_cell("\u202Egnp"), "\\u202egnp");
  EXPECT_NE(csv_cell("a\nb"), csv_cell("a\rb"));
  for (const char* number : {"-1", "+3.5", "-1.5e-3", "-.5", "+1E+9", "-inf", "12"})
    EXPECT_EQ(csv_cell(number), number);
  for (const char* formula : {"-1+1", "-1e", "-1.2.3", "-e5"}) EXPECT_EQ(csv_cell(formula), std::string("'") + formula);
}

TEST(Csv, CellsReadBack) {
  for (const char* text : {"=1+1", "'=1+1", "''", "plain", "-5", "-x", "'", "", "'quoted'"})
    EXPECT_EQ(cell_text(csv_cell(text)), text);
}

TEST(MisfitWords, SayHowLargeItIsAndWhetherThatIsWithinTheTolerance) {
  EXPECT_EQ(misses_by(0.0688), "misses by 6.9 % of the range");
  EXPECT_EQ(misses_by(0.00236), "misses by 0.24 % of the range");
  EXPECT_EQ(percent(0.118), "12 %");
  EXPECT_EQ(against_tolerance(0.015, 0.02, 0.02, "stated"), "tolerance 2.0 % (stated): reached");
  EXPECT_EQ(against_tolerance(0.019, 0.021, 0.02, "default"), "tolerance 2.0 % (default): nearly reached");
  EXPECT_EQ(against_tolerance(0.025, 0.026, 0.02, "default"), "tolerance 2.0 % (default): not reached");
}

TEST(Terminal, WritesTimesAsClocksDo) {
  EXPECT_EQ(clock_text(7.4), "0:07");
  EXPECT_EQ(clock_text(750), "12:30");
  EXPECT_EQ(clock_text(3 * 3600 + 5 * 60), "3:05:00");
}

TEST(Terminal, IsNoneWhereOutputIsAFile) {
  const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(null, 0);
  const auto terminal = Terminal::of(null);
  ::close(null);
  EXPECT_FALSE(terminal.redraws);
  EXPECT_FALSE(terminal.colours);
  EXPECT_EQ(terminal.columns, 80u);
}
