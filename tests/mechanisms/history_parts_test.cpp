// SPDX-License-Identifier: Apache-2.0
// The parts of a model with memory, and the mechanisms that may rebuild an energy from them.
#include <gmock/gmock.h>

#include "deformations.hpp"
#include "shelf.hpp"
#include "tunica/models/decorated_model.hpp"

namespace tunica::testing {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> with_memory{"damage", "stress_softening", "viscoelasticity"};

TEST(HistoryModel, ForwardsThePartsOfItsBase) {
  const auto bare = model("hgo");
  for (const std::string& mechanism : with_memory) {
    const auto soft = wrapped(mechanism, model("hgo"));
    ASSERT_EQ(soft->parts().size(), bare->parts().size()) << mechanism;
    for (std::size_t k = 0; k < bare->parts().size(); ++k)
      EXPECT_EQ(soft->parts()[k]->describe().name, bare->parts()[k]->describe().name) << mechanism;
    EXPECT_GT(soft->describe().history_size, 0u) << mechanism << ": the parts say nothing of it";
  }
}

TEST(DecoratedModel, RefusesToRebuildAnEnergyThatHasMemory) {
  for (const std::string& mechanism : with_memory) {
    const std::shared_ptr<const Model> soft = wrapped(mechanism, model("neo_hooke"));
    try {
      const DecoratedModel rebuilt(soft, soft->describe().parameters, 0, {});
      FAIL() << mechanism << ": accepted";
    } catch (const std::invalid_argument& problem) {
      EXPECT_THAT(problem.what(), HasSubstr("do not carry its memory, so that no energy can be rebuilt")) << mechanism;
    }
  }
}

TEST(MechanismsOfParts, RefuseAModelWithMemoryAndSayWhatToDo) {
  for (const char* of_parts : {"fibre_dispersion", "fibre_recruitment", "matrix_stiffening"}) {
    const std::string said = refusal(of_parts, wrapped("viscoelasticity", model("hgo")));
    EXPECT_THAT(said, HasSubstr("has memory, which its parts do not carry; expected a model without memory"))
        << of_parts;
  }
}

TEST(MechanismsOfParts, AddToAModelWithMemoryInsteadOfRebuildingIt) {
  const auto soft = wrapped("viscoelasticity", model("neo_hooke"));
  const auto added = wrapped("circumferential_fibres", wrapped("viscoelasticity", model("neo_hooke")));
  EXPECT_EQ(added->describe().history_size, soft->describe().history_size) << "the memory is still there";
}

}  // namespace
}  // namespace tunica::testing
