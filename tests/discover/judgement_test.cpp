// SPDX-License-Identifier: Apache-2.0
// The verdict of a discovery on findings that are written down here: what is said where terms, errors of the rig,
// memory and names of the catalogue explain the data more or less well.
#include "discovery/judgement.hpp"

#include <cmath>
#include <set>

#include <gmock/gmock.h>

namespace tunica::discovery::judgement_test {
namespace {

using diagnosis::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

KindPointer kind(const std::string& invariant, const std::string& law, const std::string& family = "") {
  Kind one{invariant, family, law, {}};
  one.name = invariant + "_" + (family.empty() ? "" : family + "_") + law;
  return std::make_shared<const Kind>(one);
}

WeighedSet set(std::vector<KindPointer> kinds, double probability) {
  return {std::move(kinds), std::log(probability), 90};
}

Rival rival(const std::string& id, double probability) {
  Rival one;
  one.id = id;
  one.log_evidence = std::log(probability);
  one.chi2 = 95;
  one.clean = true;
  return one;
}

std::vector<ReasonKind> codes(const Judgement& judgement) {
  std::vector<ReasonKind> all;
  for (const Reason& reason : judgement.reasons) all.push_back(reason.kind);
  return all;
}

/// A linear law of I2, next to certain, takes all that a base leaves beyond noise: |r|² 300 → 100 for 100 rows.
class Judging : public ::testing::Test {
 protected:
  Judging() {
    found.sets = {set({second}, 0.999), set({kind("I2", "quadratic")}, 0.001)};
    found.rows = 100;
    found.chi2_before = 300;
    found.chi2_after = 100;
    found.p_after = 0.5;
  }
  const KindPointer second = kind("I2", "linear"), fibre = kind("fibre", "exponential_square", "axial");
  Findings found;
};

TEST_F(Judging, ASureTermIsDiscovered) {
  const Judgement judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::discovered);
  EXPECT_TRUE(judgement.offers_terms);
  EXPECT_FALSE(judgement.name);
  ASSERT_THAT(codes(judgement), ElementsAre(ReasonKind::terms_found));
  EXPECT_EQ(judgement.reasons.front().text,
            "The energy lacks I2 (linear); it takes 100 % of the misfit beyond noise, |r|² 300.0 → 100.0.");
  ASSERT_THAT(judgement.all, SizeIs(2));
  EXPECT_NEAR(judgement.all[0].probability, 0.999, 1e-12);
  EXPECT_NEAR(judgement.all[1].probability, 0.001, 1e-12);
  EXPECT_EQ(judgement.all[0].chi2, 90);
  ASSERT_THAT(judgement.ambiguity, SizeIs(1));
  EXPECT_NEAR(probability_of(judgement, *second), 0.999, 1e-12);
  EXPECT_NEAR(probability_of_invariant(judgement, *second), 1, 1e-12);
  EXPECT_EQ(probability_of_invariant(judgement, *fibre), 0);
}

/// (before − after)/(before − rows), between nothing and all.
TEST_F(Judging, TheShareIsOfWhatIsLeftBeyondNoise) {
  found.chi2_after = 150;
  EXPECT_THAT(judge(found).reasons.front().text,
              HasSubstr("takes 75 % of the misfit beyond noise, |r|² 300.0 → 150.0"));
  found.chi2_after = 90;
  EXPECT_THAT(judge(found).reasons.front().text, HasSubstr("takes 100 %"));
  found.chi2_after = 310;
  EXPECT_THAT(judge(found).reasons.front().text, HasSubstr("takes 0 %"));
  found.from_nothing = true;
  found.chi2_after = 100;
  EXPECT_EQ(judge(found).reasons.front().text, "The energy is I2 (linear); |r|² is 100.0 for 100 rows.");
}

TEST_F(Judging, WithoutASetThereIsNoTerm) {
  found.sets.clear();
  const Judgement judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::unknown);
  EXPECT_FALSE(judgement.offers_terms);
  EXPECT_THAT(codes(judgement), ElementsAre(ReasonKind::no_term));
}

TEST_F(Judging, DifferencesAtTheSameStrainAreNoEnergy) {
  found.paths = {50, 0.62, 1e-5, true, "loading and unloading in the test 'a'"};
  const Judgement judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::unknown);
  EXPECT_FALSE(judgement.offers_terms);
  ASSERT_THAT(codes(judgement), ElementsAre(ReasonKind::not_an_energy));
  EXPECT_THAT(judgement.reasons.front().text,
              HasSubstr("the data differ between loading and unloading in the test 'a'. That takes 62 % of what"));
  found.paths.share = 0.5;
  EXPECT_EQ(judge(found).verdict, Verdict::discovered) << "not most of it";
  found.paths.share = 0.62;
  found.paths.p_value = 1e-4;
  EXPECT_EQ(judge(found).verdict, Verdict::discovered) << "perhaps chance";
}

TEST_F(Judging, AnErrorOfTheRigThatIsLikelierComesFirst) {
  found.sets.front().log_evidence = std::log(0.2);
  found.rivals = {rival("force_offset", 0.799)};
  Judgement judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::named);
  EXPECT_FALSE(judgement.offers_terms);
  ASSERT_THAT(codes(judgement), ElementsAre(ReasonKind::rig_explains));
  EXPECT_EQ(
      judgement.reasons.front().text,
      "force_offset explains the misfit better than any term of the energy (|r|² 95.0, the best terms leave 100.0). "
      "Correct that first.");
  found.rivals.front().log_evidence = std::log(0.4);
  judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::indistinguishable);
  EXPECT_TRUE(judgement.offers_terms);
  ASSERT_THAT(codes(judgement), ElementsAre(ReasonKind::rig_rival));
  EXPECT_THAT(judgement.reasons.front().text,
              HasSubstr("about as well as a term of the energy: I2 (linear); force_offset"));
  EXPECT_EQ(judgement.all.front().mechanism, "") << "the set that is offered stays first";
  found.rivals.front().log_evidence = std::log(0.06);
  EXPECT_EQ(judge(found).verdict, Verdict::discovered);
}

TEST_F(Judging, WhatIsNotPlausibleIsNoRival) {
  found.rivals = {rival("force_offset", 100)};
  found.rivals.front().plausible = false;
  EXPECT_EQ(judge(found).verdict, Verdict::discovered);
  found.rivals.front().in_the_energy = true;
  EXPECT_FALSE(judge(found).name);
}

/// A name says the same as a term: it stands beside it, and in its place where its evidence is ahead by 3 a specimen.
TEST_F(Judging, ANameOfTheCatalogueStandsForATermWhereItIsAhead) {
  found.sets.pop_back();
  found.rivals = {rival("second_invariant", 0.5), rival("stiffening", 0.1)};
  for (Rival& one : found.rivals) one.in_the_energy = true;
  Judgement judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::discovered);
  ASSERT_TRUE(judgement.name);
  EXPECT_EQ(judgement.name->id, "second_invariant");
  EXPECT_THAT(judgement.all, SizeIs(1)) << "names do not compete";
  found.rivals.front().log_evidence = std::log(0.999) + 2.9;
  EXPECT_EQ(judge(found).verdict, Verdict::discovered);
  found.rivals.front().log_evidence = std::log(0.999) + 3.1;
  judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::named);
  EXPECT_FALSE(judgement.offers_terms);
  ASSERT_THAT(codes(judgement), ElementsAre(ReasonKind::name_explains));
  EXPECT_THAT(judgement.reasons.front().text, HasSubstr("second_invariant leaves |r|² 95.0, the best terms 100.0."));
  found.specimens = 2;
  EXPECT_EQ(judge(found).verdict, Verdict::discovered) << "each specimen asks for 3";
  found.specimens = 1;
  found.rivals.push_back(rival("force_offset", 20));
  EXPECT_EQ(judge(found).verdict, Verdict::named);
  EXPECT_THAT(codes(judge(found)), ElementsAre(ReasonKind::rig_explains)) << "ahead of terms, and not of the rig";
  found.rivals.pop_back();
  found.rivals.front().clean = false;
  EXPECT_EQ(judge(found).verdict, Verdict::discovered);
}

/// Terms that leave more than noise are offered, and nothing is discovered.
TEST_F(Judging, ARestThatIsNotNoiseIsNoDiscovery) {
  found.p_after = 0.001;
  const Judgement judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::unknown);
  EXPECT_TRUE(judgement.offers_terms);
  ASSERT_THAT(codes(judgement), ElementsAre(ReasonKind::not_clean));
  EXPECT_EQ(judgement.reasons.front().text,
            "The best terms, I2 (linear), take 100 % of the misfit beyond noise, and the rest is not noise.");
}

TEST_F(Judging, FormsAndInvariantsThatAreOpenAreListed) {
  found.sets = {set({second}, 0.6), set({kind("I2", "quadratic")}, 0.3), set({fibre}, 0.1)};
  Judgement judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::discovered) << "I2 has 0.9";
  ASSERT_THAT(codes(judgement), ElementsAre(ReasonKind::terms_found, ReasonKind::form_open));
  EXPECT_EQ(
      judgement.reasons.back().text,
      "3 forms are about as likely on these data: I2 (linear); I2 (quadratic); fibre axial (exponential_square).");
  found.sets = {set({second}, 0.6), set({fibre}, 0.4)};
  judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::indistinguishable);
  ASSERT_THAT(codes(judgement), ElementsAre(ReasonKind::terms_found, ReasonKind::invariant_open));
  EXPECT_THAT(judgement.reasons.back().text,
              HasSubstr("do not tell what it is a function of: I2 (linear); fibre axial"));
  found.sets = {set({second, fibre}, 0.6), set({second}, 0.4)};
  judgement = judge(found);
  EXPECT_EQ(judgement.verdict, Verdict::discovered) << "I2 is in both";
  EXPECT_THAT(judgement.reasons.front().text,
              HasSubstr("The energy lacks I2 (linear) and one more term of which the form is open (likeliest fibre "
                        "axial (exponential_square) 0.60); it"));
  EXPECT_THAT(judgement.reasons.back().text, HasSubstr("do not tell all that it is a function of"));
}

/// 92.5 % of the probability, forty at most; four of them in words.
TEST_F(Judging, TheAmbiguitySetHoldsMostOfTheProbability) {
  found.sets = {set({second}, 0.5), set({second}, 0.3), set({second}, 0.13), set({second}, 0.07)};
  EXPECT_THAT(judge(found).ambiguity, SizeIs(3));
  found.sets.assign(60, set({second}, 1));
  EXPECT_THAT(judge(found).ambiguity, SizeIs(40));
  found.sets.assign(5, set({second}, 1));
  EXPECT_EQ(judge(found).reasons.back().text,
            "5 forms are about as likely on these data: I2 (linear); I2 (linear); I2 (linear); I2 (linear); ….");
}

TEST(DiscoveryWordsOfTerms, NameInvariantAndLaw) {
  EXPECT_EQ(words_of({kind("I2", "linear"), kind("fibre", "spline", "diagonal"), kind("stretches", "none")}),
            "I2 (linear) and fibre diagonal (a curve) and stretches (power)");
  EXPECT_EQ(words_of({}), "");
}

TEST(DiscoveryWordsOfTerms, EveryReasonHasACodeOfItsOwn) {
  std::set<std::string> codes;
  for (int k = 0; k <= static_cast<int>(ReasonKind::same_model); ++k) codes.insert(code_of(static_cast<ReasonKind>(k)));
  EXPECT_THAT(codes, SizeIs(16));
}

}  // namespace
}  // namespace tunica::discovery::judgement_test
