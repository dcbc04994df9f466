// SPDX-License-Identifier: Apache-2.0
#include "report/html.hpp"

#include <gtest/gtest.h>

using namespace tunica::report;

TEST(Escaping, LeavesNoCharacterThatActsInHtml) {
  EXPECT_EQ(escaped("<img src=x onerror='a()'> & \"b\""),
            "&lt;img src=x onerror=&#39;a()&#39;&gt; &amp; &quot;b&quot;");
  EXPECT_EQ(escaped("λ3 … ΔAICc"), "λ3 … ΔAICc");
}

TEST(Escaping, ReplacesWhatIsNoUtf8AndShowsWhatActsOnTheReader) {
  EXPECT_EQ(escaped("a\xff"), "a\xEF\xBF\xBD");
  EXPECT_EQ(escaped(std::string("a\0b\x1b", 4)), "a\\x00b\\x1b");
  EXPECT_EQ(escaped("a\u202eb"), "a\\u202eb");
  EXPECT_EQ(escaped("a\nb"), "a\nb");
}

TEST(ScriptJson, CannotEndTheScriptNorBeginAComment) {
  const std::string text = script_json({{"</script><!--", "\xE2\x80\xA8\xE2\x80\xA9 & ]]>"}});
  EXPECT_EQ(text, R"({"\u003c/script\u003e\u003c!--":"\u2028\u2029 \u0026 ]]\u003e"})");
}

TEST(ScriptJson, ReadsBackAsWhatItWas) {
  const nlohmann::ordered_json value = {{"a<b>&\xE2\x80\xA8", {1.5, nullptr, "</script>"}}, {"μ", "\\\""}};
  EXPECT_EQ(nlohmann::ordered_json::parse(script_json(value)), value);
}

TEST(ScriptJson, TakesMalformedUtf8) { EXPECT_EQ(script_json("a\xff"), "\"a\xEF\xBF\xBD\""); }

// The value of printf 'alert(1)' | openssl dgst -sha256 -binary | base64.
TEST(PolicySource, IsTheHashThatBrowsersCompute) {
  EXPECT_EQ(policy_source("alert(1)"), "'sha256-bhHHL3z2vDgxUt0W3dWQOrprscmda2Y5pLsLg4GF+pI='");
}

TEST(Address, KeepsPathsAndEscapesTheRest) {
  EXPECT_EQ(address("../a-1/fit_x.csv"), "../a-1/fit_x.csv");
  EXPECT_EQ(address("a b\"<#?%.csv"), "a%20b%22%3C%23%3F%25.csv");
  EXPECT_EQ(address("javascript:x"), "javascript%3Ax");
}
