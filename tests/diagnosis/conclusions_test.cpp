// SPDX-License-Identifier: Apache-2.0
// The verdict on an explanation that was chosen: what it turns on, and what is said where something is left.
#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/contested.hpp"

namespace tunica::diagnosis::conclusions_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;
using Names = std::vector<std::string>;

/// So many mechanisms that explain the same data about equally well, each with a row of its own beside.
Explanation alike(std::size_t count) {
  Contested causes({6});
  for (std::size_t k = 1; k <= count; ++k) {
    std::vector<double> shape(k + 1, 0.0);
    shape[0] = 1;
    shape[k] = 0.4;
    causes.add(Contested::shaped("m" + std::to_string(k), shape));
  }
  return causes.settled().named();
}

TEST(Conclusion, IsNotOneOfMoreThanFourExplanations) {
  const Explanation two = alike(2), four = alike(4), five = alike(5);
  EXPECT_EQ(two.verdict, Verdict::indistinguishable);
  EXPECT_THAT(two.claim.ambiguity_set, SizeIs(2));
  EXPECT_EQ(four.verdict, Verdict::indistinguishable);
  EXPECT_THAT(four.reasons, IsEmpty());
  EXPECT_THAT(four.claim.ambiguity_set, SizeIs(4));
  EXPECT_EQ(five.verdict, Verdict::unknown);
  EXPECT_THAT(reasons_of(five), ElementsAre(ReasonKind::many_explanations));
  EXPECT_THAT(five.reasons[0].text, StartsWith("5 explanations"));
}

// Of the squares of 10 and 5, q takes nothing by itself.
TEST(Conclusion, IsNoNameWhereAMemberMayOnlyCorrectAShape) {
  Contested causes({10, 5});
  causes.add(Contested::shaped("p", {1, 0}));
  causes.add(Contested::shaped("q", {-0.5, 1}));
  const Explanation found = causes.settled().named();
  EXPECT_EQ(named_in(found.claim), "p q");
  EXPECT_EQ(found.verdict, Verdict::indistinguishable);
  EXPECT_TRUE(found.unlisted);
  EXPECT_THAT(reasons_of(found), ElementsAre(ReasonKind::shape_correction));
  EXPECT_THAT(found.reasons[0].text, StartsWith("q explains almost nothing"));
}

/// What the k-th mechanism of the rows is, and what is concluded of these values.
Explanation concluded_of(const std::vector<double>& shown, std::size_t k,
                         const std::function<void(MechanismFactory&)>& declare) {
  Contested causes(shown);
  for (std::size_t row = 0; row < shown.size(); ++row) {
    MadeUp one = Contested::in_row(row);
    if (row == k) one.declare = declare;
    causes.add(one);
  }
  return causes.settled().named();
}

TEST(Conclusion, IsSuspectDataWhereOneMechanismSitsInSingleReadings) {
  const auto in_data = [](MechanismFactory& factory) { factory.stage = Stage::data; };
  const Explanation one = concluded_of({10, 0}, 0, in_data);
  EXPECT_EQ(one.verdict, Verdict::suspect_data);
  EXPECT_THAT(reasons_of(one), ElementsAre(ReasonKind::single_place));
  EXPECT_THAT(one.reasons[0].text, HasSubstr("the misfit sits in the test 'a', and nowhere else"));
  EXPECT_EQ(concluded_of({0, 10}, 0, in_data).verdict, Verdict::named) << "another one";
  const Explanation two = concluded_of({10, 8}, 0, in_data);
  EXPECT_EQ(named_in(two.claim), "m0 m1");
  EXPECT_EQ(two.verdict, Verdict::named) << "beside another one";
}

TEST(Conclusion, IsSuspectDataWhereAnAmplitudeIsImplausible) {
  const auto up_to = [](double plausible) {
    return [plausible](MechanismFactory& factory) { factory.plausible_max = plausible; };
  };
  const Explanation one = concluded_of({10, 0}, 0, up_to(5));
  EXPECT_EQ(one.verdict, Verdict::suspect_data);
  EXPECT_THAT(reasons_of(one), ElementsAre(ReasonKind::implausible));
  EXPECT_EQ(one.reasons[0].text, "m0 would have to be 10 kPa, which is beyond what is plausible");
  EXPECT_EQ(concluded_of({10, 0}, 0, up_to(15)).verdict, Verdict::named);
  for (const std::size_t k : {0u, 1u}) {
    const Explanation two = concluded_of({10, 8}, k, up_to(5));
    EXPECT_EQ(named_in(two.claim), "m0 m1");
    EXPECT_EQ(two.verdict, Verdict::suspect_data) << k;
    ASSERT_THAT(reasons_of(two), ElementsAre(ReasonKind::implausible)) << k;
    EXPECT_THAT(two.reasons[0].text, StartsWith(k == 0 ? "m0 would have to be 10" : "m1 would have to be 8"));
  }
}

TEST(Conclusion, IsSuspectDataWhereAnAmplitudeEndsAtItsBound) {
  const Explanation found = concluded_of({10, 0}, 0, [](MechanismFactory& factory) {
    factory.parameters.front().max = 9.5;
    factory.parameters.front().unit = "1";
  });
  EXPECT_EQ(found.verdict, Verdict::suspect_data);
  EXPECT_THAT(reasons_of(found), ElementsAre(ReasonKind::at_bound));
  EXPECT_EQ(found.reasons[0].text, "m0 would have to be 9.5, which is at its bound");
}

/// "m" should show in all rows of "a" and "b" and shows in "a" alone; "n" shows in "c".
Explanation carried(double in_c) {
  Eigen::VectorXd shown(14), shape(14), other(14);
  shown << Eigen::VectorXd::Constant(6, 5), Eigen::VectorXd::Zero(6), in_c, in_c;
  shape << Eigen::VectorXd::Ones(12), 0, 0;
  other << Eigen::VectorXd::Zero(12), 1, 1;
  MadeUpCauses causes({6, 6, 2}, shown);
  causes.add({"m", shape, {{"a", "b"}}});
  causes.add({"n", other, {{"c"}}});
  causes.close();
  causes.calibrate_by_noise();
  return named_causes(causes.inquiry(), causes.analysis);
}

TEST(Conclusion, IsSuspectDataWhereOneTestCarriesWhatSeveralShould) {
  const Explanation one = carried(0);
  EXPECT_EQ(named_in(one.claim), "m");
  EXPECT_EQ(one.verdict, Verdict::suspect_data);
  EXPECT_THAT(reasons_of(one), ElementsAre(ReasonKind::single_carrier));
  EXPECT_THAT(one.reasons[0].text, HasSubstr("only one carries it: without the test 'a'"));
  const Explanation two = carried(6);
  EXPECT_EQ(named_in(two.claim), "m n");
  EXPECT_EQ(two.verdict, Verdict::named) << "of several nobody asks";
}

/// These of the rows as causes of which the residuals are said to be no noise.
struct Unclean : Contested {
  explicit Unclean(const std::vector<double>& shown, double unlisted = 0) : Contested(shown, unlisted) {
    with_rows(3).settled();
  }
  [[nodiscard]] Explanation explanation(const Names& ids, double p_after) const {
    Explanation made;
    std::vector<std::size_t> directions;
    for (const std::string& id : ids) {
      directions.push_back(direction(id));
      made.claim.causes.emplace_back().id = id;
    }
    made.claim.named = ids.size();
    made.claim.causes.emplace_back().id = "a_rival";
    made.claim.best = group_of(directions).refit;
    made.p_after = p_after;
    return made;
  }
  /// Where the base leaves `before` and the explanation `after`.
  [[nodiscard]] std::string share_of(double before, double after) {
    analysis.evidence.fit.chi2 = before;
    Explanation made = explanation({"m0"}, 0.005);
    made.claim.best->fit.chi2 = after;
    const std::string text = unclean(inquiry(), analysis, std::move(made)).reasons.front().text;
    return text.substr(0, text.find('%') + 1);
  }
};

TEST(WhatIsLeft, IsToldBesideTheShareThatTheCausesTake) {
  const Unclean causes({10, 8, 6});
  const Explanation one = unclean(causes.inquiry(), causes.analysis, causes.explanation({"m0"}, 0.005));
  EXPECT_EQ(one.verdict, Verdict::unknown);
  EXPECT_EQ(one.reasons.front().kind, ReasonKind::not_clean);
  EXPECT_THAT(one.reasons.front().text,  // 100 of 200 - 12
              AllOf(StartsWith("m0 explains 53 % of the misfit beyond noise"), HasSubstr("(p = 0.005)")));
  const Explanation two = unclean(causes.inquiry(), causes.analysis, causes.explanation({"m0", "m1"}, 0.99e-4));
  EXPECT_THAT(two.reasons.front().text,  // 164 of 188
              AllOf(StartsWith("m0 and m1 explain 87 % of the misfit"), HasSubstr("(p < 0.0001)")));
  EXPECT_THAT(unclean(causes.inquiry(), causes.analysis, causes.explanation({"m0"}, 1.5e-4)).reasons.front().text,
              HasSubstr("(p = 0.00015)"));
}

TEST(WhatIsLeft, IsNoLessThanNothingAndNoMoreThanAll) {
  Unclean causes({10, 8, 6});
  EXPECT_EQ(causes.share_of(112, 62), "m0 explains 50 %");
  EXPECT_EQ(causes.share_of(112, 6), "m0 explains 100 %");
  EXPECT_EQ(causes.share_of(112, 113), "m0 explains 0 %");
  EXPECT_EQ(causes.share_of(12.5, 12.1), "m0 explains 40 %") << "of 1 at least";
}

// The rest, 8 in one row, is noise at σ of about 3; the base is off by 1/3 beside 8/3 at that, or by 30/3.
TEST(WhatIsLeft, SaysHowLargeNoiseWouldHaveToBe) {
  for (const auto& [explained, still] : {std::pair{1.0, false}, std::pair{30.0, true}}) {
    Unclean causes({explained, 8});
    causes.request.alpha = 0.001;
    const Explanation found = unclean(causes.inquiry(), causes.analysis, causes.explanation({"m0"}, 1e-9));
    EXPECT_THAT(reasons_of(found), ElementsAre(ReasonKind::not_clean, ReasonKind::larger_noise));
    ASSERT_TRUE(found.noise_factor);
    EXPECT_GT(*found.noise_factor, 8 / 4.0);
    EXPECT_LT(*found.noise_factor, 8 / 2.0);
    EXPECT_THAT(found.reasons[1].text,
                AllOf(StartsWith("noise would have to be "), HasSubstr(" times larger"),
                      HasSubstr(still ? "the base model would still fail" : "the base model would then fit as well")));
  }
}

TEST(WhatIsLeft, MayBeMoreThanAnyNoiseExplains) {
  const Unclean causes({10, 100});
  const Explanation found = unclean(causes.inquiry(), causes.analysis, causes.explanation({"m0"}, 1e-9));
  EXPECT_THAT(reasons_of(found), ElementsAre(ReasonKind::not_clean));
  EXPECT_EQ(found.noise_factor, std::nullopt);
}

}  // namespace
}  // namespace tunica::diagnosis::conclusions_test
