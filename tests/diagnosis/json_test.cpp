// SPDX-License-Identifier: Apache-2.0
// What result.json says of a diagnosis: every figure under its key. One real diagnosis, and findings written down here.
#include <gmock/gmock.h>

#include "diagnosis/hypotheses/places.hpp"
#include "diagnosis/measured.hpp"
#include "diagnosis/naming/credible.hpp"
#include "diagnosis/output/outputs.hpp"

namespace tunica::diagnosis::json_test {
namespace {

using json = nlohmann::ordered_json;

class DiagnosisJson : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const trial::Measured measured({{.sd = 0.6}, {.name = "axial", .sd = 0.6}});
    measured.measure(21, [](nlohmann::json& truth) {
      truth["models"]["gho"]["mechanisms"] = {trial::mechanism("axial_fibres", "k", 1.5)};
    });
    real = new Diagnosis(measured.diagnose());
  }
  static void TearDownTestSuite() { delete real; }

  static Diagnosis* real;
  Diagnosis found = *real;
  Explanation& explanation = found.explanation;
};
Diagnosis* DiagnosisJson::real = nullptr;

Cause cause(const std::string& id) {
  Cause one;
  one.id = id;
  one.amplitude = {"value", "kPa", 3, 2, 4};
  return one;
}

TEST_F(DiagnosisJson, SaysWhereTheChanceIsABound) {
  found.analysis.alarm.p_refits = 5e-4;
  found.analysis.alarm.detection.p = 1e-6;
  EXPECT_EQ(diagnosis_json(found).at("p_value_is_bound"), true);
  found.analysis.alarm.detection.p = 5e-4;
  EXPECT_FALSE(diagnosis_json(found).contains("p_value_is_bound"));
}

TEST_F(DiagnosisJson, HasTheVerdictWithItsReasonsAndLevels) {
  explanation.verdict = Verdict::indistinguishable;
  explanation.reasons = {{ReasonKind::at_bound, "one"}, {ReasonKind::not_clean, "two"}};
  explanation.admissibility = {};
  found.request.alpha = 0.02;
  found.analysis.alarm.p_refits = 0.25;
  json written = diagnosis_json(found);
  EXPECT_EQ(written["verdict"], "indistinguishable");
  EXPECT_EQ(written["reasons"], json::array({"one", "two"}));
  EXPECT_EQ(written["reason_codes"], json::array({"at_bound", "not_clean"}));
  EXPECT_EQ(written["alpha"], 0.02);
  EXPECT_EQ(written["p_value"], 0.25);
  EXPECT_FALSE(written.contains("p_value_is_bound"));
  EXPECT_EQ(written["p_smooth"], found.analysis.alarm.detection.smooth);
  EXPECT_EQ(written["p_mechanisms"], found.analysis.alarm.detection.mechanisms);
  EXPECT_EQ(written["admissibility"], json({{"stable", nullptr}, {"where", nullptr}, {"remedy", nullptr}}));
  explanation.admissibility = {false, "here", "that", {}};
  EXPECT_EQ(diagnosis_json(found)["admissibility"], json({{"stable", false}, {"where", "here"}, {"remedy", "that"}}));
}

TEST_F(DiagnosisJson, HasEveryFigureOfACause) {
  Cause one = cause("first");
  one.place = {{"axial"}, "stress", 3, "gho", 7};
  one.group = CauseGroup::rig;
  one.p_value = 0.001;
  one.probability = 0.8;
  one.retained = 1.0000001;
  one.gain = 55;
  one.explanation = "because";
  one.nuisance = {{"shape", "1", 5, -INFINITY, 6, false, false}, {"other", "1", 5, 4, INFINITY}};
  one.shifts = {{"mu", "kPa", 10, 20}};
  explanation.claim.causes = {one, cause("second")};
  explanation.claim.causes[1].retained = 0.5;
  explanation.claim.named = 1;
  explanation.left_out = {cause("outliers")};
  const json written = diagnosis_json(found)["causes"];
  ASSERT_EQ(written.size(), 3u);
  EXPECT_EQ(written[1]["id"], "outliers") << "beside the causes, before the rivals";
  EXPECT_EQ(written[2]["id"], "second");
  EXPECT_EQ(written[2]["target"], nullptr);
  EXPECT_EQ(written[2]["retained_fraction"], 0.5);
  const json amplitude = {
      {"name", "value"}, {"value", 3.0}, {"unit", "kPa"}, {"ci95", {2.0, 4.0}}, {"plausible", true}};
  const json first = {
      {"id", "first"},
      {"group", "rig"},
      {"target", {{"test", "axial"}, {"channel", "stress"}, {"row", 7}, {"model", "gho"}}},
      {"p_value", 0.001},
      {"probability", 0.8},
      {"standing", code_of(standing_of(one, explanation))},
      {"amplitude", amplitude},
      {"nuisance",
       {{{"name", "shape"}, {"value", 5.0}, {"unit", "1"}, {"ci95", nullptr}, {"plausible", false}},
        {{"name", "other"}, {"value", 5.0}, {"unit", "1"}, {"ci95", nullptr}, {"plausible", true}}}},
      {"retained_fraction", 1.0},
      {"gain", 55.0},
      {"parameter_shifts", json::array({{{"parameter", "mu"}, {"unit", "kPa"}, {"without", 10.0}, {"with", 20.0}}})},
      {"claim", "consistent_with"},
      {"explanation", "because"}};
  EXPECT_EQ(written[0], first);
}

TEST_F(DiagnosisJson, SaysWhereSomethingActs) {
  const auto target = [&](const Place& place) {
    explanation.claim.causes = {cause("first")};
    explanation.claim.causes.front().place = place;
    return diagnosis_json(found)["causes"][0]["target"];
  };
  EXPECT_EQ(target({}), nullptr);
  EXPECT_EQ(target({{"a"}}), json({{"test", "a"}, {"channel", nullptr}}));
  EXPECT_EQ(target({{"a", "b"}, "force"}), json({{"test", nullptr}, {"channel", "force"}, {"tests", {"a", "b"}}}));
  EXPECT_EQ(target({{}, "", {}, "media"}), json({{"test", nullptr}, {"channel", nullptr}, {"model", "media"}}));
}

/// Pairs only: what one mechanism alone or three together could be is no alternative in the sense of the schema.
TEST_F(DiagnosisJson, HasTheAmbiguitySetInEveryForm) {
  explanation.claim.ambiguity_set = {"a", "b", "c"};
  explanation.claim.look_alikes = {{"a", "b"}, {"c"}};
  explanation.claim.alternatives = {{"d"}, {"e", "f"}, {"g", "h", "i"}};
  explanation.claim.causes = {cause("a")};
  explanation.claim.named = 1;
  json written = diagnosis_json(found);
  EXPECT_EQ(written["ambiguity_set"], json::array({"a", "b", "c"}));
  EXPECT_EQ(written["look_alikes"], json({{"a", "b"}, {"c"}}));
  EXPECT_EQ(written["alternatives"], json::array({{"e", "f"}}));
  EXPECT_EQ(written["explanations"], json::array({"a (or b, much the same here)", "c"}));
  EXPECT_FALSE(written.contains("unlisted"));
  explanation.claim.look_alikes.clear();
  explanation.claim.causes.clear();
  explanation.claim.named = 0;
  explanation.unlisted = true;
  written = diagnosis_json(found);
  EXPECT_FALSE(written.contains("look_alikes"));
  EXPECT_FALSE(written.contains("explanations"));
  EXPECT_EQ(written["unlisted"], true);
}

TEST_F(DiagnosisJson, SaysWhatIsGainedAndWhatIsNext) {
  found.prospects.gain =
      Gain{100, 40, 3, {{"block", 5, 1, 0.25, 9, BlockVerdict::not_predicted}}, Rejected{"other", 55}};
  found.prospects.next = NextExperiment{"do this", {"a", "b"}, 3};
  json written = diagnosis_json(found);
  EXPECT_EQ(written["gain"], json({{"in_sample", 60.0},
                                   {"before", 100.0},
                                   {"after", 40.0},
                                   {"expected_under_nothing", 3.0},
                                   {"held_out", json::array({{{"block", "block"},
                                                              {"rows", 9},
                                                              {"before", 5.0},
                                                              {"after", 1.0},
                                                              {"p_value", 0.25},
                                                              {"verdict", "not_predicted"}}})},
                                   {"best_wrong", {{"id", "other"}, {"in_sample", 45.0}}}}));
  EXPECT_EQ(written["next_experiment"], json({{"description", "do this"}, {"separates", {"a", "b"}}, {"repeats", 3}}));
  found.prospects.gain->best_rejected.reset();
  found.prospects.next->repeats.reset();
  written = diagnosis_json(found);
  EXPECT_EQ(written["gain"]["best_wrong"], nullptr);
  EXPECT_EQ(written["next_experiment"]["repeats"], nullptr);
  found.prospects.gain.reset();
  found.prospects.next.reset();
  written = diagnosis_json(found);
  EXPECT_FALSE(written.contains("gain") || written.contains("next_experiment"));
}

TEST_F(DiagnosisJson, SaysWhatWouldBeDetected) {
  Detectable one;
  one.id = "a";
  one.unit = "kPa";
  one.detectable = 2;
  one.identifiable = INFINITY;
  one.null = 1;
  one.reach = 3;
  one.retained = 1.0000001;
  one.closest = "b";
  one.correlation = 0.5;
  Detectable other;
  other.id = "c";
  other.detectable = NAN;
  other.absent = "no time";
  other.absence = Absence::no_clock;
  found.prospects.detectable = {one, other};
  const json written = diagnosis_json(found)["detectable"];
  EXPECT_EQ(written[0], json({{"id", "a"},
                              {"detectable", 2.0},
                              {"identifiable", nullptr},
                              {"null", 1.0},
                              {"reach", 3.0},
                              {"unit", "kPa"},
                              {"target", nullptr},
                              {"retained_fraction", 1.0},
                              {"closest", "b"},
                              {"correlation", 0.5},
                              {"absent", nullptr},
                              {"absence", "none"}}));
  EXPECT_EQ(written[1]["detectable"], nullptr);
  EXPECT_EQ(written[1]["closest"], nullptr);
  EXPECT_EQ(written[1]["absent"], "no time");
  EXPECT_EQ(written[1]["absence"], "no_clock");
}

TEST_F(DiagnosisJson, HasTheBaseFitItsNoiseAndWhereItMisses) {
  const Evidence& evidence = found.analysis.evidence;
  explanation.misfit = {{"axial", "stress", "here", 0.25, 1.5, 2}};
  auto& noise = found.analysis.evidence.noise;
  noise.resize(4);
  using Kind = NoiseSource::Kind;
  const Kind kinds[] = {Kind::stated, Kind::replicates, Kind::encompassing, Kind::differences};
  for (std::size_t k = 0; k < 4; ++k) noise[k].kind = kinds[k];
  noise[1].freedom = 12;
  noise[1].neighbours = 0.5;
  noise[1].noise.absolute = 0.25;
  noise[1].noise.relative = 0.125;
  noise[1].noise.correlation = 0.75;
  const json written = diagnosis_json(found);
  EXPECT_EQ(written["misfit"], json::array({{{"test", "axial"},
                                             {"channel", "stress"},
                                             {"where", "here"},
                                             {"from", 1.5},
                                             {"to", 2.0},
                                             {"p_value", 0.25}}}));
  ASSERT_EQ(written["noise"].size(), 4u);
  const char* const sources[] = {"stated", "replicates", "encompassing", "differences"};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(written["noise"][k]["source"], sources[k]);
  EXPECT_EQ(written["noise"][1], json({{"test", noise[1].test},
                                       {"channel", noise[1].channel},
                                       {"unit", noise[1].unit},
                                       {"source", "replicates"},
                                       {"absolute", 0.25},
                                       {"relative", 0.125},
                                       {"correlation", 0.75},
                                       {"freedom", 12.0},
                                       {"neighbours", 0.5}}));
  EXPECT_EQ(written["noise"][0]["freedom"], nullptr);
  EXPECT_EQ(written["noise"][0]["neighbours"], nullptr);
  EXPECT_EQ(written["base"]["model"], "gho");
  EXPECT_EQ(written["base"]["rows"], 60);
  EXPECT_EQ(written["base"]["squares"], evidence.fit.chi2);
  const auto& parameters = evidence.base->layout().parameters;
  ASSERT_EQ(written["base"]["parameters"].size(), parameters.size());
  for (std::size_t j = 0; j < parameters.size(); ++j)
    EXPECT_EQ(written["base"]["parameters"][parameters[j].name],
              json({{"value", evidence.fit.free[j]}, {"unit", parameters[j].unit}}));
}

/// Of every mechanism that leaves a trace the largest score, T = (ŝᵀr)² of r = measured − predicted.
TEST_F(DiagnosisJson, HasTheBestScoreOfEveryMechanism) {
  const Hypotheses& hypotheses = found.analysis.hypotheses;
  const json scores = diagnosis_json(found)["scores"];
  std::vector<double> best(hypotheses.candidates.size(), -1);
  for (const Direction& direction : hypotheses.directions) {
    const double t = -direction.unit.dot(found.analysis.evidence.fit.residuals);
    const bool admissible = direction.side == MechanismFactory::Side::both || t > 0;
    best[direction.candidate] = std::max(best[direction.candidate], admissible ? t * t : 0);
  }
  std::size_t visible = 0;
  for (std::size_t c = 0; c < best.size(); ++c) {
    if (best[c] < 0) continue;
    const json& one = scores.at(visible++);
    EXPECT_EQ(one["id"], hypotheses.candidates[c].id);
    EXPECT_NEAR(one["score"].get<double>(), best[c], 1e-9 * (1 + best[c])) << one["id"];
    EXPECT_EQ(one["p_value"], found.analysis.alarm.detection.by_candidate[c]);
    EXPECT_EQ(one["group"], code_of(group_of(*hypotheses.candidates[c].mechanism)));
  }
  EXPECT_EQ(scores.size(), visible);
  EXPECT_GT(visible, 5u);
  EXPECT_LT(visible, best.size());
}

TEST_F(DiagnosisJson, HasTheRankingAndPairsThatLookAlike) {
  explanation.ranking = {{"a", {{"axial"}}, 0.75, 20, 30, CauseGroup::rig},
                         {"b", {}, 0.25, 10, {}, CauseGroup::material}};
  const json written = diagnosis_json(found);
  EXPECT_EQ(written["ranking"][0], json({{"id", "a"},
                                         {"group", "rig"},
                                         {"target", {{"test", "axial"}, {"channel", nullptr}}},
                                         {"probability", 0.75},
                                         {"score", 20.0},
                                         {"gain", 30.0}}));
  EXPECT_EQ(written["ranking"][1]["gain"], nullptr);
  const Eigen::MatrixXd alike = likeness(found.analysis.hypotheses, explanation.best_direction);
  std::size_t pairs = 0;
  for (Eigen::Index a = 0; a < alike.rows(); ++a)
    for (Eigen::Index b = 0; b < a; ++b) pairs += std::max(alike(a, b), alike(b, a)) > look_alike ? 1 : 0;
  EXPECT_EQ(written["confusable"].size(), pairs);
  EXPECT_GT(pairs, 0u);
  for (const json& pair : written["confusable"]) {
    EXPECT_NE(pair["id"], pair["with"]);
    EXPECT_GT(pair["correlation"], look_alike);
  }
}

TEST_F(DiagnosisJson, HasTheExtensionAndWhatItLeaves) {
  ASSERT_TRUE(explanation.claim.best);
  explanation.left_out = {cause("outliers")};
  explanation.left_out.front().place = {{"axial"}, "stress", 3, "", 7};
  explanation.p_after = 0.5;
  found.analysis.alarm.factor = 1.5;
  explanation.noise_factor = 2.5;
  found.analysis.evidence.gross = {{"axial", "stress", 3, 7, 9.5, "here"}};
  json written = diagnosis_json(found);
  const Addition& added = explanation.claim.best->additions.front();
  EXPECT_EQ(written["extension"]["experiment"], "extended.json");
  ASSERT_EQ(written["extension"]["mechanisms"].size(), explanation.claim.best->additions.size() + 1);
  EXPECT_EQ(written["extension"]["mechanisms"][0]["type"], added.id);
  EXPECT_EQ(written["extension"]["mechanisms"][0]["as"], added.name());
  EXPECT_TRUE(written["extension"]["mechanisms"][0].contains("target"));
  EXPECT_EQ(written["extension"]["mechanisms"].back(),
            json({{"type", "outliers"}, {"target", {{"test", "axial"}, {"channel", "stress"}, {"row", 7}}}}));
  EXPECT_EQ(written["p_after"], 0.5);
  EXPECT_EQ(written["remainder"], "clean");
  EXPECT_EQ(written["alarm_factor"], 1.5);
  EXPECT_EQ(written["noise_factor"], 2.5);
  EXPECT_EQ(written["left_out"],
            json::array({{{"test", "axial"}, {"channel", "stress"}, {"row", 7}, {"residual", 9.5}}}));
  explanation.p_after = 0.01;
  EXPECT_EQ(diagnosis_json(found)["remainder"], "not_clean");
  explanation.claim.best.reset();
  found.analysis.alarm.factor.reset();
  explanation.noise_factor.reset();
  found.analysis.evidence.gross.clear();
  written = diagnosis_json(found);
  for (const char* key : {"extension", "p_after", "remainder", "alarm_factor", "noise_factor", "left_out"})
    EXPECT_FALSE(written.contains(key)) << key;
}

/// The factor of the alarm: at it the rest is still alarming, a twentieth beyond it no more (or it is twenty).
TEST_F(DiagnosisJson, TheAlarmStandsUpToItsFactor) {
  const Alarm& alarm = found.analysis.alarm;
  ASSERT_TRUE(alarm.raised && alarm.factor);
  const auto p_at = [&](double factor) {
    return alarm.detector->test(-found.analysis.evidence.fit.residuals / factor).p;
  };
  EXPECT_GT(*alarm.factor, 1);
  EXPECT_LE(p_at(*alarm.factor), found.request.alpha);
  EXPECT_TRUE(p_at(1.0501 * *alarm.factor) > found.request.alpha || 1.05 * *alarm.factor >= 20) << *alarm.factor;
}

TEST(WarningDetails, HaveAKindAndTheSentence) {
  EXPECT_EQ(
      warning_details({{WarningKind::noise_estimated, "a sentence"}}),
      json::array(
          {{{"kind", "noise_estimated"}, {"run", nullptr}, {"subjects", json::array()}, {"sentence", "a sentence"}}}));
}

}  // namespace
}  // namespace tunica::diagnosis::json_test
