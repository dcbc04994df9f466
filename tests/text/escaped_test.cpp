// SPDX-License-Identifier: Apache-2.0
#include "text/escaped.hpp"

#include <gtest/gtest.h>

#include "text/wrapping.hpp"

using namespace tunica::text;

TEST(Escaped, LeavesPlainTextAsItIs) {
  for (const char* text : {"", "mu [kPa]", "λ3 = 1,2 …", "日本", "\xF0\x9F\x98\x80"}) {
    EXPECT_TRUE(is_plain(text)) << text;
    EXPECT_EQ(escaped(text), text);
  }
}

TEST(Escaped, ShowsWhatWouldActOnATerminal) {
  EXPECT_EQ(escaped("a\033[31mb\a\x7f"), "a\\x1b[31mb\\x07\\x7f");
  EXPECT_EQ(escaped("\xC2\x9B"
                    "31m"),
            "\\u009b31m")
      << "the eight-bit form of ESC [";
  EXPECT_EQ(escaped("abc\u202Etxt\u2066\u2069\u200F"), "abc\\u202etxt\\u2066\\u2069\\u200f");
  EXPECT_EQ(escaped("one\u2028two"), "one\\u2028two");
  EXPECT_EQ(escaped("one\ntwo\tthree"), "one\\ntwo\\tthree");
  EXPECT_EQ(escaped("one\ntwo\tthree", "\n"), "one\ntwo\\tthree");
}

TEST(Escaped, ShowsBytesThatAreNotUtf8) {
  // Alone, cut short, overlong, a surrogate, above U+10FFFF.
  for (const char* text : {"\xFF", "\x80", "\xC3", "\xE2\x82", "\xC0\xAF", "\xE0\x80\x80", "\xED\xA0\x80",
                           "\xF4\x90\x80\x80", "\xF5\x80\x80\x80"}) {
    EXPECT_FALSE(is_utf8(text)) << escaped(text);
    EXPECT_TRUE(is_plain(escaped(text))) << escaped(text);
  }
  EXPECT_EQ(escaped("L\xE4nge"), "L\\xe4nge");
  EXPECT_EQ(escaped(std::string_view("\0", 1)), "\\x00");
}

TEST(Escaped, TwiceIsOnce) {
  const std::string once = escaped("a\033\xFF\u202E");
  EXPECT_EQ(escaped(once), once);
}

TEST(Excerpt, CutsBetweenCharactersAndEscapesTheRest) {
  EXPECT_EQ(excerpt("λμν", 4), "λμ…");
  EXPECT_EQ(excerpt("λμν", 5), "λμ…");
  EXPECT_EQ(excerpt("λμν", 6), "λμν");
  EXPECT_EQ(excerpt(std::string(100'000'000, 'k')).size(), 63u);
  EXPECT_EQ(excerpt("\033[2J"), "\\x1b[2J");
}

TEST(Message, IsShortWhateverItQuotes) {
  const std::string word = message("error: " + std::string(1000000, 'k') + " is long\nnext");
  EXPECT_LT(word.size(), 30000u);
  EXPECT_LT(message("a " + std::string(700, 'k') + " end\nnext").size(), 620u);
  EXPECT_TRUE(message("a " + std::string(700, 'k') + " end\nnext").ends_with("… end\nnext"));
  EXPECT_EQ(message("two\nlines \033"), "two\nlines \\x1b");
}

TEST(JsonProblem, IsSaidWithoutTheCodesOfTheLibrary) {
  EXPECT_EQ(json_problem("[json.exception.parse_error.101] parse error at line 1, column 2: no"),
            "parse error at line 1, column 2: no");
  EXPECT_EQ(json_problem("another [a] b"), "another [a] b");
  EXPECT_EQ(json_problem("[json.exception.broken"), "[json.exception.broken");
  EXPECT_EQ(json_problem("last read: '\033'"), "last read: '\\x1b'");
}

TEST(PlainJson, EscapesWhatTheLibraryWritesRaw) {
  EXPECT_EQ(plain_json("{\n \"a\": \"\u202E\x7f\u0085λ\"\n}"), "{\n \"a\": \"\\u202e\\u007f\\u0085λ\"\n}");
}

TEST(Wrapping, ShowsEscapedWhatIsNotPlain) {
  EXPECT_EQ(hanging("a\033: ", "b\u202E c\nd"), "a\\x1b: b\\u202e c\n       d");
  EXPECT_EQ(pad("\033", 6), "\\x1b  ");
  EXPECT_EQ(pad_left("\xFF", 6), "  \\xff");
}
