// SPDX-License-Identifier: Apache-2.0
// One search in several specimens: the terms are common, their parameters are each specimen's own.
#include <cmath>

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include "discover/rubber.hpp"
#include "discovery/common/common_discovery.hpp"

using namespace tunica;
using diagnosis::Verdict;
using ::testing::IsEmpty;
using ::testing::SizeIs;

namespace {

/// Specimens of one rubber with moduli from 200 to 400 kPa; `second` is the modulus of a term in I2 that the base does
/// not have, by specimen.
class Tissue {
 public:
  Tissue(std::uint64_t seed, const std::vector<double>& second) : rubbers_(second.size()) {
    for (std::size_t s = 0; s < second.size(); ++s) {
      trial::Rubber& rubber = rubbers_[s];
      const double modulus = 200 + 200 * static_cast<double>(s) / static_cast<double>(second.size());
      rubber.experiment["models"]["rubber"]["parameters"]["mu"]["initial"] = modulus;
      rubber.measure(seed + s, second[s] == 0
                                   ? trial::Measured::Hide{}
                                   : trial::hidden_term({{"invariant", "I2"},
                                                         {"law", "linear"},
                                                         {"parameters", {{"mu", {{"initial", second[s]}}}}}}));
    }
  }

  [[nodiscard]] std::vector<discovery::Member> members() const {
    std::vector<discovery::Member> all;
    for (std::size_t s = 0; s < rubbers_.size(); ++s) all.push_back({"S" + std::to_string(s + 1), rubbers_[s].read()});
    return all;
  }

  [[nodiscard]] discovery::CommonDiscovery discover(bool from_nothing = false) const {
    const auto members = this->members();
    discovery::Request request = discovery::request_of(members.front().experiment);
    request.quick = true;
    request.from_nothing = from_nothing;
    return discovery::discover_together(members, request, tunica::testing::catalogue());
  }

  [[nodiscard]] const trial::Rubber& rubber(std::size_t s) const { return rubbers_[s]; }

 private:
  std::vector<trial::Rubber> rubbers_;
};

std::string reasons_of(const discovery::CommonDiscovery& found) {
  std::string words;
  for (const auto& reason : found.judgement.reasons) words += reason.text + " ";
  return words;
}

}  // namespace

// Alone, three of these ten specimens ask for a term in I2, and the others for another one or for none; the evidence of
// all leaves no doubt. At 0.1 kPa nothing is seen, and at 0.3 kPa every specimen sees it by itself.
TEST(CommonDiscovery, WhatIsTooWeakInEachIsFoundInAllTogether) {
  const Tissue tissue(100, std::vector<double>(10, 0.15));
  int alone = 0;
  for (std::size_t s = 0; s < 10; ++s) {
    const auto found = tissue.rubber(s).discover();
    if (found.judgement.verdict == Verdict::discovered && found.terms.front().kind->invariant == "I2") ++alone;
  }
  EXPECT_LE(alone, 5);
  const auto together = tissue.discover();
  ASSERT_EQ(together.judgement.verdict, Verdict::discovered) << reasons_of(together);
  ASSERT_THAT(together.terms, SizeIs(1));
  EXPECT_EQ(together.terms.front().kind->invariant, "I2");
  EXPECT_GE(together.terms.front().invariant_probability, 0.99);
  EXPECT_GE(together.terms.front().seen(), 6U);
}

// Amplitudes differ between specimens by a factor of four; each has its own estimate.
TEST(CommonDiscovery, EachSpecimenHasParametersOfItsOwn) {
  const std::vector<double> truth{20, 40, 60, 80};
  const auto found = Tissue(200, truth).discover();
  ASSERT_EQ(found.judgement.verdict, Verdict::discovered) << reasons_of(found);
  ASSERT_THAT(found.terms, SizeIs(1));
  EXPECT_EQ(found.terms.front().name, "I2_linear");
  for (std::size_t s = 0; s < truth.size(); ++s) {
    ASSERT_TRUE(found.terms.front().specimens[s]);
    const auto& mu = found.terms.front().specimens[s]->parameters.front();
    EXPECT_NEAR(mu.value, truth[s], 5 * (mu.high - mu.value) / 1.96);  // 5 standard errors: 6e-7
    EXPECT_FALSE(found.specimens[s].needed);
    EXPECT_GT(found.specimens[s].gain, 10);
  }
}

TEST(CommonDiscovery, AWholeEnergyIsFoundFromNothing) {
  const auto found = Tissue(300, {60, 70, 80}).discover(true);
  ASSERT_EQ(found.judgement.verdict, Verdict::discovered) << reasons_of(found);
  ASSERT_THAT(found.terms, SizeIs(2));
  EXPECT_EQ(found.terms[0].name, "I1_linear");
  EXPECT_EQ(found.terms[1].name, "I2_linear");
}

// The common alarm of 5 % is all that can go wrong: 4 or more of 10 have a chance of 0.001.
TEST(CommonDiscovery, NothingIsFoundWhereNothingIsWrong) {
  int discovered = 0;
  for (std::uint64_t seed = 400; seed < 440; seed += 4)
    if (Tissue(seed, {0, 0, 0, 0}).discover().judgement.verdict != Verdict::nothing_detected) ++discovered;
  EXPECT_LT(discovered, 4);
}

// One odd specimen of six is no property of the tissue.
TEST(CommonDiscovery, ATermOfOneSpecimenIsNotCommon) {
  const auto found = Tissue(500, {0, 0, 60, 0, 0, 0}).discover();
  EXPECT_NE(found.judgement.verdict, Verdict::nothing_detected);
  EXPECT_NE(found.judgement.verdict, Verdict::discovered) << reasons_of(found);
  EXPECT_THAT(found.terms, IsEmpty());
}

TEST(CommonDiscovery, OneSpecimenIsSearchedAsWithoutACohort) {
  const Tissue tissue(600, {40});
  const auto together = tissue.discover();
  const auto alone = tissue.rubber(0).discover();
  ASSERT_EQ(together.judgement.verdict, alone.judgement.verdict);
  ASSERT_EQ(together.terms.size(), alone.terms.size());
  EXPECT_EQ(together.terms.front().name, alone.terms.front().name);
  EXPECT_DOUBLE_EQ(together.best->log_evidence, alone.best->log_evidence);
}

TEST(CommonDiscovery, TheOutcomeDoesNotDependOnThreads) {
  const Tissue tissue(700, {20, 30, 40});
  std::vector<double> evidence, amplitudes;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, threads);
    const auto found = tissue.discover();
    ASSERT_TRUE(found.best);
    evidence.push_back(found.best->log_evidence);
    amplitudes.push_back(found.terms.front().specimens.back()->parameters.front().value);
  }
  EXPECT_EQ(evidence[0], evidence[1]);
  EXPECT_EQ(amplitudes[0], amplitudes[1]);
}

// A test is at its edge: of 20 specimens one in twenty is expected not to be noise, and four are too many.
TEST(CommonDiscovery, AFewRestsThatAreNotNoiseAreExpected) {
  std::vector<double> p_values(20, 0.5);
  EXPECT_EQ(discovery::p_of_rests(p_values), 1);
  p_values[3] = 1e-9;
  EXPECT_NEAR(discovery::p_of_rests(p_values), 1 - std::pow(0.95, 20), 1e-12);
  p_values[4] = p_values[5] = p_values[6] = p_values[7] = 0.02;
  EXPECT_LT(discovery::p_of_rests(p_values), 0.01);
  EXPECT_EQ(discovery::p_of_rests({0.003}), 0.003);
}
