// SPDX-License-Identifier: Apache-2.0
// What "discovery" and `added_term` refuse, and how they say it.
#include <gmock/gmock.h>

#include "discover/rubber.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::HasSubstr;

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
