// SPDX-License-Identifier: Apache-2.0
#include "comparison/text.hpp"

#include <gtest/gtest.h>

using namespace tunica::comparison;

TEST(Text, CountsColumnsNotBytes) {
  EXPECT_EQ(columns("σ ± 2"), 5u);
  EXPECT_EQ(pad("µs", 4) + "|", "µs  |");
  EXPECT_EQ(pad_left("µs", 4) + "|", "  µs|");
  EXPECT_EQ(pad("longer", 3), "longer");
}

TEST(Text, CountsInWords) {
  EXPECT_EQ(counted(1, "search", "searches"), "1 search");
  EXPECT_EQ(counted(0, "search", "searches"), "0 searches");
}

TEST(Text, WrapsBehindItsLead) {
  EXPECT_EQ(hanging("  ! ", "one two three four", 12), "  ! one two\n    three\n    four");
  EXPECT_EQ(hanging("a: ", "one\ntwo", 40), "a: one\n   two");
  EXPECT_EQ(hanging("a: ", "unbreakably", 5), "a: unbreakably");
  EXPECT_EQ(hanging("a", "", 5), "a");
}

TEST(Text, PutsALongLeadOnALineOfItsOwn) {
  EXPECT_EQ(hanging("  a_long_name: ", "one two three", 16), "  a_long_name:\n    one two\n    three");
  EXPECT_EQ(hanging("  a_long_name: ", "", 16), "  a_long_name: ");
  EXPECT_EQ(hanging("            ", "one two", 16), "            one\n            two") << "blanks are a column";
}
