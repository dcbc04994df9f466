// SPDX-License-Identifier: Apache-2.0
#include "comparison/uncertainty_words.hpp"

#include <gmock/gmock.h>

#include "execution/laboratory.hpp"

using namespace tunica;
using uncertainty::Profile;
using Kind = Profile::End::Kind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace {

/// Parameter a between 0 and 10 with the linearised interval 1 … 3.
struct Words {
  Words() {
    laboratory.add_run("walk");
    plan.emplace(laboratory.plan());
    comparison::Estimate estimate;
    estimate.name = "a";
    estimate.value = 2;
    estimate.max = 10;
    estimate.ci95 = {1, 3};
    summary.parameters.assign(3, estimate);
    profile.threshold = 3.84;
    profile.lower = {Kind::crossed, 1.1};
    profile.upper = {Kind::crossed, 2.9};
  }
  std::vector<std::string> said() {
    summary.uncertainty.clear();
    comparison::add_profile_words(*plan->runs[0].assembly, {profile}, summary);
    return summary.uncertainty;
  }
  trial::Laboratory laboratory;
  std::optional<execution::Plan> plan;
  comparison::RunSummary summary;
  Profile profile;
};

}  // namespace

TEST(ProfileWords, SayNothingWhereTheIntervalsAgree) {
  Words words;
  EXPECT_THAT(words.said(), IsEmpty());
}

TEST(ProfileWords, NameOpenEndsAndDisagreement) {
  Words words;
  words.profile.upper = {Kind::open, 10};
  EXPECT_THAT(words.said(),
              ElementsAre("the profile of a is open towards the upper bound: the data do not limit it there",
                          HasSubstr("a: the profile (1.1 … open) and the linearised interval (1 … 3) disagree")));
  words.summary.parameters[0].ci95 = {1, 10};
  words.profile.lower.value = 1;
  EXPECT_THAT(words.said(), ElementsAre(HasSubstr("open towards the upper bound")))
      << "both end at the bound, one because it was cut off there";
}

TEST(ProfileWords, DoNotCallABoundThatTheValueLiesAtAnOpenEnd) {
  Words words;
  words.profile.lower = {Kind::open, 0};
  words.summary.parameters[0].at_bound = comparison::Estimate::Bound::lower;
  words.summary.parameters[0].ci95.reset();
  EXPECT_THAT(words.said(), IsEmpty());
}

TEST(ProfileWords, SayWhereRefitsFailedAndWhereTheCentreWasNoOptimum) {
  Words words;
  words.profile.lower = {Kind::failed, 1.1};
  words.profile.lowest = -0.5;
  words.summary.parameters[0].ci95.reset();
  EXPECT_THAT(words.said(), ElementsAre(HasSubstr("ends at 1.1, before the lower bound: beyond it no refit succeeded"),
                                        HasSubstr("found a better point (-2 ln L lower by 0.5)")));
}

TEST(ProfileWords, SayThatTheBestPointOfTheRunWasNoOptimum) {
  Words words;
  words.profile.gain = 0.7;
  EXPECT_THAT(words.said(), ElementsAre(HasSubstr("found a better point (-2 ln L lower by 0.7)")));
}

TEST(WideningWords, SayByHowMuchIntervalsAreWiderAndWhatIsBetter) {
  Words words;
  comparison::add_widening_words(words.summary);
  EXPECT_THAT(words.summary.uncertainty, IsEmpty());
  assembly::Misfit misfit;
  misfit.chi_square = 900;
  misfit.rows = 104;
  misfit.freedom = 100;
  misfit.chance = 0;
  words.summary.misfit = misfit;
  comparison::add_widening_words(words.summary);
  EXPECT_THAT(words.summary.uncertainty, ElementsAre(HasSubstr("3 times as wide as the stated noise makes them")));
  EXPECT_THAT(words.summary.uncertainty[0], HasSubstr("--bootstrap 200 gives better ones"));
  words.summary.uncertainty.clear();
  words.summary.bootstrap = {200, 0};
  comparison::add_widening_words(words.summary);
  EXPECT_THAT(words.summary.uncertainty, ElementsAre(HasSubstr("take the bootstrap")));
  words.summary.uncertainty.clear();
  words.summary.misfit->chance = 0.01;
  comparison::add_widening_words(words.summary);
  EXPECT_THAT(words.summary.uncertainty, IsEmpty());
}

TEST(LinearisedWords, AdviseAProfileOrTakeTheOneThatIsThere) {
  Words words;
  words.summary.uncertainty = {"later"};
  comparison::add_linearised_words(words.summary);
  EXPECT_THAT(words.summary.uncertainty, ElementsAre("later")) << "all intervals are straight";
  words.summary.parameters[0].straight = false;
  comparison::add_linearised_words(words.summary);
  EXPECT_THAT(words.summary.uncertainty,
              ElementsAre("the linearised interval of a may be far off: the likelihood is not quadratic over this "
                          "interval, or a bound cuts it off; --profiles a gives a better one",
                          "later"));
  words.summary.uncertainty.clear();
  words.summary.parameters[0].profile = comparison::ProfileInterval{1, 3};
  comparison::add_linearised_words(words.summary);
  EXPECT_THAT(words.summary.uncertainty, ElementsAre(HasSubstr("cuts it off; take the profile")));
}

TEST(BootstrapWords, CountFailuresAndNameCorrelatedResiduals) {
  Words words;
  uncertainty::Bootstrap bootstrap;
  bootstrap.draws.resize(200);
  bootstrap.failures = 3;
  bootstrap.blocks = {7};
  bootstrap.correlation = {0.644};
  comparison::add_bootstrap_words(*words.plan->runs[0].assembly, bootstrap, words.summary);
  EXPECT_EQ(words.summary.bootstrap->failed, 3u);
  EXPECT_THAT(words.summary.uncertainty,
              ElementsAre("3 of 200 bootstrap draws could not be fitted and are left out",
                          HasSubstr("neighbouring residuals of curve, y are correlated (0.64), so the bootstrap drew "
                                    "blocks of 7 rows")));
  words.summary.uncertainty.clear();
  comparison::add_bootstrap_words(*words.plan->runs[0].assembly, {}, words.summary);
  EXPECT_THAT(words.summary.uncertainty, ElementsAre("no bootstrap: the best point cannot be linearised"));
}
