// SPDX-License-Identifier: Apache-2.0
// A search from nothing begins with one term, and with nothing of the model that the file has.
#include <gmock/gmock.h>

#include "discovery/subject.hpp"
#include "support/loaded.hpp"

namespace tunica::discovery {
namespace {

using ::testing::IsEmpty;

TEST(FirstTerm, StandsInThePlaceOfTheModelAndOfAllThatBelongsToIt) {
  experiment::ModelEntry wall{"wall", "gho", {}, {{"mu", {}}}, {{"fibre_dispersion", {}, {}, {}}}};
  wall.options.set("angles", "mean");
  experiment::Experiment given;
  given.models = {wall, wall};
  given.models[1].name = "other";
  const experiment::Experiment found = with_first_terms(given, "wall", false, *testing::catalogue().term_model());
  const experiment::ModelEntry& first = found.models.at(0);
  EXPECT_EQ(first.name, "wall");
  EXPECT_EQ(first.type, "composed");
  EXPECT_FALSE(first.options.has("angles"));
  EXPECT_EQ(first.options.text("terms"), R"([{"name":"I1_linear","invariant":"I1","law":"linear"}])");
  EXPECT_THAT(first.parameters, IsEmpty());
  EXPECT_THAT(first.mechanisms, IsEmpty());
  EXPECT_EQ(found.models.at(1).type, "gho") << "another model stays";
  EXPECT_TRUE(found.models.at(1).options.has("angles"));
}

TEST(FirstTerm, HasOneOfTheVolumeBesideItWhereTheMaterialChangesIt) {
  experiment::Experiment given;
  given.models = {{"foam", "hyperfoam", {}, {}, {}}};
  const experiment::Experiment found = with_first_terms(given, "foam", true, *testing::catalogue().term_model());
  EXPECT_EQ(found.models.front().options.text("terms"),
            R"([{"name":"I1bar_linear","invariant":"I1bar","law":"linear"},)"
            R"({"name":"J_quadratic","invariant":"J","law":"quadratic"}])");
}

}  // namespace
}  // namespace tunica::discovery
