// SPDX-License-Identifier: Apache-2.0
// Fibres are looked for beside an isotropic base where strips along two directions answer differently, and only there.
#include <algorithm>

#include <gmock/gmock.h>

#include "budget/discover.hpp"
#include "diagnosis/evidence/anisotropy.hpp"
#include "diagnosis/measured.hpp"
#include "discovery/discovery.hpp"

namespace tunica::trial {
namespace {

using diagnosis::Verdict;

/// Two strips of a tissue, and an isotropic base.
struct TwoStrips : Measured {
  explicit TwoStrips(const nlohmann::json& truth)
      : Measured({{"circumferential", testing::evenly(1.02, 1.4, 25), 0.3},
                  {"axial", testing::evenly(1.02, 1.4, 25), 0.3}}) {
    experiment["models"] = {{"tissue", {{"type", "neo_hooke"}, {"parameters", {{"mu", {{"initial", 20}}}}}}}};
    experiment["runs"] = {{{"model", "tissue"}, {"optimizer", "lm"}}};
    measure(7, [&](nlohmann::json& whole) { whole["models"]["tissue"] = truth; });
    save();
  }
};

discovery::Discovery discovered(const Measured& measured, bool from_nothing) {
  const auto experiment = measured.read();
  discovery::Request request = discovery::request_of(experiment);
  request.from_nothing = from_nothing;
  request.quick = true;
  return budget::discover(experiment, request, testing::catalogue());
}

bool offers_fibres(const discovery::Discovery& found) {
  return std::any_of(found.terms.begin(), found.terms.end(), [](const discovery::FoundTerm& term) {
    return term.kind->invariant_words().starts_with("fibre");
  });
}

bool says_that_directions_differ(const discovery::Discovery& found) {
  return std::any_of(found.judgement.reasons.begin(), found.judgement.reasons.end(),
                     [](const auto& reason) { return reason.kind == discovery::ReasonKind::anisotropy_seen; });
}

TEST(TwoDirections, OfAWallOfFibresCallForFibres) {
  const nlohmann::json wall = {
      {"type", "hgo"},
      {"parameters",
       {{"mu", {{"fixed", 10}}}, {"k1", {{"fixed", 20}}}, {"k2", {{"fixed", 1}}}, {"theta", {{"fixed", "30 deg"}}}}}};
  const TwoStrips measured(wall);
  for (const bool from_nothing : {true, false}) {
    const discovery::Discovery found = discovered(measured, from_nothing);
    EXPECT_TRUE(says_that_directions_differ(found)) << from_nothing;
    EXPECT_TRUE(offers_fibres(found)) << from_nothing;
    EXPECT_THAT(found.judgement.verdict, ::testing::AnyOf(Verdict::discovered, Verdict::leading)) << from_nothing;
  }
}

TEST(TwoDirections, ThatAnswerAlikeCallForNone) {
  const TwoStrips measured(nlohmann::json{
      {"type", "yeoh"}, {"parameters", {{"c10", {{"fixed", 10}}}, {"c20", {{"fixed", 5}}}, {"c30", {{"fixed", 20}}}}}});
  for (const bool from_nothing : {true, false}) {
    const discovery::Discovery found = discovered(measured, from_nothing);
    EXPECT_FALSE(says_that_directions_differ(found)) << from_nothing;
    EXPECT_FALSE(offers_fibres(found)) << from_nothing;
  }
}

}  // namespace
}  // namespace tunica::trial
