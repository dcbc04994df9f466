// SPDX-License-Identifier: Apache-2.0
// The schema of terms for editors, compared with the accepted lists of terms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "models/composed.hpp"

namespace tunica::testing::terms_schema_test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

json schema_of(const std::vector<Option>& options, const std::string& name) {
  for (const Option& option : options)
    if (option.name == name) return json::parse(option.schema);
  return {};
}

/// Knots as docs/composed.md has them: up to 14 numbers from 0 on.
void expect_knots(const json& schema) {
  EXPECT_EQ(schema.at("type"), "array");
  EXPECT_EQ(schema.at("items"), json::parse(R"({"type": "number", "minimum": 0})"));
  EXPECT_EQ(schema.at("maxItems"), 14);
}

/// What an editor offers is what a list of terms may say: each word is taken, and no other key is known.
TEST(SchemaOfTerms, OffersWhatATermMaySay) {
  const json schema = schema_of(catalogue().models().at("composed").factory.options, "terms");
  EXPECT_EQ(schema.at("type"), "array");
  EXPECT_EQ(schema.at("minItems"), 1);
  const json& term = schema.at("items");
  EXPECT_EQ(term.at("additionalProperties"), false);
  EXPECT_EQ(term.at("required"), json::parse(R"(["name", "invariant"])"));
  std::vector<std::string> keys;
  for (const auto& [key, value] : term.at("properties").items()) keys.push_back(key);
  EXPECT_THAT(keys,
              ElementsAre("angle_of", "dispersion", "family", "fibre_switch", "invariant", "knots", "law", "name"));
  const json& of = term.at("properties");
  EXPECT_EQ(of.at("name").at("pattern"), "^[A-Za-z][A-Za-z0-9_]*$");
  EXPECT_EQ(of.at("angle_of").at("type"), "string");
  EXPECT_EQ(of.at("dispersion").at("default"), "none");
  EXPECT_EQ(of.at("fibre_switch").at("default"), "strain");
  expect_knots(of.at("knots"));
  EXPECT_EQ(of.at("knots").at("minItems"), 2);
  const auto words = [&of](const char* key) { return of.at(key).at("enum").get<std::vector<std::string>>(); };
  EXPECT_THAT(words("invariant"), ElementsAre("I1", "I2", "fibre", "coupling", "radial", "across", "stretches", "I1*I2",
                                              "I1^2*I2", "I1*I2^2", "J", "I1bar", "I2bar", "fibrebar", "stretchesbar",
                                              "I1bar*I2bar", "I1bar^2*I2bar", "I1bar*I2bar^2"));
  EXPECT_EQ(words("law").size(), 13u);
  for (const std::string& law : words("law")) {
    const std::string knots = law == "spline" ? R"(, "knots": [0, 1])" : "";
    const bool of_volume = law == "logarithmic" || law == "simo" || law == "ogden";
    const std::string invariant = of_volume ? "J" : "I1";
    EXPECT_EQ(refusal(R"([{"name": "a", "invariant": ")" + invariant + R"(", "law": ")" + law + "\"" + knots + "}]"),
              "")
        << law;
  }
  for (const char* key : {"family", "dispersion", "fibre_switch"}) {
    EXPECT_GE(words(key).size(), 3u) << key;
    for (const std::string& word : words(key)) {
      json one{{"name", "a"}, {"invariant", "fibre"}, {"law", "quadratic"}, {"family", "axial"}};
      one[key] = word;
      EXPECT_EQ(refusal(json::array({one}).dump()), "") << key << ' ' << word;
    }
  }
}

TEST(SchemaOfTerms, OffersTheKnotsOfAnAddedOne) {
  expect_knots(schema_of(catalogue().mechanisms().at("added_term").factory.options, "knots"));
}

}  // namespace
}  // namespace tunica::testing::terms_schema_test
