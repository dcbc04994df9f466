// SPDX-License-Identifier: Apache-2.0
// Where the fits of single mechanisms begin, and from where they are searched for again.
#include <cmath>
#include <map>
#include <mutex>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/singles.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using Side = MechanismFactory::Side;

/// Amplitudes, as distances from the null, at which mechanisms were asked for their effect.
class AskedAmplitudes {
 public:
  std::function<double(double)> recorder(const std::string& id) {
    return [this, id](double distance) {
      const std::scoped_lock lock(mutex_);
      at[id].push_back(distance);
      return distance;
    };
  }
  std::map<std::string, std::vector<double>> at;

 private:
  std::mutex mutex_;
};

TEST(StartsOfSingles, BeginWhereTheScoreSaysOrATenthOfAStandardErrorBesideTheNull) {
  AskedAmplitudes asked;
  MadeUpCauses causes({3}, Eigen::Vector3d(6, 0.5, -7));
  const auto add = [&](const std::string& id, Eigen::Index row, double sign) {
    MadeUp one{id, at_rows(3, {{row, 4}}), {{"a"}}, Side::positive, sign, 2};
    one.by = asked.recorder(id);
    causes.add(one);
  };
  add("up", 0, 1);
  add("little", 1, 1);
  add("wrong_way", 2, 1);
  add("down", 0, -1);
  causes.close();
  asked.at.clear();
  fit_singles(causes.inquiry(), causes.analysis);
  EXPECT_THAT(asked.at["up"], Contains(DoubleNear(1.5, 1e-9)));
  EXPECT_THAT(asked.at["little"], Contains(DoubleNear(0.125, 1e-9)));
  EXPECT_THAT(asked.at["wrong_way"], Contains(DoubleNear(0.025, 1e-9)));
  EXPECT_THAT(asked.at["down"], Contains(DoubleNear(-0.025, 1e-9)));
}

/// Three tests of one row, of which one mechanism shows in each by itself or in all together.
struct FarOut : OneRowEach {
  explicit FarOut(AskedAmplitudes& asked, double sign = 1) : OneRowEach({100, 90, 80}) {
    MadeUp one{"m", at_rows(3, {{0, 1}, {1, 1}, {2, 1}}), {{"a"}, {"b"}, {"c"}, {"a", "b"}, {"b", "c"}}};
    one.sign = sign;
    one.null = 3;
    one.declare = [](MechanismFactory& factory) {
      factory.plausible_min = -97;
      factory.plausible_max = 303;
    };
    one.by = asked.recorder("m");
    add(one);
    close();
  }
  Hypothesis& hypothesis(std::size_t place) { return analysis.hypotheses.candidates.front().hypotheses[place]; }
  /// How many fits begin from half of the largest plausible amplitude, of those that are marked.
  std::size_t far_jobs(const std::vector<std::size_t>& marked) {
    for (std::size_t place = 0; place < 5; ++place) hypothesis(place).at_large = false;
    run();
    const std::size_t without = jobs();
    for (const std::size_t place : marked) hypothesis(place).at_large = true;
    run();
    return jobs() - without;
  }
};

TEST(StartsOfSingles, WhoseShapeChangesBeginFarOutToo) {
  for (const auto& [sign, expected] : {std::pair{1.0, 150.0}, std::pair{-1.0, -50.0}}) {
    AskedAmplitudes asked;
    FarOut causes(asked, sign);
    asked.at.clear();
    causes.run();
    EXPECT_THAT(asked.at["m"], ::testing::Not(Contains(DoubleNear(expected, 1e-9))));
    causes.hypothesis(0).at_large = true;
    causes.run();
    EXPECT_THAT(asked.at["m"], Contains(DoubleNear(expected, 1e-9))) << sign;
  }
}

TEST(StartsOfSingles, BeginFarOutInAllTestsAtOnceWhereTheyMay) {
  AskedAmplitudes asked;
  FarOut causes(asked);
  EXPECT_EQ(causes.far_jobs({}), 0u);
  EXPECT_EQ(causes.far_jobs({0}), 1u);
  EXPECT_EQ(causes.far_jobs({0, 1}), 2u);
  EXPECT_EQ(causes.far_jobs({0, 1, 2}), 2u) << "two at most";
  EXPECT_EQ(causes.far_jobs({0, 1, 2, 3}), 1u) << "two tests at once";
  EXPECT_EQ(causes.far_jobs({0, 3, 4}), 2u);
  MechanismFactory with_memory = *causes.hypothesis(0).mechanism;
  with_memory.stage = Stage::history;
  causes.hypothesis(0).mechanism = &with_memory;
  EXPECT_EQ(causes.far_jobs({0, 1}), 1u) << "not what has memory";
}

// Alone, the first place is fitted; of the three others that are far below it, the two best from far out. The third is
// taken to gain half of its score, as the first does.
TEST(StartsOfSingles, BeginFarOutInTheirTwoBestPlaces) {
  OneRowEach causes({60, 62, 61, 100});
  causes.add_everywhere("m", {10, 10, 10, 1}, 10 - std::sqrt(50));
  causes.close();
  for (std::size_t place = 0; place < 3; ++place)
    causes.analysis.hypotheses.candidates.front().hypotheses[place].at_large = true;
  const std::vector<Single> singles = causes.run();
  EXPECT_EQ(causes.jobs(), 3u);
  EXPECT_NEAR(singles[0].log_weight,
              std::log((std::exp(50 / 2.0) + std::exp(62 / 2.0) + std::exp(61 / 2.0) + std::exp(0.5 * 60 / 2)) / 4),
              1e-4);
}

// Every row asks for more of a than its bound allows. A search begins again from twelve random places at least, a fit
// of what adds up needs fewer predictions than that.
TEST(StartsOfSingles, AreSearchedForAgainWhereAParameterLiesAtABound) {
  AskedAmplitudes asked;
  OneRowEach causes({110, 103, 102, 104, 101, 106, 105, 107, 108});
  for (Eigen::Index k = 0; k < 9; ++k) {
    MadeUp one{fmt::format("m{}", k), at_rows(9, {{k, 1}}), {{OneRowEach::test_of(k)}}};
    one.by = asked.recorder(one.id);
    causes.add(one);
  }
  causes.free("a", 0, 1);
  causes.close();
  ASSERT_TRUE(at_a_bound(causes.analysis.evidence.fit));
  causes.request.quick = true;
  asked.at.clear();
  causes.run();
  std::vector<std::string> again;
  for (const auto& [id, distances] : asked.at)
    if (distances.size() > 3 * 12) again.push_back(id);  // three at a prediction
  EXPECT_THAT(again, ElementsAre("m0", "m3", "m5", "m6", "m7", "m8")) << "the six best";
}

/// Through (0, 0), where its slope is 1, a summit of 12 at 3, a valley of 4 at 7, a lower summit of 7 at 10, and down.
double two_summits(double d) {
  constexpr double at[] = {0, 3, 7, 10, 14}, height[] = {0, 12, 4, 7, 0};
  if (d <= 0) return d;
  for (int k = 0; k < 4; ++k)
    if (d < at[k + 1]) {
      const double length = at[k + 1] - at[k], t = (d - at[k]) / length;
      const double start = k == 0 ? t * (1 - t) * (1 - t) * length : 0;  // of slope 1
      return start + height[k] + (height[k + 1] - height[k]) * t * t * (3 - 2 * t);
    }
  return 0;
}

// The amplitude of 10.2 that the score of the second row promises leads to the lower summit, 3.2 short of it: worse
// than the first row, until the search begins again between there and the null.
TEST(StartsOfSingles, KeepWhatIsBestAfterTheSecondSearch) {
  MadeUpCauses causes({1, 1, 1}, Eigen::Vector3d(10, 10.2, 1));
  MadeUp one{"m", Eigen::Vector3d(4, 1, 0), {{"a"}, {"b"}}};
  one.by = two_summits;
  causes.add(one);
  causes.free("a", 0, 1);
  causes.close();
  causes.request.quick = true;
  const Single first = causes.single("m", 0), second = causes.single("m", 1);
  EXPECT_NEAR(first.best->fit.chi2, 10.2 * 10.2 + 1, 1e-3);
  ASSERT_NEAR(second.best->fit.chi2, 100 + 3.2 * 3.2 + 1, 1e-3);
  const std::vector<Single> singles = fit_singles(causes.inquiry(), causes.analysis);
  EXPECT_NEAR(singles[0].best->fit.chi2, 100 + 1, 1e-3);
  EXPECT_EQ(singles[0].direction, causes.direction("m", 1));
}

}  // namespace
}  // namespace tunica::diagnosis
