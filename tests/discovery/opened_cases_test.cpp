// SPDX-License-Identifier: Apache-2.0
// Truths are opened by their seal, and verdicts read from result.json.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "execution/folder.hpp"
#include "scorer/table.hpp"
#include "seal.hpp"

using namespace blind::score;
using nlohmann::json;
using ::testing::HasSubstr;
using tunica::trial::Folder;
using tunica::trial::message_of;

namespace {

/// Writes one case and its sealed truth; a verdict unless empty.
void write_case(const Folder& folder, const std::string& name, const json& truth, const json& diagnosis) {
  std::filesystem::create_directories(folder.path() / name);
  std::filesystem::create_directories(folder.path() / "sealed");
  const std::string text = truth.dump();
  folder.write("sealed/" + name + ".json", text);
  folder.write(name + "/truth.sha256", blind::sha256(text) + "\n");
  if (!diagnosis.is_null()) folder.write(name + "/result.json", json{{"diagnosis", diagnosis}}.dump());
}
json null_truth() {
  return {{"set", "nulls"},
          {"noise", {{"kind", "white"}}},
          {"lambda_asked", 0},
          {"gross_errors", json::array()},
          {"effects", json::array()}};
}

}  // namespace

TEST(Scorer, OpensATruthOnlyWithItsVerdictAndItsSeal) {
  const Folder folder;
  const auto open = [&](bool partial) {
    return message_of<InputError>([&] { (void)open_cases(folder.path(), folder.path(), partial); });
  };
  EXPECT_THAT(open(false), HasSubstr("holds no case"));
  const json verdict{{"verdict", "nothing_detected"}};
  write_case(folder, "case-1", null_truth(), verdict);
  write_case(folder, "case-2", null_truth(), {});
  EXPECT_THAT(open(false), HasSubstr("1 of 2 cases have no verdict, the first being case-2"));
  EXPECT_EQ(open(true), "");
  EXPECT_EQ(open_cases(folder.path(), folder.path(), true).sealed, 1U);
  folder.write("case-2/result.json", "{\"runs\": []}");
  EXPECT_THAT(open(false), HasSubstr("there is no object 'diagnosis'"));
  folder.write("case-2/result.json", json{{"diagnosis", {{"verdict", "maybe"}}}}.dump());
  EXPECT_THAT(open(false), HasSubstr("found the verdict 'maybe', expected one of nothing_detected"));
  folder.write("case-2/result.json", json{{"diagnosis", verdict}}.dump());
  EXPECT_EQ(open_cases(folder.path(), folder.path(), false).cases.size(), 2U);
  json changed = null_truth();
  changed["lambda_asked"] = 60;
  folder.write("sealed/case-1.json", changed.dump());
  EXPECT_THAT(open(false), HasSubstr("the truth was changed after the data were written"));
  EXPECT_THAT(message_of<InputError>([&] { (void)open_cases(folder.path() / "nowhere", folder.path(), false); }),
              HasSubstr("is no folder of cases"));
}

TEST(Scorer, ReadsWhatAVerdictSays) {
  const Folder folder;
  json truth = null_truth();
  truth["set"] = "singles";
  truth["lambda_asked"] = 25;
  truth["effects"].push_back({{"id", "outliers"},
                              {"target", {{"test", "t"}, {"channel", "axial_force"}, {"row", 4}}},
                              {"amplitude", 2.0},
                              {"null", 0},
                              {"even", false},
                              {"reached", true}});
  const json diagnosis = json::parse(R"({"verdict": "indistinguishable", "ambiguity_set": ["outliers", "b"],
    "causes": [{"id": "outliers", "target": {"test": "t", "channel": "axial_force", "row": 4}, "probability": 0.7,
                "amplitude": {"value": 2.2, "unit": "mN", "ci95": [1.5, 2.9]}, "claim": "consistent_with"}],
    "confusable": [{"id": "outliers", "with": "b", "correlation": 0.97}],
    "gain": {"held_out": [{"block": "t", "p_value": 0.4}, {"block": "u", "p_value": null}]}})");
  write_case(folder, "case-1", truth, diagnosis);
  folder.write("case-1/oracle.json", R"({"detected": true, "first": "outliers", "pair": ["outliers", "b"],
                                           "pair_likeness": [{}, {"c": 0.93}]})");
  const Case one = open_cases(folder.path(), folder.path(), false).cases.at(0);
  const Cause& cause = one.verdict.causes.at(0);
  EXPECT_TRUE(one.truth.effects.at(0).target.met_by(cause.target));
  EXPECT_FALSE(one.truth.effects.at(0).target.met_by({"t", "axial_force", 5}));
  EXPECT_TRUE(cause.hedged);
  EXPECT_EQ(cause.low, 1.5);
  EXPECT_EQ(one.verdict.held_out, std::vector<double>{0.4});
  EXPECT_EQ(one.verdict.confusable.at({"b", "outliers"}), 0.97);
  EXPECT_EQ(one.oracle->first, "outliers");
  ASSERT_EQ(one.oracle->pair.size(), 2U);
  EXPECT_EQ(one.oracle->pair[0].id, "outliers");
  EXPECT_EQ(one.oracle->pair[1].likeness.at("c"), 0.93);
  folder.write("alike.json", R"({"a": ["b"]})");
  EXPECT_EQ(read_look_alikes(folder.path() / "alike.json").at("a"), std::vector<std::string>{"b"});
  folder.write("alike.json", R"(["b"])");
  EXPECT_THAT(message_of<InputError>([&] { (void)read_look_alikes(folder.path() / "alike.json"); }),
              HasSubstr("expected {\"id\": [\"look-alike\""));
}
