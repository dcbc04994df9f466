// SPDX-License-Identifier: Apache-2.0
#include "experiment/json_document.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "data/written_file.hpp"
#include "tunica/error.hpp"

namespace tunica::experiment {
namespace {

std::string refusal(const std::string& text) {
  return testing::message_of<InputError>([&] { JsonDocument("e.json", text); });
}

std::pair<std::size_t, std::size_t> place(const JsonDocument& document, std::string_view pointer) {
  const auto [line, column] = document.place(pointer);
  return {line, column};
}

TEST(JsonDocument, KnowsWhereEveryValueStands) {
  const JsonDocument document("e.json", R"({ // a "comment": {
  "a": {"b": [1, {"c": 2}], /* "b": , */ "d/e~\u0066": "\"}]"},
  "ä": 3
})");
  using Place = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(place(document, ""), (Place{1, 1}));
  EXPECT_EQ(place(document, "/a"), (Place{2, 3}));
  EXPECT_EQ(place(document, "/a/b"), (Place{2, 9}));
  EXPECT_EQ(place(document, "/a/b/0"), (Place{2, 15}));
  EXPECT_EQ(place(document, "/a/b/1/c"), (Place{2, 19}));
  EXPECT_EQ(place(document, "/a/d~1e~0f"), (Place{2, 42}));
  EXPECT_EQ(place(document, "/ä"), (Place{3, 3}));
  EXPECT_EQ(place(document, "/a/b/7/x"), (Place{2, 9})) << "what is not there is where its parent is";
  EXPECT_EQ(document.root()["a"]["d/e~f"], "\"}]");
}

TEST(JsonDocument, RefusesDuplicateKeys) {
  EXPECT_EQ(refusal("{\"a\": {\"x\": 1},\n \"b\": 2,\n \"a\": 3}"),
            "e.json: the key 'a' appears twice in the same object (/a, line 3, column 2). It was given before in line "
            "1; names must differ. "
            "Remove or rename one.");
  EXPECT_EQ(refusal("{\"a\": {\"a\": 1}, \"b\": {\"a\": 1}}"), "") << "the same key in different objects is fine";
}

TEST(JsonDocument, SaysInPlainWordsWhatWasExpected) {
  EXPECT_EQ(
      refusal("{\"a\": 1,\n}"),
      "e.json: found '}' where a key in double quotes is expected (line 2, column 1). Remove the comma before it.");
  EXPECT_EQ(refusal("{\"a\": 1\n \"b\": 2}"),
            "e.json: found '\"b\"' where ',' or '}' is expected after the value of 'a' (line 2, column 2). Is a comma "
            "missing before it?");
  EXPECT_EQ(refusal("{\"a\" 1}"), "e.json: found '1' where ':' is expected after the key 'a' (line 1, column 6).");
  EXPECT_NE(refusal("{'a': 1}").find("JSON has double quotes only."), std::string::npos);
  EXPECT_NE(refusal("{\"a\": 'x'}").find("JSON has double quotes only."), std::string::npos);
  EXPECT_NE(refusal("{a: 1}").find(
                "found 'a' where a key in double quotes is expected (line 1, column 2). Keys look like \"name\": …"),
            std::string::npos);
  EXPECT_NE(
      refusal("[1, 2,]").find("found ']' where a value is expected (line 1, column 7). Remove the comma before it."),
      std::string::npos);
  EXPECT_NE(refusal("[1 2]").find("found '2' where ',' or ']' is expected (line 1, column 4)"), std::string::npos);
  EXPECT_NE(refusal("{\"a\": soft}")
                .find("found 'soft' where a value is expected (line 1, column 7). Put text in double quotes."),
            std::string::npos);
  EXPECT_NE(refusal("{\"a\": 3.71 mm}").find("found 'mm' where ',' or '}' is expected"), std::string::npos);
  EXPECT_NE(refusal("{\"a\": 3.71mm}")
                .find("'3.71mm' is not a number as JSON writes it, or too large for one (line 1, column 7)"),
            std::string::npos);
  EXPECT_NE(refusal("{\"a\": }").find("Is a value missing"), std::string::npos);
  EXPECT_NE(refusal("{\"a\": {\n\"b\": 1")
                .find("found the end of the file where ',' or '}' is expected after the value of 'b' (line 2, column "
                      "7). The '{' of "
                      "line 1 is not closed: a '}' is missing."),
            std::string::npos);
  EXPECT_NE(refusal("{\"a\": [1").find("a ']' is missing"), std::string::npos);
  EXPECT_NE(refusal("{\"a\": \"x}\n").find("a text opens with \" and does not close in its line (line 1, column 7)"),
            std::string::npos);
  EXPECT_NE(refusal("{} }").find("found '}' after the end of the JSON text"), std::string::npos);
  EXPECT_NE(refusal("{ /* never").find("a comment opens and never closes (line 1, column 3)"), std::string::npos);
  EXPECT_NE(refusal("").find("the file is empty"), std::string::npos);
  EXPECT_NE(refusal("{\"a\": 1e999}")
                .find("'1e999' is not a number as JSON writes it, or too large for one (line 1, column 7)"),
            std::string::npos);
  EXPECT_NE(refusal("{\"a\": \"\\q\"}").find("has an escape that JSON does not know"), std::string::npos);
  const std::string not_utf8 = refusal("{\"a\": \"\xC3(\"}");
  EXPECT_NE(not_utf8.find("this is not JSON (line 1, column 9). The parser says: syntax error"), std::string::npos)
      << not_utf8;
  EXPECT_NE(not_utf8.find("ill-formed UTF-8 byte"), std::string::npos) << not_utf8;
  EXPECT_NE(refusal(std::string(100, '[')).find("more than 64 levels of nesting"), std::string::npos);
}

}  // namespace
}  // namespace tunica::experiment
