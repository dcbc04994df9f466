// SPDX-License-Identifier: Apache-2.0
// What "discovery" and `added_term` refuse, and how they say it.
#include <gmock/gmock.h>

#include "discover/rubber.hpp"
#include "discovery/common/common_discovery.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

namespace {

std::string refusal(const trial::Rubber& rubber) {
  try {
    (void)rubber.read();
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "";
}

}  // namespace

TEST(DiscoveryBlock, NamesWhatIsWrongAndWhatToWrite) {
  trial::Rubber rubber;
  rubber.experiment["discovery"] = {{"invariants", {"I3"}}};
  EXPECT_THAT(refusal(rubber), AllOf(HasSubstr("I3"), HasSubstr("/discovery/invariants/0"), HasSubstr("I2")));
  rubber.experiment["discovery"] = {{"laws", {"logaritm"}}};
  EXPECT_THAT(refusal(rubber), AllOf(HasSubstr("logaritm"), HasSubstr("logarithm")));
  rubber.experiment["discovery"] = {{"most_terms", 0}};
  EXPECT_THAT(refusal(rubber), AllOf(HasSubstr("most_terms is 0"), HasSubstr("from 1 to 6")));
  rubber.experiment["discovery"] = {{"from_nothing", "yes"}};
  EXPECT_THAT(refusal(rubber), HasSubstr("/discovery/from_nothing"));
  rubber.experiment["discovery"] = {{"terms", 2}};
  EXPECT_THAT(refusal(rubber), AllOf(HasSubstr("terms"), HasSubstr("most_terms")));
  rubber.experiment["discovery"] = {{"from_nothing", true}, {"most_parameters", 4}, {"model", "rubber"}};
  EXPECT_EQ(refusal(rubber), "");
}

TEST(DiscoveryFromNothing, RefusesASpecimenInSeveralStates) {
  trial::Rubber rubber;
  rubber.experiment["discovery"] = {{"model", "rubber"}};
  rubber.experiment["states"] = {{"warm", {{"parameters", {{"mu", nlohmann::json::object()}}}}}};
  rubber.experiment["tests"]["pure_shear"]["state"] = "warm";
  rubber.measure(7);
  const auto words = AllOf(HasSubstr("'pure_shear'"), HasSubstr("'warm'"), HasSubstr("Leave \"from_nothing\" out"));
  EXPECT_THAT([&] { (void)rubber.discover(true); }, ThrowsMessage<InputError>(words));
  const auto read = rubber.read();
  discovery::Request request = discovery::request_of(read);
  const std::vector<discovery::Member> members{{"one", read}};
  request.from_nothing = true;
  EXPECT_THAT([&] { (void)discovery::discover_together(members, request, tunica::testing::catalogue()); },
              ThrowsMessage<InputError>(words));
}

TEST(DiscoveryFromNothing, TakesTheTestsOfOneStateOfSeveral) {
  trial::Rubber rubber;
  rubber.experiment["discovery"] = {{"model", "rubber"}};
  rubber.experiment["states"] = {{"warm", {{"parameters", {{"mu", nlohmann::json::object()}}}}}};
  rubber.experiment["tests"]["pure_shear"]["state"] = "warm";
  rubber.experiment["runs"][0]["tests"] = {"circumferential", "equibiaxial"};
  rubber.measure(7);
  EXPECT_TRUE(rubber.discover(true).best.has_value());
}

TEST(AddedTermRefusal, SaysWhichLawSuitsTheInvariant) {
  trial::Rubber rubber;
  rubber.experiment["models"]["rubber"]["mechanisms"] = {
      {{"type", "added_term"}, {"invariant", "fibre"}, {"law", "linear"}}};
  EXPECT_THAT(refusal(rubber), AllOf(HasSubstr("pulls at rest"), HasSubstr("Take quadratic")));
  rubber.experiment["models"]["rubber"]["mechanisms"] = {
      {{"type", "added_term"}, {"invariant", "I1"}, {"law", "spline"}, {"knots", {1, 2}}}};
  EXPECT_THAT(refusal(rubber), HasSubstr("rising list that begins at 0"));
  rubber.experiment["models"]["rubber"]["mechanisms"] = {
      {{"type", "added_term"}, {"invariant", "I1"}, {"law", "gent"}, {"parameters", {{"b", {{"initial", 1}}}}}}};
  EXPECT_THAT(refusal(rubber), AllOf(HasSubstr("'b'"), HasSubstr("Jm")));
}
