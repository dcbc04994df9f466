// SPDX-License-Identifier: Apache-2.0
#include "text/wrapping.hpp"

#include <gtest/gtest.h>

using namespace tunica::text;

TEST(Wrapping, CountsColumnsNotBytes) {
  EXPECT_EQ(columns("σ ± 2"), 5u);
  EXPECT_EQ(pad("µs", 4) + "|", "µs  |");
  EXPECT_EQ(pad_left("µs", 4) + "|", "  µs|");
  EXPECT_EQ(pad("longer", 3), "longer");
}

TEST(Wrapping, CutsOffWhatIsTooLong) {
  EXPECT_EQ(shortened("λμν", 3), "λμν");
  EXPECT_EQ(shortened("λμνξ", 3), "λμ…");
  EXPECT_EQ(shortened("a\033[31mb\r", 20), "a\\x1b[31mb\\r");
  EXPECT_EQ(shortened("ab", 0), "");
}

TEST(Wrapping, WrapsBehindItsLead) {
  EXPECT_EQ(hanging("  ! ", "one two three four", 12), "  ! one two\n    three\n    four");
  EXPECT_EQ(hanging("a: ", "one\ntwo", 40), "a: one\n   two");
  EXPECT_EQ(hanging("a: ", "unbreakably", 5), "a: unbreakably");
  EXPECT_EQ(hanging("a", "", 5), "a");
}

TEST(Wrapping, PutsALongLeadOnALineOfItsOwn) {
  const std::string name(22, 'x');
  EXPECT_EQ(hanging("  " + name + ": ", "one two three", 16), "  " + name + ":\n    one two\n    three");
  EXPECT_EQ(hanging("  " + name + ", rows 3 to 18: ", "one", 30), "  " + name + ", rows\n  3 to 18:\n    one");
  EXPECT_EQ(hanging("  " + name + ": ", "", 16), "  " + name + ": ");
  const std::string blank(22, ' ');
  EXPECT_EQ(hanging(blank, "one two", 16), blank + "one\n" + blank + "two") << "blanks are a column";
}
