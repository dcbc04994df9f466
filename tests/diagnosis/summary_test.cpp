// SPDX-License-Identifier: Apache-2.0
// The page that a person reads, line by line, of diagnoses that are written down here: which sentence goes with what
// was found, and with which figures.
#include <gmock/gmock.h>

#include "diagnosis/measured.hpp"
#include "diagnosis/output/outputs.hpp"

namespace tunica::diagnosis::summary_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two causes and what is around them; tests change one thing of it.
class Summary : public ::testing::Test {
 protected:
  Summary() {
    Analysis& analysis = found.analysis;
    analysis.evidence.fit.residuals = Eigen::VectorXd::Zero(40);
    analysis.evidence.fit.chi2 = 123.46;
    analysis.hypotheses.candidates.resize(7);
    analysis.alarm.detection.p = 0.034;
    found.explanation.reasons = {{ReasonKind::not_clean, "one thing"}, {ReasonKind::no_trace, "another"}};
    claim.causes = {cause("first", 0.7), cause("second", 0.2)};
    claim.causes[1].place.tests = {"strip"};
    claim.ambiguity_set = {"first", "second"};
    claim.named = 1;
  }

  static Cause cause(const std::string& id, double probability) {
    Cause one;
    one.id = id;
    one.probability = probability;
    one.amplitude = {"value", "kPa", 3, 2, 4};
    return one;
  }

  /// The text behind a lead, "" where there is no such line.
  [[nodiscard]] std::vector<std::string> lines(const std::string& lead) const {
    std::vector<std::string> all;
    std::istringstream page(summary(found).plain());
    bool own = false;
    for (std::string line; std::getline(page, line);) {
      const bool begins = !line.empty() && line[0] != ' ';
      if (begins) own = line.starts_with(lead + ":");
      if (!own || line.empty()) continue;
      const std::string text = line.substr(line.find_first_not_of(' ', begins ? lead.size() + 1 : 0));
      if (begins)
        all.push_back(text);
      else
        all.back() += " " + text;
    }
    return all;
  }
  [[nodiscard]] std::string line(const std::string& lead) const {
    const auto all = lines(lead);
    EXPECT_LE(all.size(), 1u);
    return all.empty() ? "" : all.front();
  }

  Diagnosis found;
  Claim& claim = found.explanation.claim;
};

TEST_F(Summary, SaysHowOftenNoiseAloneLooksLikeThis) {
  Alarm& alarm = found.analysis.alarm;
  EXPECT_EQ(line("Alarm"), "noise alone would look like this with p = 0.034 (40 values, |r|² = 123.5, 7 mechanisms)");
  alarm.detection.p = 1e-4;
  EXPECT_THAT(line("Alarm"), HasSubstr("with p = 0.0001 ("));
  alarm.detection.p = 9e-5;
  EXPECT_THAT(line("Alarm"), HasSubstr("with p < 0.0001 ("));
  alarm.factor = 1.524;
  EXPECT_THAT(line("Alarm"), HasSubstr("); the alarm holds even with 1.52 times the noise"));
  alarm.factor = 19;
  EXPECT_THAT(line("Alarm"), HasSubstr("); the alarm holds even with more than 19 times the noise"));
}

/// A thousand refits tell no smaller p apart than about one in a thousand.
TEST_F(Summary, SaysOfRefitsWhatTheyCanTellApart) {
  Alarm& alarm = found.analysis.alarm;
  const auto words = [&](double refits, double linear) {
    alarm.p_refits = refits;
    alarm.detection.p = linear;
    return line("Alarm");
  };
  EXPECT_THAT(words(5e-4, 1e-6), HasSubstr("with p ≤ 0.0005 ("));
  EXPECT_THAT(words(1e-4, 1e-6), HasSubstr("with p ≤ 0.0001 ("));
  EXPECT_THAT(words(1e-3, 1e-6), HasSubstr("with p = 0.001 ("));
  EXPECT_THAT(words(5e-4, 5e-4), HasSubstr("with p = 0.0005 ("));
  EXPECT_THAT(words(5e-5, 1e-6), HasSubstr("with p < 0.0001 ("));
}

TEST_F(Summary, BeginsWithTheVerdict) {
  Explanation& explanation = found.explanation;
  EXPECT_EQ(line("Verdict"), "NOTHING DETECTED: the model describes these data to within their noise");
  explanation.verdict = Verdict::suspect_data;
  EXPECT_EQ(line("Verdict"), "SUSPECT DATA: one thing; another");
  explanation.verdict = Verdict::discovered;
  EXPECT_EQ(line("Verdict"), "DISCOVERED: one thing; another");
  explanation.verdict = Verdict::unknown;
  EXPECT_EQ(line("Verdict"), "UNKNOWN: one thing; another");
  explanation.verdict = Verdict::named;
  EXPECT_EQ(line("Verdict"), "NAMED: consistent with first");
  claim.named = 2;
  EXPECT_EQ(line("Verdict"), "NAMED: consistent with first and second");
  explanation.verdict = Verdict::indistinguishable;
  claim.alternatives = {{"third", "fourth"}};
  EXPECT_EQ(line("Verdict"),
            "INDISTINGUISHABLE: first with second, third with fourth explain the misfit about equally well; one thing; "
            "another");
  explanation.unlisted = true;
  EXPECT_EQ(line("Verdict"),
            "INDISTINGUISHABLE: first and second together, or one effect that the catalogue does not list");
  claim.ambiguity_set.emplace_back("third");
  EXPECT_THAT(line("Verdict"), HasSubstr("explain the misfit about equally well"));
}

TEST_F(Summary, NamesRowsThatAreLeftOutBesideTheCauses) {
  found.explanation.verdict = Verdict::named;
  found.explanation.left_out = {cause("outliers", 0)};
  found.explanation.left_out.front().place = {{"strip"}, "stress", 11, "", 12};
  EXPECT_EQ(line("Verdict"),
            "NAMED: consistent with first and outliers in the channel 'stress' of the test 'strip', row 12");
  ASSERT_EQ(lines("Cause").size(), 2u);
  EXPECT_THAT(lines("Cause").back(), HasSubstr("outliers in the channel 'stress' of the test 'strip', row 12"));
}

/// A remedy of lost stability is all there is where the curves raise no alarm.
TEST_F(Summary, SaysWhatRestoresStability) {
  found.explanation.verdict = Verdict::named;
  EXPECT_EQ(line("Material"), "");
  found.explanation.admissibility = {false, "transverse stability at 1.3", "first", {}};
  EXPECT_EQ(line("Material"), "the base fit loses transverse stability at 1.3; first restores it");
  EXPECT_EQ(line("Verdict"), "NAMED: consistent with first");
  found.analysis.alarm.detection.p = found.request.alpha;
  EXPECT_EQ(line("Verdict"), "NAMED: consistent with first");
  found.analysis.alarm.detection.p = 0.06;
  EXPECT_EQ(line("Verdict"), "NAMED: first restores the stability that the base fit loses; the curves raise no alarm");
  found.explanation.admissibility.remedy.clear();
  EXPECT_EQ(line("Material"), "the base fit loses transverse stability at 1.3");
  EXPECT_EQ(line("Verdict"), "NAMED: consistent with first");
  found.explanation.admissibility.stable = true;
  EXPECT_EQ(line("Material"), "");
}

TEST_F(Summary, ShowsTheTwoWorstCurves) {
  found.explanation.misfit = {
      {"a", "stress", "here", 0, 0, 0}, {"b", "force", "there", 0, 0, 0}, {"c", "", "", 0, 0, 0}};
  EXPECT_EQ(line("Wrong"), "") << "nothing is";
  found.explanation.verdict = Verdict::unknown;
  EXPECT_EQ(line("Wrong"), "a, stress: here; b, force: there");
  found.explanation.misfit.resize(1);
  EXPECT_EQ(line("Wrong"), "a, stress: here");
}

TEST_F(Summary, SaysOfACauseWhereAndHowMuchItIs) {
  found.explanation.verdict = Verdict::named;
  EXPECT_THAT(lines("Cause"), ElementsAre("first in the material, value = 3 kPa (2 … 4); probability 0.70"));
  claim.named = 2;
  ASSERT_EQ(lines("Cause").size(), 2u);
  EXPECT_EQ(lines("Cause")[1], "second in the test 'strip' (of the specimen), value = 3 kPa (2 … 4); probability 0.20");
  claim.causes[1].group = CauseGroup::rig;
  claim.causes[1].amplitude = {"value", "1", 0.12346, -INFINITY, INFINITY};
  EXPECT_EQ(lines("Cause")[1], "second in the test 'strip' (of the rig), value = 0.123; probability 0.20");
  claim.causes[1].amplitude.unit = "";
  EXPECT_EQ(lines("Cause")[1], "second in the test 'strip' (of the rig), value = 0.123; probability 0.20");
}

TEST_F(Summary, ListsFourRivalsAndCountsTheRest) {
  found.explanation.verdict = Verdict::named;
  claim.causes.resize(1);
  EXPECT_EQ(line("Or else"), "no other mechanism of the catalogue comes close");
  for (const char* id : {"b", "c", "d", "e"}) claim.causes.push_back(cause(id, 0.1));
  claim.causes[1].group = claim.causes[3].group = CauseGroup::rig;
  EXPECT_EQ(line("Or else"), "in the material: c (0.10), e (0.10); in the rig: b (0.10), d (0.10)");
  claim.causes.push_back(cause("f", 0.1));
  claim.causes.push_back(cause("g", 0.1));
  EXPECT_THAT(line("Or else"), AllOf(HasSubstr("; and 2 more"), Not(HasSubstr("f ("))));
  found.explanation.unlisted = true;
  EXPECT_THAT(line("Or else"), HasSubstr("; and 2 more, an effect that the catalogue does not list: another"));
  claim.causes.clear();
  claim.named = 0;
  EXPECT_EQ(line("Or else"), "");
}

TEST_F(Summary, ListsWhatRivalsAPair) {
  found.explanation.verdict = Verdict::named;
  claim.named = 2;
  EXPECT_EQ(line("Or else"), "no other mechanism of the catalogue comes close");
  claim.alternatives = {{"a", "b"}, {"c"}, {"d", "e"}, {"f", "g"}};
  EXPECT_EQ(line("Or else"), "a with b, c alone, d with e, f with g");
  claim.doubted = {{"c"}, {"d", "e"}};
  EXPECT_EQ(line("Or else"), "a with b, c alone (beyond belief), d with e (beyond belief), f with g");
  claim.doubted.clear();
  claim.alternatives.push_back({"h", "i"});
  claim.alternatives.push_back({"j", "k"});
  EXPECT_EQ(line("Or else"), "a with b, c alone, d with e, f with g, and 2 more");
}

TEST_F(Summary, WordsAnAmbiguitySetByWhatLooksAlike) {
  EXPECT_THAT(explanations(claim), ElementsAre("first", "second"));
  claim.look_alikes = {{"first", "third", "fourth"}, {"second"}};
  EXPECT_THAT(explanations(claim), ElementsAre("first (or third, fourth, much the same here)", "second"));
  claim.doubted = {{"second"}, {"fourth"}};
  EXPECT_THAT(explanations(claim),
              ElementsAre("first (or third, fourth (beyond belief), much the same here)", "second (beyond belief)"));
  claim.in_words = {"first in the test 'a'", "first in the test 'b'"};
  EXPECT_THAT(explanations(claim), ElementsAre("first in the test 'a'", "first in the test 'b'"));
}

/// Of blocks it names the one that falls most among those that are predicted, and the furthest of those that are not.
TEST_F(Summary, SaysWhatIsGainedInAndOutOfSample) {
  EXPECT_EQ(line("Gain"), "");
  found.prospects.gain = Gain{100.04, 40, 3.21, {}, {}};
  EXPECT_EQ(line("Gain"), "|r|² 100.0 → 40.0 (fitted to noise, it would lower it by about 3.2)");
  claim.named = 2;
  EXPECT_EQ(line("Gain"), "|r|² 100.0 → 40.0 (fitted to noise, one mechanism would lower it by about 3.2)");
  using enum BlockVerdict;
  found.prospects.gain->held_out = {{"B", 8, 6, 0.5, 9, predicted},
                                    {"A", 5, 1, 0.5, 9, predicted},
                                    {"F", 6, 3.5, 0.5, 9, predicted},
                                    {"C", 9, 2.5, 0, 9, not_predicted},
                                    {"D", 12.34, 1241.4, 0, 9, not_predicted},
                                    {"G", 9, 3, 0, 9, not_predicted},
                                    {"E", 9, 0, 0.5, 9, inconclusive},
                                    {"H", 1, 9e9, 0.5, 9, inconclusive}};
  found.prospects.gain->best_rejected = Rejected{"geometry_error", 55.04};
  EXPECT_EQ(
      line("Gain"),
      "|r|² 100.0 → 40.0 (fitted to noise, one mechanism would lower it by about 3.2); predicts A, which it has not "
      "seen: "
      "error 5.00 → 1.00 σ; does not predict D: error 12.3 → 1241 σ; the best rejected alternative, geometry_error, "
      "leaves 55.0");
  found.prospects.gain->held_out = {{"A", 10, 100, 0.5, 9, not_predicted}};
  EXPECT_THAT(line("Gain"), HasSubstr("does not predict A: error 10.0 → 100 σ"));
}

TEST_F(Summary, SaysWhatToMeasureNext) {
  EXPECT_EQ(line("Next"), "");
  found.prospects.next = NextExperiment{"a second strip", {}, {}};
  EXPECT_EQ(line("Next"), "a second strip");
}

/// Only amplitudes that are large: beyond three tenths of what is plausible.
TEST_F(Summary, SaysWhatCouldHide) {
  const auto one = [](const char* id, double detectable, double null, bool one_sided, const char* unit = "kPa") {
    Detectable large;
    large.id = id;
    large.unit = unit;
    large.detectable = detectable;
    large.null = null;
    large.one_sided = one_sided;
    large.reach = 1;
    return large;
  };
  EXPECT_EQ(line("May hide"), "");
  auto& all = found.prospects.detectable;
  all = {one("a", 0.5, 0, false), one("b", 0.5, 0, true), one("c", 0.4, 1, true, "1"),
         one("d", 0.4, 1, false), one("e", 1, 0, false),  one("f", 0.3, 0, false)};
  EXPECT_EQ(line("May hide"),
            "a within ± 0.5 kPa, b below 0.5 kPa, c from 1 to 1.4, d within 1 ± 0.4 kPa, e at any plausible amplitude");
  const std::vector<std::pair<Absence, bool>> absences{{Absence::no_trace, true},   {Absence::absorbed, true},
                                                       {Absence::no_clock, true},   {Absence::already_there, false},
                                                       {Absence::no_place, false},  {Absence::not_applicable, false},
                                                       {Absence::isotropic, false}, {Absence::no_past, true}};
  for (const auto& [absence, shown] : absences) {
    all = {one("x", 0, 0, false)};
    all.front().absent = "a reason";
    all.front().absence = absence;
    EXPECT_EQ(line("May hide"), shown ? "no trace in these data: x" : "") << code_of(absence);
  }
  all = {one("a", 0.5, 0, false), one("x", 0, 0, false), one("y", 0, 0, false)};
  all[1].absent = all[2].absent = "a reason";
  EXPECT_EQ(line("May hide"), "a within ± 0.5 kPa; no trace in these data: x, y");
  found.explanation.verdict = Verdict::unknown;
  EXPECT_EQ(line("May hide"), "") << "said where nothing is wrong";
}

}  // namespace
}  // namespace tunica::diagnosis::summary_test
