// SPDX-License-Identifier: Apache-2.0
// What leads, by shares and probabilities that are made up.
#include "budget/decision.hpp"

#include <gmock/gmock.h>

#include "budget/output/outputs.hpp"

namespace tunica::budget {
namespace {

using diagnosis::Verdict;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Contender rig(const std::string& id, double share, double probability, Belief belief = Belief::plausible) {
  Contender one;
  one.id = one.sort = id;
  one.share = share;
  one.probability = probability;
  one.belief = belief;
  return one;
}

Contender form(const std::string& id, double share, double probability) {
  Contender one = rig(id, share, probability);
  one.in_the_energy = one.term = true;
  return one;
}

TEST(AnotherState, ShowsItsPrice) {
  Contender state = rig("another_state", 0.98, 0.0004);
  state.parameters = 4;
  EXPECT_EQ(price(state), " (with 4 parameters of its own, probability below 0.01)");
  state.parameters = 1;
  state.probability = 0.25;
  EXPECT_EQ(price(state), " (with 1 parameter of its own, probability 0.25)");
  EXPECT_EQ(price(rig("gain", 0.98, 0.0004)), "");
}

struct Deciding : ::testing::Test {
  Deciding() {
    budget.base.rms = 0.08;
    budget.tolerance.share = 0.02;
  }
  /// The verdict and its basis.
  std::pair<Verdict, std::vector<std::string>> of(std::vector<Contender> contenders) {
    budget.contenders = std::move(contenders);
    const Decision decision = decided(budget);
    std::vector<std::string> ids;
    for (const Contender* one : decision.first) ids.push_back(one->id);
    return {decision.verdict, ids};
  }
  void expect(std::vector<Contender> contenders, Verdict verdict, const std::vector<std::string>& ids) {
    const auto [found, first] = of(std::move(contenders));
    EXPECT_EQ(found, verdict);
    EXPECT_EQ(first, ids);
  }
  Budget budget;
};

TEST_F(Deciding, WhatIsFarAheadAndSureLeads) {
  expect({rig("gain", 0.9, 0.95), rig("offset", 0.7, 0.04)}, Verdict::leading, {"gain"});
  expect({rig("gain", 0.9, 0.85), rig("offset", 0.7, 0.04)}, Verdict::unknown, {});
  expect({rig("gain", 0.45, 0.99)}, Verdict::unknown, {});
  budget.rough = true;
  expect({rig("gain", 0.9, 0.95)}, Verdict::unknown, {});
  budget.rough = false;
  budget.cheaper = Budget::Cheaper{{"plate"}, 0.49};
  expect({rig("gain", 0.9, 0.95)}, Verdict::unknown, {});
  budget.cheaper->own_share = 0.51;
  expect({rig("gain", 0.9, 0.95)}, Verdict::leading, {"gain"});
  budget.cheaper.reset();
  // Whether the misfit matters is another question.
  budget.base.rms = 0.01;
  expect({rig("gain", 0.9, 0.95)}, Verdict::leading, {"gain"});
  // Within the tolerance every cause leaves little, so the evidence must decide.
  expect({rig("gain", 0.96, 0.12), rig("offset", 0.8, 0.85)}, Verdict::unknown, {});
  budget.base.rms = 0;
  expect({rig("gain", 0.9, 0.95)}, Verdict::unknown, {});
}

/// Sure among the listed causes, with an unlisted misfit that is at most three times as likely as all of them.
TEST_F(Deciding, WhatIsSureAmongListedCausesLeadsBesideADoubt) {
  budget.unlisted_probability = 0.75;
  expect({rig("gain", 0.9, 0.23), rig("offset", 0.7, 0.02)}, Verdict::leading, {"gain"});
  expect({rig("gain", 0.9, 0.15), rig("offset", 0.8, 0.1)}, Verdict::indistinguishable, {"gain", "offset"});
  expect({rig("gain", 0.9, 0.22), rig("offset", 0.7, 0.03)}, Verdict::unknown, {});
  budget.unlisted_probability = 0.76;
  expect({rig("gain", 0.9, 0.24)}, Verdict::unknown, {});
  // Of a misfit that nobody cares about, the evidence has to be whole.
  budget.unlisted_probability = 0.3;
  budget.base.rms = 0.019;
  expect({rig("gain", 0.9, 0.7)}, Verdict::unknown, {});
}

/// The same mechanism in another test is another answer, and so is another state of another test.
TEST_F(Deciding, APlaceIsPartOfTheAnswer) {
  Contender here = rig("gain", 0.9, 0.5), there = rig("gain", 0.85, 0.45);
  here.place.tests = {"a"};
  there.place.tests = {"b"};
  expect({here, there}, Verdict::indistinguishable, {"gain", "gain"});
  there.place.tests = {"a"};
  expect({here, there}, Verdict::leading, {"gain", "gain"});
}

/// Each of two tests in a state of its own is the same; of three it is not.
TEST_F(Deciding, TwoTestsDifferWhicheverIsCalledAnotherState) {
  Contender here = rig("another_state", 0.98, 0.6), there = rig("another_state", 0.98, 0.39);
  here.place.tests = {"a"};
  there.place.tests = {"b"};
  budget.base_channels.resize(2);
  budget.base_channels[0].test = "a";
  budget.base_channels[1].test = "b";
  expect({here, there}, Verdict::leading, {"another_state", "another_state"});
  budget.base_channels.emplace_back().test = "c";
  expect({here, there}, Verdict::indistinguishable, {"another_state", "another_state"});
}

/// What takes as much and is a hundred times less likely is no rival beside a doubt either.
TEST_F(Deciding, EvidenceExcludesRivalsBesideADoubt) {
  budget.unlisted_probability = 0.5;
  expect({rig("gain", 0.95, 0.4899), rig("offset", 0.85, 0.0001)}, Verdict::leading, {"gain"});
  expect({rig("gain", 0.95, 0.47), rig("offset", 0.85, 0.02)}, Verdict::indistinguishable, {"gain", "offset"});
}

/// It takes 95 % and leaves 3 % of the range at most.
TEST_F(Deciding, WhatLeavesNextToNothingLeadsWhateverTheEvidence) {
  Contender term = form("stretches", 0.96, 0.1);
  term.rest.rms = 0.029;
  const Contender other = rig("gain", 0.5, 0.85);
  expect({term, other}, Verdict::leading, {"stretches"});
  expect({term, other, rig("another_state", 0.85, 1e-8)}, Verdict::leading, {"stretches"});
  expect({term, other, rig("offset", 0.85, 0.01)}, Verdict::indistinguishable, {"stretches", "offset"});
  term.rest.rms = 0.031;
  expect({term, other}, Verdict::unknown, {});
  term.rest.rms = 0.029;
  term.share = 0.94;
  expect({term, other}, Verdict::unknown, {});
  term.share = 0.96;
  budget.unlisted_probability = 0.2;
  expect({term, other}, Verdict::unknown, {});
}

TEST_F(Deciding, WhatTakesAboutAsMuchTies) {
  expect({rig("gain", 0.9, 0.9), rig("offset", 0.8, 0.05)}, Verdict::indistinguishable, {"gain", "offset"});
  expect({rig("offset", 0.9, 0.05), rig("gain", 0.8, 0.9)}, Verdict::indistinguishable, {"gain", "offset"});
}

/// Less than 1 % of the probability of one that is sure.
TEST_F(Deciding, WhatTheEvidenceExcludesIsNoRival) {
  expect({rig("gain", 0.9, 0.95), rig("offset", 0.88, 0.009)}, Verdict::leading, {"gain"});
  expect({rig("offset", 0.9, 0.009), rig("gain", 0.88, 0.95)}, Verdict::leading, {"gain"});
  expect({rig("gain", 0.9, 0.95), rig("offset", 0.88, 0.01)}, Verdict::indistinguishable, {"gain", "offset"});
  expect({rig("offset", 0.52, 0.001), rig("gain", 0.4, 0.95)}, Verdict::unknown, {});
  expect({form("I1", 0.9, 0.5), form("I2", 0.88, 0.004), rig("gain", 0.6, 0.4)}, Verdict::unknown, {});
}

TEST_F(Deciding, WhatNobodyWouldBelieveTakesNoName) {
  const auto beyond = Belief::beyond;
  expect({rig("gain", 0.9, 0.97, beyond), rig("offset", 0.7, 0.02)}, Verdict::unknown, {});
  expect({rig("gain", 0.9, 0.97, beyond), rig("offset", 0.8, 0.02)}, Verdict::indistinguishable, {"offset", "gain"});
  expect({rig("gain", 0.9, 0.005, beyond), rig("offset", 0.8, 0.95)}, Verdict::indistinguishable, {"offset", "gain"});
  expect({rig("offset", 0.9, 0.95), rig("gain", 0.85, 0.009, beyond)}, Verdict::leading, {"offset"});
}

/// It takes far less: half of the probability may be its, and no more.
TEST_F(Deciding, WhatNobodyWouldBelieveRaisesNoDoubt) {
  expect({rig("offset", 0.9, 0.76), rig("gain", 0.2, 0.2, Belief::beyond)}, Verdict::leading, {"offset"});
  expect({rig("offset", 0.9, 0.76), rig("gain", 0.2, 0.2)}, Verdict::unknown, {});
  expect({rig("offset", 0.9, 0.4), rig("gain", 0.2, 0.58, Belief::beyond)}, Verdict::unknown, {});
  expect({rig("offset", 0.9, 1e-9), rig("gain", 0.2, 1, Belief::beyond)}, Verdict::unknown, {});
}

TEST_F(Deciding, AnotherStateGivesWayToASureCauseThatTakesAsMuch) {
  expect({rig("another_state", 0.92, 0.05), rig("gain", 0.9, 0.93)}, Verdict::leading, {"gain"});
  expect({rig("another_state", 0.96, 0.05), rig("gain", 0.9, 0.93)}, Verdict::indistinguishable,
         {"gain", "another_state"});
  expect({rig("another_state", 0.96, 0.95), rig("gain", 0.9, 0.03)}, Verdict::leading, {"another_state"});
}

TEST_F(Deciding, FormsOfOneInvariantAreOneAnswer) {
  Contender exponential = form("I1 (exponential)", 0.9, 0.6), cubic = form("I1 (cubic)", 0.88, 0.38);
  exponential.sort = cubic.sort = "I1";
  expect({exponential, cubic}, Verdict::leading, {"I1 (exponential)", "I1 (cubic)"});
}

}  // namespace
}  // namespace tunica::budget
