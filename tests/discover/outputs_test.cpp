// SPDX-License-Identifier: Apache-2.0
// What a discovery that is written down here says in result.json and on the terminal.
#include "discovery/output/outputs.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "diagnosis/measured.hpp"
#include "discovery/output/parts.hpp"
#include "discovery/verdict.hpp"

namespace tunica::discovery::outputs_test {
namespace {

using diagnosis::BlockVerdict;
using diagnosis::Verdict;
using json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

Kind kind(const std::string& invariant, const std::string& law, const std::string& family = "") {
  Kind one{invariant, family, law, {}};
  one.reach = {-0.5, 2.5};
  return one;
}

class DiscoveryOutputs : public ::testing::Test {
 protected:
  DiscoveryOutputs() {
    found.request.model = "rubber";
    found.request.alpha = 0.02;
    found.analysis.evidence.fit.residuals = Eigen::VectorXd::Zero(75);
    found.analysis.alarm.detection.p = 0.001;
    found.judgement.verdict = Verdict::discovered;
    found.judgement.reasons = {{ReasonKind::terms_found, "One sentence."}, {ReasonKind::form_open, "Another."}};
    found.chi2_before = 300.04;
    found.chi2_after = 70.26;
    found.p_after = 0.4;
    found.sets_tried = 12;
    FoundTerm term{"I2_linear", std::make_shared<const Kind>(kind("I2", "linear")), 0.9, 0.95, {}, {}};
    term.parameters = {{"mu", "kPa", 40, 38, 42}, {"m", "1", 2, 1, 3, true}};
    term.curve = {{0, 1}, {20, 21}, {18, 19}, {22, 23}};
    found.terms = {term};
  }
  [[nodiscard]] std::string page() const { return trial::in_one_line(summary(found).plain()); }

  Discovery found{};
};

TEST_F(DiscoveryOutputs, HaveTheAnswerWithWhatWasAsked) {
  json written = discovery_json(found);
  EXPECT_EQ(written["verdict"], "discovered");
  EXPECT_EQ(written["reasons"], json::array({{{"code", "terms_found"}, {"text", "One sentence."}},
                                             {{"code", "form_open"}, {"text", "Another."}}}));
  EXPECT_EQ(written["base"], "rubber");
  EXPECT_EQ(written["model"], "rubber");
  EXPECT_EQ(written["alpha"], 0.02);
  EXPECT_EQ(written["p_before"], 0.001);
  EXPECT_EQ(written["p_after"], 0.4);
  EXPECT_EQ(written["chi2_before"], 300.04);
  EXPECT_EQ(written["chi2_after"], 70.26);
  EXPECT_EQ(written["rows"], 75);
  EXPECT_EQ(written["sets_fitted"], 12);
  EXPECT_EQ(written["ambiguity_set"], json::array());
  EXPECT_FALSE(written.contains("name_of_the_catalogue") || written.contains("next_experiment"));
  found.request.from_nothing = true;
  written = discovery_json(found);
  EXPECT_EQ(written["model"], "rubber");
  for (const char* key : {"base", "p_before", "chi2_before"}) EXPECT_EQ(written[key], nullptr) << key;
  found.judgement = {};
  found.terms.clear();
  written = discovery_json(found);
  for (const char* key : {"reasons", "terms", "held_out"}) EXPECT_EQ(written[key], json::array()) << key;
}

TEST_F(DiscoveryOutputs, HaveEveryTermWithItsCurve) {
  const json term = discovery_json(found)["terms"].at(0);
  EXPECT_EQ(term,
            json({{"name", "I2_linear"},
                  {"invariant", "I2"},
                  {"law", "linear"},
                  {"closed", true},
                  {"probability", 0.9},
                  {"invariant_probability", 0.95},
                  {"parameters",
                   {{"mu", {{"value", 40.0}, {"low", 38.0}, {"high", 42.0}, {"unit", "kPa"}, {"at_bound", false}}},
                    {"m", {{"value", 2.0}, {"low", 1.0}, {"high", 3.0}, {"unit", "1"}, {"at_bound", true}}}}},
                  {"curve",
                   {{"x", {0.0, 1.0}},
                    {"slope", {20.0, 21.0}},
                    {"low", {18.0, 19.0}},
                    {"high", {22.0, 23.0}},
                    {"unit", "kPa"},
                    {"reach", {-0.5, 2.5}}}}}));
  found.terms.front().kind = std::make_shared<const Kind>(kind("I2", "spline"));
  EXPECT_EQ(discovery_json(found)["terms"][0]["closed"], false);
}

TEST_F(DiscoveryOutputs, NameAKindByInvariantFamilyLawAndKnots) {
  EXPECT_EQ(kind_json(kind("I1", "gent")), json({{"invariant", "I1"}, {"law", "gent"}}));
  Kind curve = kind("fibre", "spline", "axial");
  curve.knots = {0, 0.5};
  EXPECT_EQ(kind_json(curve),
            json({{"invariant", "fibre"}, {"family", "axial"}, {"law", "spline"}, {"knots", {0.0, 0.5}}}));
}

TEST_F(DiscoveryOutputs, ListAlternativesByWhatTheyAre) {
  const auto second = std::make_shared<const Kind>(kind("I2", "linear"));
  found.judgement.ambiguity = {
      {{second}, "", false, 0.5, 70}, {{}, "force_offset", false, 0.3, 80}, {{}, "viscoelasticity", true, 0.2, 90}};
  found.judgement.name = Rival{};
  found.judgement.name->id = "second_invariant";
  found.judgement.name->chi2 = 71;
  const json written = discovery_json(found);
  EXPECT_EQ(
      written["ambiguity_set"],
      json::array(
          {{{"terms", json::array({{{"invariant", "I2"}, {"law", "linear"}}})}, {"probability", 0.5}, {"chi2", 70.0}},
           {{"rig", json::array({"force_offset"})}, {"probability", 0.3}, {"chi2", 80.0}},
           {{"memory", json::array({"viscoelasticity"})}, {"probability", 0.2}, {"chi2", 90.0}}}));
  EXPECT_EQ(written["name_of_the_catalogue"], json({{"id", "second_invariant"}, {"chi2", 71.0}}));
}

TEST_F(DiscoveryOutputs, SayWhatDependsOnThePathAndWhatIsNext) {
  found.paths = {50, 0.6, 1e-5, true, "here"};
  found.held_out = {{"a", 5, 1, 0.25, 9, BlockVerdict::predicted}};
  found.next = "do this";
  const json written = discovery_json(found);
  EXPECT_EQ(written["path_dependence"], json({{"p_value", 1e-5}, {"share", 0.6}, {"where", "here"}}));
  EXPECT_EQ(written["held_out"], json::array({{{"block", "a"},
                                               {"rows", 9},
                                               {"before", 5.0},
                                               {"after", 1.0},
                                               {"p_value", 0.25},
                                               {"verdict", "predicted"}}}));
  EXPECT_EQ(written["next_experiment"], json({{"description", "do this"}}));
}

TEST_F(DiscoveryOutputs, SayTheVerdictAlarmAndTerms) {
  EXPECT_THAT(page(), HasSubstr("Verdict: DISCOVERED: One sentence. Another."));
  EXPECT_THAT(page(), HasSubstr("Alarm: noise alone would look like this with p = 0.001 (75 values, |r|² = 300.0)"));
  EXPECT_THAT(page(), HasSubstr("Terms: I2 (linear): mu = 40 kPa (38 … 42), m = 2 (1 … 3), at its bound; probability "
                                "0.90, of the invariant 0.95"));
  for (const char* lead : {"Name:", "Rig:", "Gain:", "Next:"}) EXPECT_THAT(page(), Not(HasSubstr(lead)));
  found.request.from_nothing = true;
  EXPECT_THAT(page(), Not(HasSubstr("Alarm:")));
  found.judgement.verdict = Verdict::nothing_detected;
  EXPECT_THAT(page(), HasSubstr("Verdict: NOTHING DETECTED: One sentence."));
}

TEST_F(DiscoveryOutputs, ListFourParametersAndLabelsOnce) {
  auto& parameters = found.terms.front().parameters;
  parameters.assign(6, {"c", "1", 2, 1, 3});
  found.terms.push_back(found.terms.front());
  std::size_t shown = 0, labels = 0;
  for (std::size_t at = 0; (at = page().find("c = 2 (1 … 3)", at)) != std::string::npos; ++at) ++shown;
  for (std::size_t at = 0; (at = page().find("Terms:", at)) != std::string::npos; ++at) ++labels;
  EXPECT_EQ(shown, 8u);
  EXPECT_EQ(labels, 1u);
}

TEST_F(DiscoveryOutputs, SayHowWellBlocksArePredicted) {
  found.held_out = {{"a", 5, 1, 0.25, 9, BlockVerdict::predicted},
                    {"b", 5, 4.126, 0, 9, BlockVerdict::not_predicted},
                    {"c", 5, 3, 0.1, 9, BlockVerdict::inconclusive}};
  found.next = "do this";
  EXPECT_THAT(page(),
              HasSubstr("Gain: a: error 5.00 → 1.00 σ (predicted) b: error 5.00 → 4.13 σ (not predicted) c: error "
                        "5.00 → 3.00 σ (inconclusive) Next: do this"));
}

TEST_F(DiscoveryOutputs, SayWhatElseExplainsTheData) {
  Rival name, rig;
  name.id = "second_invariant";
  name.in_the_energy = true;
  name.chi2 = 71.04;
  rig.id = "force_offset";
  rig.chi2 = 250;
  found.judgement.name = name;
  found.rivals = {name};
  EXPECT_THAT(page(), HasSubstr("Name: the catalogue's second_invariant changes the energy too and leaves |r|² 71.0"));
  EXPECT_THAT(page(), Not(HasSubstr("Rig:")));
  found.rivals.push_back(rig);
  EXPECT_THAT(page(),
              HasSubstr("Rig: the best error of the rig, force_offset, leaves |r|² 250.0; the terms leave 70.3"));
  found.judgement.verdict = Verdict::indistinguishable;
  EXPECT_THAT(page(), Not(HasSubstr("Rig:")));
  found.terms.clear();
  EXPECT_THAT(page(), Not(HasSubstr("Name:")));
}

/// Where the alarm is silent, or single rows were all that raised it.
TEST(NothingMissing, IsSaidWithTheFitOfTheBase) {
  diagnosis::Analysis analysis;
  analysis.evidence.fit.chi2 = 81;
  analysis.alarm.detection.p = 0.34;
  analysis.evidence.warnings = {{diagnosis::WarningKind::noise_estimated, "a warning"}};
  Request request;
  request.model = "rubber";
  Discovery found = nothing_missing(request, analysis);
  EXPECT_EQ(found.judgement.verdict, Verdict::nothing_detected);
  ASSERT_EQ(found.judgement.reasons.size(), 1u);
  EXPECT_EQ(found.judgement.reasons[0].kind, ReasonKind::residuals_like_noise);
  EXPECT_EQ(found.judgement.reasons[0].text, "The residuals could be noise (p = 0.34); there is nothing to discover.");
  EXPECT_EQ(found.request.model, "rubber");
  EXPECT_EQ(found.chi2_before, 81);
  EXPECT_EQ(found.chi2_after, 81);
  EXPECT_EQ(found.p_after, 0.34);
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_EQ(found.warnings[0].text, "a warning");
  analysis.evidence.gross.resize(1);
  found = nothing_missing(request, analysis);
  EXPECT_EQ(found.judgement.verdict, Verdict::suspect_data);
  ASSERT_EQ(found.judgement.reasons.size(), 1u);
  EXPECT_EQ(found.judgement.reasons[0].kind, ReasonKind::gross_rows);
}

}  // namespace
}  // namespace tunica::discovery::outputs_test
