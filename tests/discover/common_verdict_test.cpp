// SPDX-License-Identifier: Apache-2.0
// The verdict of several specimens: what each says of the terms, who is needed, and what is left.
#include "discovery/common/common_verdict.hpp"

#include <memory>
#include <numeric>

#include <gmock/gmock.h>

#include "discover/made_up_terms.hpp"

namespace tunica::discovery::common_verdict_test {
namespace {

using diagnosis::Verdict;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using trial::in_blocks;
using trial::MadeUpTerms;

using Levels = std::vector<double>;

/// Specimens of which the rows of three blocks show these levels; a acts in the first block, b in the second, "wide" in
/// both. The base is nothing at all.
class Specimens {
 public:
  explicit Specimens(const std::vector<Levels>& levels, const std::vector<Levels>& back = {}) {
    found.request.from_nothing = true;
    for (std::size_t s = 0; s < levels.size(); ++s) {
      const MadeUpTerms& one = *terms.emplace_back(
          std::make_unique<MadeUpTerms>(levels[s],
                                        std::map<std::string, trial::MadeUpLaw>{
                                            {"a", in_blocks({0})}, {"b", in_blocks({1})}, {"wide", in_blocks({0, 1})}},
                                        trial::Measuring{.back = back.empty() ? Levels{} : back[s]}));
      fitters.push_back(one.fitter.get());
      kinds.push_back({one.kind("a", "a"), one.kind("b", "b"), one.kind("wide", "wide", 0, "I1", "a")});
      SpecimenOutcome outcome{"S" + std::to_string(s + 1), {}, one.subject};
      outcome.analysis.evidence = one.evidence;
      outcome.analysis.evidence.fit = one.fitter->root().fit;
      const Eigen::Index n = one.evidence.fit.residuals.size();
      outcome.analysis.alarm.shapes.columns.resize(n, 0);
      outcome.analysis.alarm.draws.residuals = Eigen::MatrixXf::Zero(n, 100);
      found.rows += static_cast<std::size_t>(n);
      found.chi2_before += one.fitter->root().chi2();
      found.specimens.push_back(std::move(outcome));
    }
    fitter = std::make_unique<const CommonFitter>(fitters, kinds, true);
  }

  /// Of these kinds, grown one after the other.
  [[nodiscard]] CommonFit grown(const std::vector<std::size_t>& which) const {
    CommonFit set = fitter->root();
    for (const std::size_t k : which) set = fitter->grown(set, kinds[0][k], -INFINITY).value();
    return set;
  }
  /// As if each specimen said this much more of the set than of the base.
  [[nodiscard]] CommonFit saying(CommonFit set, const std::vector<double>& gains) const {
    for (std::size_t s = 0; s < gains.size(); ++s)
      set.specimens[s].log_evidence =
          data_evidence(fitter->root().specimens[s], true) + gains[s] + log_prior(set.specimens[s].kinds, true);
    std::vector<std::size_t> all(gains.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    set.log_evidence = fitter->log_evidence(set, all);
    return set;
  }
  void settle(const std::vector<CommonFit>& sets) { discovery::settle(found, *fitter, sets); }

  std::vector<std::unique_ptr<MadeUpTerms>> terms;
  std::vector<const Fitter*> fitters;
  std::vector<std::vector<KindPointer>> kinds;
  std::unique_ptr<const CommonFitter> fitter;
  CommonDiscovery found;
};

/// The sentence of a reason; empty without it.
std::string said(const CommonDiscovery& found, ReasonKind kind) {
  for (const Reason& reason : found.judgement.reasons)
    if (reason.kind == kind) return reason.text;
  return {};
}

/// a shows in all, b in two of three.
TEST(VerdictOfSpecimens, SaysWhatEachSpecimenHas) {
  Specimens three({{4, 3, 0}, {5, 0, 0}, {6, 2, 0.5}});
  const CommonFit both = three.grown({0, 1}), one = three.grown({0});
  three.settle({both, one});
  const CommonDiscovery& found = three.found;
  EXPECT_EQ(found.judgement.verdict, Verdict::discovered);
  ASSERT_TRUE(found.best);
  EXPECT_EQ(found.best->log_evidence, both.log_evidence);
  EXPECT_NEAR(found.chi2_after, 2.5, 1e-6);
  EXPECT_EQ(found.p_after, 1);
  EXPECT_THAT(said(found, ReasonKind::terms_found), HasSubstr("|r|² is 2.5 for 90 rows"));
  ASSERT_THAT(found.terms, SizeIs(2));
  const Levels of_a{4, 5, 6}, of_b{3, 0, 2}, left{0, 0, 2.5};
  for (std::size_t s = 0; s < 3; ++s) {
    ASSERT_TRUE(found.terms[0].specimens[s]);
    EXPECT_NEAR(found.terms[0].specimens[s]->parameters.front().value, of_a[s], 1e-6);
    EXPECT_NEAR(found.terms[0].specimens[s]->curve.slope.at(30), of_a[s], 1e-6);
    EXPECT_EQ(found.terms[1].specimens[s].has_value(), s != 1);
    if (s != 1) {
      EXPECT_NEAR(found.terms[1].specimens[s]->parameters.front().value, of_b[s], 1e-6);
      EXPECT_NEAR(found.terms[1].specimens[s]->curve.slope.at(30), of_b[s], 1e-6);
    }
    const SpecimenOutcome& outcome = found.specimens[s];
    EXPECT_NEAR(outcome.chi2_after, left[s], 1e-6);
    EXPECT_EQ(outcome.p_after, 1);
    EXPECT_NEAR(outcome.gain,
                data_evidence(both.specimens[s], true) + 5 * (of_a[s] * of_a[s] + of_b[s] * of_b[s]) + left[s] / 2,
                1e-6);
    EXPECT_FALSE(outcome.needed);
  }
  EXPECT_EQ(found.terms[0].name, "a");
  EXPECT_EQ(found.terms[1].name, "b");
  EXPECT_EQ(found.terms[1].kind, both.kinds[1]);
  EXPECT_EQ(found.terms[0].seen(), 3U);
  EXPECT_EQ(found.terms[1].seen(), 2U);
  EXPECT_NEAR(found.terms[0].probability, 1, 1e-12);
  EXPECT_EQ(found.terms[1].probability, probability_of(found.judgement, *both.kinds[1]));
  EXPECT_EQ(found.terms[1].invariant_probability, probability_of_invariant(found.judgement, *both.kinds[1]));
  const std::string agree = said(found, ReasonKind::specimens_agree);
  EXPECT_THAT(agree, HasSubstr("I1 a (a) shows in 3 of 3 specimens; I1 b (b) shows in 2 of 3 specimens. "));
  EXPECT_THAT(agree, HasSubstr("Whichever specimen is left out"));
  EXPECT_EQ(said(found, ReasonKind::specimens_left_over), "");
}

/// Without the second specimen, or without the third, b explains more than a; without the first a stays ahead.
TEST(VerdictOfSpecimens, SaysWhoIsNeeded) {
  Specimens three({{4, 3, 0}, {4, 3, 0}, {4, 3, 0}});
  const CommonFit a = three.saying(three.grown({0}), {10, 30, 30}), b = three.saying(three.grown({1}), {20, 22, 22});
  ASSERT_GT(a.log_evidence, b.log_evidence);
  three.settle({a, b});
  EXPECT_FALSE(three.found.specimens[0].needed);
  EXPECT_TRUE(three.found.specimens[1].needed);
  EXPECT_TRUE(three.found.specimens[2].needed);
  EXPECT_THAT(said(three.found, ReasonKind::specimens_agree),
              HasSubstr("The others choose other invariants without S2, S3"));
  EXPECT_NEAR(three.found.specimens[1].gain, 30, 1e-9);
}

/// Another law of the same invariant is no other choice.
TEST(VerdictOfSpecimens, AsksForInvariantsAndNotForLaws) {
  Specimens three({{4, 4, 0}, {4, 4, 0}, {4, 4, 0}});
  three.settle({three.saying(three.grown({0}), {10, 30, 30}), three.saying(three.grown({2}), {20, 22, 22})});
  for (const SpecimenOutcome& one : three.found.specimens) EXPECT_FALSE(one.needed) << one.id;
  ASSERT_THAT(three.found.terms, SizeIs(1));
  EXPECT_GT(three.found.terms[0].invariant_probability, three.found.terms[0].probability);
}

/// Whichever of three it is; of two it is half.
TEST(VerdictOfSpecimens, HasNoTermsThatASingleSpecimenAsksFor) {
  for (std::size_t odd = 0; odd < 3; ++odd) {
    Specimens three({{4, 3, 0}, {4, 3, 0}, {4, 3, 0}});
    std::vector<double> gains{-1, -1, -1};
    gains[odd] = 100;
    const CommonFit of_one = three.saying(three.grown({0}), gains), of_all = three.saying(three.grown({1}), {9, 9, 9});
    three.settle({of_one});
    EXPECT_FALSE(three.found.best) << odd;
    EXPECT_THAT(three.found.terms, IsEmpty());
    EXPECT_THAT(said(three.found, ReasonKind::no_term), HasSubstr("single specimens only"));
    EXPECT_EQ(three.found.specimens[odd].gain, 0);
    EXPECT_NEAR(three.found.specimens[odd].chi2_after, 10 * (16 + 9), 1e-9) << "of the base";
    Specimens again({{4, 3, 0}, {4, 3, 0}, {4, 3, 0}});
    again.settle({of_one, of_all});
    ASSERT_TRUE(again.found.best);
    EXPECT_EQ(again.found.best->kinds[0]->name, "b") << odd;
  }
  Specimens two({{4, 3, 0}, {4, 3, 0}});
  two.settle({two.saying(two.grown({0}), {100, -1})});
  ASSERT_THAT(two.found.terms, SizeIs(1));
  EXPECT_THAT(said(two.found, ReasonKind::specimens_agree), HasSubstr("shows in 2 of 2 specimens"));
}

TEST(VerdictOfSpecimens, SaysThatNothingHelped) {
  Specimens one({{0, 0, 0}}), two({{0, 0, 0}, {0, 0, 0}});
  one.settle({});
  two.settle({});
  EXPECT_EQ(said(one.found, ReasonKind::no_term), "No term of the energy makes the fit better.");
  EXPECT_THAT(said(two.found, ReasonKind::no_term), HasSubstr("half of the specimens"));
  EXPECT_THAT(two.found.terms, IsEmpty());
}

/// Nobody agrees with a single specimen.
TEST(VerdictOfSpecimens, OfOneSaysNothingOfOthers) {
  Specimens one({{4, 0, 5}});
  one.settle({one.grown({0})});
  EXPECT_EQ(one.found.judgement.verdict, Verdict::unknown) << "the rest is not noise";
  ASSERT_THAT(one.found.terms, SizeIs(1));
  EXPECT_EQ(said(one.found, ReasonKind::specimens_agree), "");
  EXPECT_EQ(said(one.found, ReasonKind::specimens_left_over), "");
  // 160 of the 410 − 30 beyond noise.
  EXPECT_THAT(said(one.found, ReasonKind::not_clean), HasSubstr("take 42 % of the misfit"));
}

/// Six are named, and the others counted.
TEST(VerdictOfSpecimens, SaysInWhomMoreThanNoiseIsLeft) {
  Specimens six(std::vector<Levels>(6, {4, 0, 5}));
  six.settle({six.grown({0})});
  EXPECT_THAT(said(six.found, ReasonKind::specimens_left_over), HasSubstr("not noise in S1, S2, S3, S4, S5, S6."));
  EXPECT_LT(six.found.p_after, 1e-6);
  Specimens two(std::vector<Levels>(2, {4, 0, 5}));
  two.settle({two.grown({0})});
  EXPECT_THAT(said(two.found, ReasonKind::specimens_left_over), HasSubstr("not noise in S1, S2."));
  std::vector<Levels> eight(8, {4, 0, 5});
  eight.push_back({4, 0, 0});
  Specimens nine(eight);
  nine.settle({nine.grown({0})});
  EXPECT_THAT(said(nine.found, ReasonKind::specimens_left_over),
              HasSubstr("not noise in S1, S2, S3, S4, S5, S6 and 2 more."));
  EXPECT_LT(nine.found.specimens[0].p_after, 1e-6);
  EXPECT_EQ(nine.found.specimens[8].p_after, 1);
}

/// A mechanism has to be ahead of terms by so much of the evidence in every specimen.
TEST(VerdictOfSpecimens, NamesWhatIsAheadInEverySpecimen) {
  for (const double ahead : {8.0, 10.0}) {
    Specimens three(std::vector<Levels>(3, {4, 0, 0}));
    const CommonFit set = three.grown({0});
    Rival rival;
    rival.id = "stiffening";
    rival.in_the_energy = rival.clean = true;
    rival.log_evidence = set.log_evidence + ahead;
    three.found.rivals = {rival};
    three.settle({set});
    EXPECT_EQ(three.found.judgement.verdict, ahead < 9 ? Verdict::discovered : Verdict::named);
  }
}

/// A second and a third term of one kind; the second specimen has two of them.
TEST(VerdictOfSpecimens, TellsCopiesOfATermApart) {
  Specimens two({{6, 0, 0}, {6, 0, 0}});
  const auto copies = [&](std::size_t s, std::size_t count) {
    return std::vector<KindPointer>(count, two.kinds[s][0]);
  };
  CommonFit set{copies(0, 3), {two.terms[0]->at(copies(0, 3), {1, 2, 3}), two.terms[1]->at(copies(1, 2), {4, 2})}};
  two.settle({two.saying(set, {50, 50})});
  const std::vector<CommonTerm>& terms = two.found.terms;
  ASSERT_THAT(terms, SizeIs(3));
  EXPECT_EQ(terms[0].name, "a");
  EXPECT_EQ(terms[1].name, "a_2");
  EXPECT_EQ(terms[2].name, "a_3");
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_TRUE(terms[k].specimens[0]);
    EXPECT_EQ(terms[k].specimens[0]->parameters.front().value, std::vector<double>({1, 2, 3})[k]);
  }
  ASSERT_TRUE(terms[0].specimens[1] && terms[1].specimens[1]);
  EXPECT_EQ(terms[0].specimens[1]->parameters.front().value, 4);
  EXPECT_EQ(terms[1].specimens[1]->parameters.front().value, 2);
  EXPECT_FALSE(terms[2].specimens[1]);
}

/// A specimen in which no term shows has no energy at all, and none of the terms.
TEST(VerdictOfSpecimens, HasNoTermWhereNoneShows) {
  Specimens three({{4, 0, 0}, {0, 0, 0}, {5, 0, 0}});
  three.settle({three.grown({0})});
  ASSERT_THAT(three.found.terms, SizeIs(1));
  EXPECT_EQ(three.found.terms[0].seen(), 2U);
  EXPECT_FALSE(three.found.terms[0].specimens[1]);
  EXPECT_EQ(three.found.specimens[1].gain, 0);
}

/// Specimens that show ±half on the way there and back, and what no smooth shape has on both.
Specimens there_and_back(const std::vector<std::pair<double, double>>& half_and_rough) {
  std::vector<Levels> there, back;
  for (const auto& [half, rough] : half_and_rough) {
    Levels up, down;
    for (int block = 0; block < 12; ++block) {
      const double jagged = block % 2 == 0 ? rough : -rough;
      up.push_back(jagged + half);
      down.push_back(jagged - half);
    }
    there.push_back(up);
    back.push_back(down);
  }
  return Specimens(there, back);
}

/// In more than half of the specimens; of these the one in the middle is shown, by the share that history takes.
TEST(VerdictOfSpecimens, LeavesToHistoryWhatMostSpecimensShow) {
  Specimens most = there_and_back({{3, 0.9}, {3, 0.6}, {3, 1.6}, {0, 0.5}, {3, 1.3}});
  most.settle({});
  std::vector<double> shares;
  for (std::size_t s = 0; s < 5; ++s) {
    const PathDependence own =
        path_dependence(most.found.specimens[s].analysis.evidence, most.fitter->root().specimens[s].fit);
    ASSERT_EQ(own.decides(), s != 3) << s;
    shares.push_back(own.share);
  }
  EXPECT_GT(shares[1], shares[0]);
  EXPECT_GT(shares[0], shares[4]);
  EXPECT_GT(shares[4], shares[2]);
  EXPECT_EQ(most.found.paths.share, shares[0]);
  EXPECT_THAT(most.found.paths.where, HasSubstr("in the test 'a' (so in 4 of 5 specimens)"));
  EXPECT_EQ(most.found.judgement.verdict, Verdict::unknown);
  EXPECT_THAT(said(most.found, ReasonKind::not_an_energy), HasSubstr("so in 4 of 5 specimens"));

  Specimens three_of_four = there_and_back({{3, 0.6}, {3, 0.9}, {3, 1.3}, {0, 0.5}});
  three_of_four.settle({});
  EXPECT_TRUE(three_of_four.found.paths.decides());
  Specimens half = there_and_back({{3, 0.6}, {3, 0.9}, {0, 0.5}, {0, 0.5}});
  half.settle({});
  EXPECT_FALSE(half.found.paths.decides());
  EXPECT_EQ(said(half.found, ReasonKind::not_an_energy), "");
}

TEST(VerdictOfSpecimens, SaysThatNothingIsMissing) {
  Specimens three(std::vector<Levels>(3, {0, 0, 0}));
  three.found.p_before = 0.42;
  say_nothing_is_missing(three.found);
  EXPECT_EQ(three.found.judgement.verdict, Verdict::nothing_detected);
  ASSERT_THAT(three.found.judgement.reasons, SizeIs(1));
  EXPECT_THAT(said(three.found, ReasonKind::residuals_like_noise), HasSubstr("3 specimens could be noise (p = 0.42)"));
}

}  // namespace
}  // namespace tunica::discovery::common_verdict_test
