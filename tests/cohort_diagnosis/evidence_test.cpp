// SPDX-License-Identifier: Apache-2.0
// Evidence of specimens that were measured and diagnosed.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "cohort_diagnosis/combination.hpp"
#include "cohort_diagnosis/evidence_json.hpp"
#include "diagnosis/measured.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort_diagnosis {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// Two strips of a wall with axial fibres, which gho does not have.
struct WithAxialFibres : trial::Measured {
  explicit WithAxialFibres(std::uint64_t seed) : Measured({{.sd = 0.6}, {.name = "axial", .sd = 0.6}}) {
    measure(seed, [](nlohmann::json& truth) {
      truth["models"]["gho"]["mechanisms"] = {trial::mechanism("axial_fibres", "k", 1.5)};
    });
    save();
  }
  [[nodiscard]] SpecimenEvidence evidence(const std::string& id) const {
    return evidence_of(id, read(), diagnose(), testing::catalogue());
  }
};

TEST(Evidence, ReadsBackBitForBit) {
  const SpecimenEvidence found = WithAxialFibres(21).evidence("a");
  ASSERT_FALSE(found.profiles.empty());
  const std::string text = to_json(found).dump();
  EXPECT_EQ(evidence_from_json(nlohmann::ordered_json::parse(text), "a.json"), found);
}

TEST(Evidence, IsTheSameForAnyNumberOfThreads) {
  const WithAxialFibres measured(21);
  const SpecimenEvidence found = measured.evidence("a");
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(measured.evidence("a"), found);
}

TEST(Evidence, DoesNotGrowWithTheRows) {
  trial::Measured few({{.stretch = testing::evenly(1.02, 1.6, 20)}, {.name = "axial"}});
  trial::Measured many({{.stretch = testing::evenly(1.02, 1.6, 400)}, {.name = "axial"}});
  few.measure(3);
  many.measure(3);
  std::size_t sizes[2];
  for (const auto& [measured, size] : {std::pair{&few, &sizes[0]}, {&many, &sizes[1]}}) {
    measured->save();
    *size = to_json(evidence_of("a", measured->read(), measured->diagnose(), testing::catalogue())).dump().size();
  }
  EXPECT_LT(static_cast<double>(sizes[1]), 1.5 * static_cast<double>(sizes[0]));
}

TEST(Evidence, OfOneSpecimenGivesThatSpecimensAnswer) {
  const WithAxialFibres measured(21);
  const SpecimenEvidence found = measured.evidence("a");
  const CohortVerdict verdict = combine(std::array{found});
  EXPECT_NEAR(verdict.p_value, found.p_value, 1e-9 + 1e-6 * found.p_value);
  ASSERT_FALSE(verdict.explanations.empty());
  ASSERT_FALSE(found.causes.empty());
  EXPECT_EQ(verdict.explanations.front().ids, found.causes);
}

TEST(Evidence, OfEightSpecimensNamesTheFibres) {
  std::vector<SpecimenEvidence> cohort;
  for (std::uint64_t seed = 31; seed < 39; ++seed)
    cohort.push_back(WithAxialFibres(seed).evidence("s" + std::to_string(seed)));
  const CohortVerdict verdict = combine(cohort);
  EXPECT_TRUE(verdict.alarm);
  EXPECT_THAT(verdict.ambiguity_set, Contains("axial_fibres"));
  ASSERT_EQ(verdict.explanations.front().ids, std::vector<std::string>{"axial_fibres"});
}

TEST(Evidence, RefusesWhatIsNoRecord) {
  const auto refused = [](const char* text) -> std::string {
    try {
      (void)evidence_from_json(nlohmann::ordered_json::parse(text), "shard_3.json");
    } catch (const InputError& problem) {
      return problem.what();
    }
    return "";
  };
  EXPECT_THAT(refused("{}"), HasSubstr("expected the evidence of a specimen as this version writes it"));
  EXPECT_THAT(refused(R"({"format": 7})"), HasSubstr("shard_3.json: found a record of another format"));
}

}  // namespace
}  // namespace tunica::cohort_diagnosis
