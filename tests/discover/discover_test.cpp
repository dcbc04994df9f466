// SPDX-License-Identifier: Apache-2.0
// What a discovery finds where something is hidden, and that it finds nothing where nothing is.
#include <cmath>

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include "diagnosis/diagnosis.hpp"
#include "discover/rubber.hpp"
#include "discovery/after_diagnosis.hpp"
#include "discovery/output/outputs.hpp"
#include "experiment/reader.hpp"

using namespace tunica;
using diagnosis::Verdict;
using discovery::ReasonKind;
using ::testing::Contains;
using ::testing::Field;
using ::testing::SizeIs;

namespace {

std::vector<ReasonKind> reasons_of(const discovery::Discovery& found) {
  std::vector<ReasonKind> kinds;
  for (const auto& reason : found.judgement.reasons) kinds.push_back(reason.kind);
  return kinds;
}

}  // namespace

// mu = 40 kPa shows with Λ of several hundred; its standard error is about 1 kPa, so that 5 of them are a chance of
// 6e-7.
TEST(Discover, ATermInTheSecondInvariantIsFound) {
  const trial::Rubber rubber;
  rubber.measure(
      11, trial::hidden_term({{"invariant", "I2"}, {"law", "linear"}, {"parameters", {{"mu", {{"initial", 40}}}}}}));
  const auto found = rubber.discover();
  ASSERT_EQ(found.judgement.verdict, Verdict::discovered) << found.judgement.reasons.front().text;
  ASSERT_THAT(found.terms, SizeIs(1));
  const auto& term = found.terms.front();
  EXPECT_EQ(term.kind->invariant, "I2");
  EXPECT_EQ(term.kind->law, "linear");
  const auto& mu = term.parameters.front();
  EXPECT_NEAR(mu.value, 40, 5 * (mu.high - mu.value) / 1.96);
  EXPECT_GT(found.p_after, 0.01);
  // ψ' = mu/2 over the whole reach, within its own band
  for (std::size_t i = 0; i < term.curve.x.size(); ++i)
    EXPECT_NEAR(term.curve.slope[i], 20, 2.5 * (term.curve.high[i] - term.curve.slope[i]));
}

// The alarm of 5 % is all that can go wrong: 5 or more of 20 have a chance of 0.0026.
TEST(Discover, NothingIsFoundWhereNothingIsWrong) {
  int discovered = 0;
  for (std::uint64_t seed = 100; seed < 120; ++seed) {
    const trial::Rubber rubber;
    rubber.measure(seed);
    const auto found = rubber.discover();
    if (found.judgement.verdict != Verdict::nothing_detected) ++discovered;
    if (found.judgement.verdict == Verdict::nothing_detected) {
      EXPECT_THAT(found.terms, ::testing::IsEmpty());
    }
  }
  EXPECT_LT(discovered, 5);
}

TEST(Discover, AWholeEnergyIsFoundFromNothing) {
  const trial::Rubber rubber;
  rubber.measure(
      12, trial::hidden_term({{"invariant", "I2"}, {"law", "linear"}, {"parameters", {{"mu", {{"initial", 60}}}}}}));
  const auto found = rubber.discover(true);
  ASSERT_EQ(found.judgement.verdict, Verdict::discovered) << found.judgement.reasons.front().text;
  ASSERT_THAT(found.terms, SizeIs(2));
  EXPECT_EQ(found.terms[0].name, "I1_linear");
  EXPECT_EQ(found.terms[1].name, "I2_linear");
  const auto& mu = found.terms[0].parameters.front();
  EXPECT_NEAR(mu.value, 300, 5 * (mu.high - mu.value) / 1.96);
}

// |r|² of the base is of the order of the one that an I2 term would leave: the load cell has to be seen as such.
TEST(Discover, AnErrorOfTheLoadCellIsNoTerm) {
  const trial::Rubber rubber;
  rubber.measure(13, [](nlohmann::json& truth) {
    truth["tests"]["circumferential"]["mechanisms"] = {trial::mechanism("force_offset", "value", 25)};
  });
  const auto found = rubber.discover();
  EXPECT_NE(found.judgement.verdict, Verdict::nothing_detected);
  EXPECT_NE(found.judgement.verdict, Verdict::discovered) << found.judgement.reasons.front().text;
  EXPECT_THAT(reasons_of(found), ::testing::AnyOf(Contains(ReasonKind::rig_explains), Contains(ReasonKind::rig_rival)));
}

TEST(Discover, ACurveStandsWhereNoLawFits) {
  const trial::Rubber rubber;
  // ψ'' is nothing up to I1 − 3 = 2, then a constant: a kink that no law has.
  rubber.measure(14, trial::hidden_term({{"invariant", "I1"},
                                         {"law", "spline"},
                                         {"knots", {0, 2.4, 2.5, 7}},
                                         {"parameters",
                                          {{"slope", {{"initial", 0}}},
                                           {"c_1", {{"initial", 0}}},
                                           {"c_2", {{"initial", 0}}},
                                           {"c_3", {{"initial", 60}}},
                                           {"c_4", {{"initial", 60}}}}}}));
  const auto found = rubber.discover();
  ASSERT_FALSE(found.terms.empty()) << found.judgement.reasons.front().text;
  double slope = 0;
  for (const auto& term : found.terms) {
    EXPECT_EQ(term.kind->invariant, "I1");
    slope += term.curve.slope.back();
  }
  // The base may take a constant slope: what the terms have at the end beyond what they have at rest.
  double rest = 0;
  for (const auto& term : found.terms) rest += term.curve.slope.front();
  const double end = found.terms.front().curve.x.back();
  EXPECT_NEAR(slope - rest, 60 * (end - 2.45), 0.05 * 60 * (end - 2.45));
}

TEST(Discover, WhatIsWrittenRunsAndGivesTheSameFit) {
  const trial::Rubber rubber;
  rubber.measure(
      15, trial::hidden_term({{"invariant", "I1"}, {"law", "quadratic"}, {"parameters", {{"k", {{"initial", 30}}}}}}));
  for (const bool from_nothing : {false, true}) {
    const auto found = rubber.discover(from_nothing);
    ASSERT_EQ(found.judgement.verdict, Verdict::discovered);
    const auto file =
        rubber.folder.write("extended.json", discovery::extended_experiment(found, tunica::testing::catalogue()));
    const auto extended = experiment::read_experiment(file, tunica::testing::catalogue());
    const assembly::Assembly assembly(extended, extended.runs.front(), tunica::testing::catalogue());
    std::vector<double> free(assembly.layout().parameters.size());
    assembly.box().from_unit(assembly.box().initial(), free);
    Eigen::VectorXd residuals;
    ASSERT_TRUE(diagnosis::whitened(assembly, free, *assembly.evaluator().make_workspace(), residuals, nullptr).ok());
    EXPECT_NEAR(residuals.squaredNorm(), found.chi2_after, 1e-6 * found.chi2_after);
  }
}

TEST(Discover, TheOutcomeDoesNotDependOnThreads) {
  const trial::Rubber rubber;
  rubber.measure(
      16, trial::hidden_term({{"invariant", "I2"}, {"law", "quadratic"}, {"parameters", {{"k", {{"initial", 8}}}}}}));
  std::vector<std::string> outcomes;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, threads);
    outcomes.push_back(discovery::discovery_json(rubber.discover()).dump());
  }
  EXPECT_EQ(outcomes[0], outcomes[1]);
}

// Hossain et al. 2012: loading and unloading of VHB 4910 at three rates.
TEST(Discover, HistoryIsNotAnEnergy) {
  const auto read = experiment::read_experiment(
      std::string(TUNICA_SOURCE_DIR) + "/examples/vhb4910_cause/experiment.json", tunica::testing::catalogue());
  discovery::Request request = discovery::request_of(read);
  request.quick = true;
  const auto found = discovery::discover(read, request, tunica::testing::catalogue());
  EXPECT_EQ(found.judgement.verdict, Verdict::unknown);
  EXPECT_THAT(reasons_of(found), Contains(ReasonKind::not_an_energy));
  EXPECT_THAT(found.terms, ::testing::IsEmpty());
  EXPECT_TRUE(discovery::extended_experiment(found, tunica::testing::catalogue()).empty());
}

// Treloar 1944: the catalogue's best leaves |r|² 707 of a neo-Hookean 4637.
TEST(Discover, ADiagnosisThatEndsUnknownGoesOn) {
  const auto read = experiment::read_experiment(
      std::string(TUNICA_SOURCE_DIR) + "/examples/treloar_cause/experiment.json", tunica::testing::catalogue());
  diagnosis::Request request = diagnosis::request_of(read);
  request.quick = true;
  auto found = diagnosis::diagnose(read, request, tunica::testing::catalogue());
  ASSERT_EQ(found.explanation.verdict, Verdict::unknown);
  const auto more = discovery::after(found, read, tunica::testing::catalogue());
  ASSERT_TRUE(more);
  EXPECT_LE(more->chi2_after, 100);
  found = discovery::with_verdict_of(*more, std::move(found));
  EXPECT_EQ(found.explanation.verdict, Verdict::discovered);
}
