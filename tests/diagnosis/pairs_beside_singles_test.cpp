// SPDX-License-Identifier: Apache-2.0
// Pairs that begin with a single mechanism as it is at finite amplitude, and take what explains most of its rest.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/groups.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;
using Side = MechanismFactory::Side;

constexpr double whatever_the_weight = -INFINITY;  ///< of a pair

/// What the rows show, of these squares; the fifth one downwards.
Eigen::VectorXd rows_of_weak_singles() {
  const std::vector<double> squares{420, 421, 419, 423, 422, 409, 408.5, 407.2, 406};
  Eigen::VectorXd shown = Eigen::Map<const Eigen::VectorXd>(squares.data(), 9).cwiseSqrt();
  shown[4] *= -1;
  return shown;
}

/// Five strong mechanisms fill the eight pairs of a quick search; four others are weaker in every pair.
struct WeakSingles : MadeUpCauses {
  WeakSingles() : MadeUpCauses({9}, rows_of_weak_singles()) {
    for (const Eigen::Index k : {0, 1, 2, 4}) add({fmt::format("s{}", k + 1), at_rows(9, {{k, 1}})});
    add({"s4", at_rows(9, {{3, -2}}), {{"a"}}, Side::positive, -1});
    add({"w1", at_rows(9, {{5, 2}}), {{"a"}}, Side::positive, 1, 2});
    add({"w2", at_rows(9, {{6, 0.5}}), {{"a"}}, Side::even});
    add({"w3", at_rows(9, {{7, 1}})});
    add({"w4", at_rows(9, {{8, 1}})});
    close();
    request.quick = true;
    singles = {single("w1"), single("w2"), single("w3"), single("w4")};
  }
  /// The pairs that come of these singles.
  [[nodiscard]] std::vector<std::string> begun() const {
    std::vector<std::string> names;
    for (const Group& group : fit_pairs(inquiry(), analysis, singles, whatever_the_weight))
      if (group.begun_from) names.push_back(names_of(group));
    return names;
  }
  std::vector<Single> singles;
};

TEST(PairsBesideSingles, AreBegunFromTheFirstThreeSinglesBesideTheThreeBestOfTheRest) {
  WeakSingles causes;
  EXPECT_THAT(causes.begun(),
              ElementsAre("w1 s4", "w2 s4", "w1 s5", "w2 s5", "w3 s4", "w1 s2", "w2 s2", "w3 s5", "w3 s2"));
  const auto groups = fit_pairs(causes.inquiry(), causes.analysis, causes.singles, whatever_the_weight);
  EXPECT_THAT(groups, SizeIs(8 + 9));
  const Group& first = causes.group_named(groups, "w1 s4");
  EXPECT_EQ(first.begun_from->additions.size(), 1u);
  EXPECT_EQ(first.additions.at(1).id, "s4");
  EXPECT_NEAR(first.amplitudes.at(0), std::sqrt(409) / 2, 1e-3) << "by 2 in its row, counted from the null";
  EXPECT_NEAR(first.amplitudes.at(1), -std::sqrt(423) / 2, 1e-3) << "s4 goes down, and by 2 in its row";
  EXPECT_NEAR(first.linear_gain, 409 + 423 + 4 * std::log(2), 1e-3);
  EXPECT_NEAR(first.log_weight, 416 + 2 * std::log(2), 1e-4);
  const Group& second = causes.group_named(groups, "w2 s4");
  EXPECT_NEAR(second.amplitudes.at(0), std::sqrt(408.5) / 0.5, 1e-2) << "the square of the amplitude, by 0.5";
  EXPECT_NEAR(second.linear_gain, 408.5 + 423 + 4 * std::log(2), 1e-2);
}

TEST(PairsBesideSingles, AreNotBegunFromWhatComesBehindASingleThatWasNotFitted) {
  WeakSingles causes;
  causes.singles[1].best.reset();
  EXPECT_THAT(causes.begun(), ElementsAre("w1 s4", "w1 s5", "w1 s2"));
}

// What is left after `front` are the rows 1 and 2: q goes up and row 1 down, so that only `both` can take it.
TEST(PairsBesideSingles, AddToASingleWhatItsSideAllows) {
  MadeUpCauses causes({3}, Eigen::Vector3d(30, -9, 0.5));
  causes.add({"front", Eigen::Vector3d(1, 0, 0)});
  causes.add({"up", Eigen::Vector3d(0, 1, 0), {{"a"}}, Side::positive});
  causes.add({"down", Eigen::Vector3d(0, 2, 0), {{"a"}}, Side::positive, -1});
  causes.add({"faint", Eigen::Vector3d(0, 0, 1), {{"a"}}, Side::positive});
  causes.close();
  const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("front")}, whatever_the_weight);
  EXPECT_THAT(causes.names_of(groups), UnorderedElementsAre("front down", "front faint", "down faint"));
}

// p and q look alike, so that no linearisation has them as a pair: what p leaves of q is half a standard deviation.
TEST(PairsBesideSingles, AddToASingleWhatIsLeftHoweverLittle) {
  MadeUpCauses causes({2}, Eigen::Vector2d(9, 0.5));
  causes.add({"p", Eigen::Vector2d(1, 0)});
  causes.add({"q", Eigen::Vector2d(std::sqrt(1 - 0.14 * 0.14), 0.14), {{"a"}}, Side::positive});
  causes.close();
  const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("p")}, whatever_the_weight);
  ASSERT_THAT(causes.names_of(groups), ElementsAre("p q"));
  EXPECT_NEAR(groups.front().linear_gain, 81 + 0.25 + 2 * std::log(2), 1e-3);
  EXPECT_NEAR(groups.front().amplitudes.back(), 0.5 / 0.14, 1e-3);
}

// Two effects that differ by 0.05 of a length of 1000. By amplitudes of 2000, far from each other, they would explain
// everything; so small a difference says nothing.
TEST(PairsBesideSingles, DoNotLiveOnADifferenceThatIsInvisible) {
  MadeUpCauses causes({3}, Eigen::Vector3d(30, 10, 5));
  causes.add({"front", Eigen::Vector3d(1000, 0, 0)});
  causes.add({"alike", Eigen::Vector3d(1000, 0.05, 0)});
  causes.add({"other", Eigen::Vector3d(0, 0, 1)});
  causes.close();
  const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("front")}, whatever_the_weight);
  EXPECT_THAT(causes.names_of(groups), UnorderedElementsAre("front other", "alike other"));
}

}  // namespace
}  // namespace tunica::diagnosis
