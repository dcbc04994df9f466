// SPDX-License-Identifier: Apache-2.0
#include "text/styled.hpp"

#include <gtest/gtest.h>

using namespace tunica::text;

TEST(StyledText, StandsOutOnlyWhereThereAreColours) {
  StyledText text("k = 1  ");
  text.add("<- at a bound", Emphasis::caution);
  text += "\n";
  EXPECT_EQ(text.plain(), "k = 1  <- at a bound\n");
  EXPECT_EQ(text.coloured(), "k = 1  \033[33m<- at a bound\033[0m\n");
}

TEST(StyledText, KeepsItsMarksWhereItIsAppended) {
  StyledText text;
  text.add("Warnings", Emphasis::heading);
  text += "\n";
  text += caution_line("one");
  EXPECT_EQ(text.plain(), "Warnings\n  ! one\n");
  EXPECT_EQ(text.coloured(), "\033[1mWarnings\033[0m\n  \033[33m!\033[0m one\n");
}
