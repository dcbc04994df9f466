// SPDX-License-Identifier: Apache-2.0
// Which explanation is chosen: one mechanism or several, on data of which every gain is a sum of squares.
#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/contested.hpp"
#include "diagnosis/naming/remainder.hpp"

namespace tunica::diagnosis::naming_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Optional;
using ::testing::SizeIs;
using Side = MechanismFactory::Side;

double root(double square) { return std::sqrt(square); }

TEST(Naming, IsOfOneMechanismThatIsEnough) {
  Contested causes({10});
  const Explanation found = causes.with_rows(3).settled().named();
  EXPECT_EQ(found.verdict, Verdict::named);
  EXPECT_EQ(named_in(found.claim), "m0");
  EXPECT_GT(found.p_after, 0.5) << "nothing is left";
  EXPECT_THAT(found.reasons, IsEmpty());
  EXPECT_FALSE(found.unlisted);
  EXPECT_EQ(found.noise_factor, std::nullopt);
}

// "steep" shows what the data show, but only with ten times the amplitude that is plausible; "plain" leaves noise too.
TEST(Naming, PrefersAPlausibleCauseThatLeavesNoiseToAnImplausibleOne) {
  const auto named = [](bool with_plain) {
    Contested causes({10});
    MadeUp steep = Contested::shaped("steep", {1});
    steep.declare = [](MechanismFactory& factory) {
      factory.plausible_min = -1;
      factory.plausible_max = 1;
    };
    causes.add(std::move(steep));
    if (with_plain) causes.add(Contested::shaped("plain", {1, 0.1}));
    return causes.settled().named();
  };
  const Explanation both = named(true);
  EXPECT_EQ(both.verdict, Verdict::named);
  EXPECT_THAT(both.claim.ambiguity_set, ElementsAre("plain")) << "no tie with what nobody would believe";
  const Explanation alone = named(false);
  EXPECT_EQ(alone.verdict, Verdict::suspect_data);
  EXPECT_EQ(named_in(alone.claim), "steep");
}

// A tenth as likely before the data: a second mechanism has to gain 2 ln 10 = 4.6 where the first leaves noise.
TEST(Naming, IsOfTwoOnlyWhereTheSecondIsWorthItsPrice) {
  EXPECT_EQ(named_in(Contested({10, root(4.3)}).with_rows(3).settled(false).named().claim), "m0");
  EXPECT_EQ(named_in(Contested({10, root(4.9)}).with_rows(3).settled(false).named().claim), "m0 m1");
}

TEST(Naming, IsOfAsManyAsLeaveNoise) {
  const Explanation two = Contested({10, 8}).with_rows(4).settled().named();
  EXPECT_EQ(named_in(two.claim), "m0 m1");
  EXPECT_EQ(two.verdict, Verdict::named);
  EXPECT_GT(two.p_after, 0.5);
  const Explanation three = Contested({10, 8, 6}).with_rows(4).settled().named();
  EXPECT_EQ(named_in(three.claim), "m0 m1 m2");
  EXPECT_EQ(three.verdict, Verdict::named);
  EXPECT_GT(three.p_after, 0.5);
}

// Something is left that no mechanism explains. Then one is worth more that takes 80 % of what is beyond noise:
// the degrees of freedom, 12, of |r|².
TEST(Naming, OfWhatIsNotAllPrefersOneThatTakesMostOfIt) {
  const auto named = [](double first, double second, double rest) {
    return Contested({root(first), root(second)}, root(rest)).with_rows(3).settled().named();
  };
  EXPECT_EQ(named_in(named(300, 30, 30).claim), "m0");
  EXPECT_EQ(named_in(named(100, 50, 60).claim), "m0 m1");
  EXPECT_EQ(named_in(named(160, 20, 25).claim), "m0") << "160 > 0.8 (205 - 12)";
  EXPECT_EQ(named_in(named(152, 28, 25).claim), "m0 m1") << "152 < 0.8 (205 - 12)";
  for (const Explanation& found : {named(300, 30, 30), named(100, 50, 60)}) {
    EXPECT_EQ(found.verdict, Verdict::unknown);
    EXPECT_LT(found.p_after, 1e-4);
    EXPECT_EQ(found.reasons.front().kind, ReasonKind::not_clean);
  }
}

// The first takes 100, less than half of 260 - 12. Nothing cheaper stands in for the test, so that no budget asks
// again.
TEST(Naming, OfACostlyTestTriesSeveralWhereNoBudgetAsksOfThem) {
  for (const bool discovers : {true, false}) {
    Contested causes({10, 10}, root(60));
    causes.experiment.tests.front().type = "costly_curve";
    causes.request.model = causes.model().name;
    causes.request.discovers = discovers;
    causes.with_rows(3).settled();
    ASSERT_TRUE(causes.analysis.evidence.base->layout().has_costly_tests);
    EXPECT_EQ(named_in(causes.named().claim), "m0 m1") << discovers;
  }
}

TEST(Naming, PrefersSeveralThatLeaveNoiseToOneThatTakesMost) {
  const Explanation found = Contested({root(300), root(30), root(30)}).with_rows(3).settled().named();
  EXPECT_EQ(named_in(found.claim), "m0 m1 m2");
  EXPECT_GT(found.p_after, 0.01);
}

/// The p-value of residuals that show nothing but so much of the smooth shape, and of m1.
double p_of(double shown, double unlisted) {
  Contested causes({0, shown}, unlisted);
  causes.with_rows(3).settled();
  const Refit nothing{{}, {}, causes.analysis.evidence.fit};
  return p_of_remainder(causes.analysis, nothing);
}

TEST(Naming, TestsWhatTheChosenExplanationLeaves) {
  const double two = Contested({10, root(50)}, root(20)).with_rows(3).settled().named().p_after;
  const double one = Contested({root(500), root(40)}, root(20)).with_rows(3).settled().named().p_after;
  const double of_two = p_of(0, root(20)), of_one = p_of(root(40), root(20));
  EXPECT_LT(of_one, of_two / 10);
  // Those that explain are not asked for any more, which makes the others weigh more.
  EXPECT_NEAR(two, of_two, 0.5 * of_two);
  EXPECT_NEAR(one, of_one, 0.5 * of_one);
}

TEST(Naming, OfWhatIsNotAllPrefersWhatIsLikelier) {
  const auto named = [](std::size_t mechanisms, double second, double third) {
    return named_in(
        Contested({10, root(second), root(third)}, root(200)).with_rows(mechanisms).settled(false).named().claim);
  };
  EXPECT_EQ(named(2, 4.3, 0), "m0");
  EXPECT_EQ(named(2, 4.9, 0), "m0 m1");
  // Three are a tenth as likely as two.
  EXPECT_EQ(named(3, 4.6, 4.3), "m0");
  EXPECT_EQ(named(3, 4.7, 4.7), "m0 m1 m2");
}

// "both" makes what "p" and "q" make together; "r" makes nothing.
struct Believed : Contested {
  Believed() : Contested({12, 12}, 7) {}
  void add_limited(const std::string& id, const std::vector<double>& shape, double plausible, double bound = 1000) {
    MadeUp one = shaped(id, shape);
    one.declare = [plausible, bound](MechanismFactory& factory) {
      factory.plausible_min = -plausible;
      factory.plausible_max = plausible;
      factory.parameters.front().min = -bound;
      factory.parameters.front().max = bound;
    };
    add(one);
  }
  static std::string named_with(double plausible_both, double bound_both, double plausible_p, double plausible_q) {
    Believed causes;
    causes.add_limited("p", {1, 0}, plausible_p);
    causes.add_limited("both", {1, 1}, plausible_both, bound_both);
    causes.add_limited("q", {0, 1}, plausible_q);
    return named_in(causes.settled().named().claim);
  }
};

// It takes 288 of 337: more than 80 %.
TEST(Naming, OfWhatIsNotAllPrefersSeveralToOneThatNobodyBelieves) {
  EXPECT_EQ(Believed::named_with(500, 1000, 500, 500), "both");
  EXPECT_EQ(Believed::named_with(5, 1000, 500, 500), "p q") << "one is beyond what is plausible";
  EXPECT_EQ(Believed::named_with(500, 11.99, 500, 500), "p q") << "one ends at its bound";
  EXPECT_EQ(Believed::named_with(5, 1000, 5, 500), "both") << "nor are several to be believed";
  EXPECT_EQ(Believed::named_with(5, 1000, 500, 5), "both");
}

TEST(Naming, IsNotPossibleWithoutATrace) {
  Contested causes({10});
  causes.settled();
  EXPECT_EQ(causes.named().verdict, Verdict::unknown);
  EXPECT_THAT(reasons_of(causes.named()), ElementsAre(ReasonKind::no_trace));
  EXPECT_THAT(causes.named().reasons[0].text, HasSubstr("no mechanism of the catalogue"));
  causes.request.groups = {"rig", "file"};
  EXPECT_THAT(causes.named().reasons[0].text, HasSubstr("no mechanism of the group rig"));
  causes.request.groups = {"file"};
  EXPECT_THAT(causes.named().reasons[0].text, HasSubstr("\"groups\" leaves out material and rig"));
  causes.request.mechanisms = {"m0"};
  EXPECT_THAT(reasons_of(causes.named()), ElementsAre(ReasonKind::no_trace_of_requested));
  EXPECT_THAT(causes.named().reasons[0].text, HasSubstr("none of the requested mechanisms"));
}

TEST(Naming, OfRequestedMechanismsIsLikeAnyOther) {
  Contested causes({10});
  causes.request.mechanisms = {"m0"};
  EXPECT_EQ(named_in(causes.with_rows(1).settled().named().claim), "m0");
}

TEST(Naming, IsNotPossibleWhereNothingCanBeFitted) {
  Contested causes({10});
  MadeUp one = Contested::in_row(0);
  one.by = [](double distance) { return distance == 0 ? 0 : NAN; };
  causes.add(one);
  const Explanation found = causes.settled().named();
  EXPECT_EQ(found.verdict, Verdict::unknown);
  EXPECT_THAT(reasons_of(found), ElementsAre(ReasonKind::no_fit));
}

// A sum of exp(gain/2), and ln 2 for one side. "m2" is of the specimen.
TEST(RankingOfMechanisms, HasTheProbabilityOfEveryMechanismAsTheOnlyOne) {
  Contested causes({4, 5, 4.5});
  causes.add(Contested::in_row(0));
  MadeUp one_sided = Contested::in_row(1);
  one_sided.side = Side::positive;
  causes.add(one_sided);
  MadeUp specimen = Contested::in_row(2);
  specimen.declare = [](MechanismFactory& factory) { factory.origin = MechanismFactory::Origin::material; };
  causes.add(specimen);
  const std::vector<RankedMechanism> ranking = causes.settled().named().ranking;
  ASSERT_THAT(ranking, SizeIs(3));
  const double w1 = 2 * std::exp(25 / 2.0), w2 = std::exp(4.5 * 4.5 / 2), w0 = std::exp(8), all = w0 + w1 + w2;
  EXPECT_EQ(ranking[0].id, "m1");
  EXPECT_EQ(ranking[1].id, "m2");
  EXPECT_EQ(ranking[2].id, "m0");
  EXPECT_NEAR(ranking[0].probability, w1 / all, 1e-5);
  EXPECT_NEAR(ranking[1].probability, w2 / all, 1e-5);
  EXPECT_NEAR(ranking[2].probability, w0 / all, 1e-5);
  EXPECT_NEAR(ranking[2].score, 16, 1e-9);
  EXPECT_NEAR(ranking[2].gain.value(), 16, 1e-4);
  EXPECT_EQ(ranking[2].place.tests, std::vector<std::string>{"a"});
  EXPECT_EQ(ranking[0].group, CauseGroup::rig);
  EXPECT_EQ(ranking[1].group, CauseGroup::material);
}

TEST(RankingOfMechanisms, HasNoGainOfWhatIsTooFarBehindToBeFitted) {
  Contested causes({10, 9, 9, 9, 1});
  causes.request.quick = true;
  const std::vector<RankedMechanism> ranking = causes.with_rows(5).settled().named().ranking;
  ASSERT_THAT(ranking, SizeIs(5));
  EXPECT_EQ(ranking[4].id, "m4");
  EXPECT_EQ(ranking[4].gain, std::nullopt);
  EXPECT_NEAR(ranking[4].score, 1, 1e-9);
  EXPECT_TRUE(ranking[3].gain.has_value());
}

/// "m" shows in the tests "a" and "b", "n" in "b" alone, "o" nowhere.
struct TwoPlaces : MadeUpCauses {
  TwoPlaces(double in_a, double in_b) : MadeUpCauses({1, 2, 1}, Eigen::Vector4d(in_a, in_b, 0, 0)) {
    add({"m", Eigen::Vector4d(1, 1, 0, 0), {{"a"}, {"b"}}});
    add({"n", Eigen::Vector4d(0, 0, 1, 0), {{"b"}}});
    add({"o", Eigen::Vector4d(0, 0, 0, 0), {{"c"}}});
    close();
    calibrate_by_noise();
  }
};

TEST(Naming, SaysWhereEachMechanismExplainsMost) {
  const TwoPlaces first(10, 3), second(3, 10);
  const auto in_first = named_causes(first.inquiry(), first.analysis).best_direction;
  const auto in_second = named_causes(second.inquiry(), second.analysis).best_direction;
  EXPECT_THAT(in_first, ElementsAre(Optional(first.direction("m", 0)), Optional(first.direction("n")), std::nullopt));
  EXPECT_THAT(in_second,
              ElementsAre(Optional(second.direction("m", 1)), Optional(second.direction("n")), std::nullopt));
}

// By itself "m" explains most in "a", beside "n", which explains that too, in "b".
TEST(Naming, SaysWhereEachMechanismOfAGroupExplainsMost) {
  MadeUpCauses causes({2, 1}, Eigen::Vector3d(10, 4, 10));
  causes.add({"m", Eigen::Vector3d(1, 0.1, 1), {{"a"}, {"b"}}});
  causes.add({"n", Eigen::Vector3d(1, 0.4, 0), {{"a"}}});
  causes.close();
  causes.calibrate_by_noise();
  const Explanation found = named_causes(causes.inquiry(), causes.analysis);
  ASSERT_EQ(found.claim.named, 2u);
  EXPECT_THAT(found.best_direction, ElementsAre(Optional(causes.direction("m", 1)), Optional(causes.direction("n"))));
}

}  // namespace
}  // namespace tunica::diagnosis::naming_test
