// SPDX-License-Identifier: Apache-2.0
// Groups that are fitted: which members they need, what that takes from fits that have been made, and what is searched
// for again where the base fit ended at a bound.
#include "diagnosis/naming/group_fits.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::SizeIs;

constexpr double ends = 1e-4;  ///< of |r|²: a fit ends where a step promises 1e-6

/// "m0", "m1", … that show in a row each, and what the data show there. Behind them come eight rows that pull the
/// parameter a down; where it may not go, the base fit is at a bound.
struct Rows : MadeUpCauses {
  static constexpr int pulling = 8;
  static constexpr double pulled = -60;

  explicit Rows(const std::vector<double>& shown, bool at_a_bound = false)
      : MadeUpCauses({static_cast<int>(shown.size()) + pulling}, beyond(shown)), size(beyond(shown).size()) {
    if (at_a_bound) free("a", 1, 50);
  }
  void add_row(Eigen::Index row, const std::function<double(double)>& by = {}) {
    MadeUp one{"m" + std::to_string(row), at_rows(size, {{row, 1}})};
    one.by = by;
    add(one);
  }
  [[nodiscard]] Group group(const std::vector<std::string>& ids) const {
    Group made;
    for (const std::string& id : ids) {
      const std::size_t k = direction(id);
      made.directions.push_back(k);
      made.additions.push_back(analysis.hypotheses.hypothesis(k).addition);
      made.amplitudes.push_back(score(analysis.hypotheses.directions[k], -analysis.evidence.fit.residuals).amplitude);
    }
    return made;
  }
  /// A single mechanism that is said to have left so much.
  [[nodiscard]] Single known(const std::string& id, double squares) const {
    Single one = single(id);
    one.best->fit.chi2 = squares;
    return one;
  }
  [[nodiscard]] std::vector<Group> refitted(std::vector<Group> groups, const std::vector<Single>& singles = {}) const {
    return GroupFits(inquiry(), analysis, singles).refitted(std::move(groups), 0, 1);
  }
  Eigen::Index size;

 private:
  static Eigen::VectorXd beyond(const std::vector<double>& shown) {
    Eigen::VectorXd all = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(shown.size()) + pulling, pulled);
    all.head(static_cast<Eigen::Index>(shown.size())) =
        Eigen::Map<const Eigen::VectorXd>(shown.data(), static_cast<Eigen::Index>(shown.size()));
    return all;
  }
};
constexpr double always_left = Rows::pulling * Rows::pulled * Rows::pulled;

TEST(GroupFits, TakeWhatAMemberLeavesAloneFromItsOwnFit) {
  Rows causes({10, 8, 6});
  for (Eigen::Index row = 0; row < 3; ++row) causes.add_row(row);
  causes.close();
  const std::vector<Group> found = causes.refitted(
      {causes.group({"m0", "m1"})}, {causes.known("m2", always_left + 5000), causes.known("m0", always_left + 1234)});
  ASSERT_THAT(found, SizeIs(1));
  const double left = always_left + 36;
  EXPECT_NEAR(found[0].refit->fit.chi2, left, ends);
  EXPECT_THAT(found[0].losses, ElementsAre(DoubleNear(100, ends), DoubleNear(1234 - 36, ends)));
}

TEST(GroupFits, FitWhatTwoOfThreeMembersLeave) {
  Rows causes({10, 8, 6});
  for (Eigen::Index row = 0; row < 3; ++row) causes.add_row(row);
  causes.close();
  const std::vector<Group> found =
      causes.refitted({causes.group({"m0", "m1", "m2"})},
                      {causes.known("m0", always_left + 1234), causes.known("m1", always_left + 1234)});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].losses, ElementsAre(DoubleNear(100, ends), DoubleNear(64, ends), DoubleNear(36, ends)));
}

TEST(GroupFits, TakeNoFitOfAnotherPlace) {
  MadeUpCauses causes({1, 1}, Eigen::Vector2d(10, 8));
  causes.add({"m", Eigen::Vector2d(1, 1), {{"a"}, {"b"}}});
  causes.add({"n", Eigen::Vector2d(0, 1), {{"b"}}});
  causes.close();
  Single elsewhere = causes.single("m", 1);
  elsewhere.best->fit.chi2 = 1234;
  const std::vector<Single> singles{elsewhere};
  const Group group = causes.group_of({causes.direction("m", 0), causes.direction("n")});
  const std::vector<Group> found = GroupFits(causes.inquiry(), causes.analysis, singles).refitted({group}, 0, 1);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].losses, ElementsAre(DoubleNear(100, ends), DoubleNear(64, ends)));
}

TEST(GroupFits, LeaveOutWhatCannotBeEvaluated) {
  Rows causes({10, 8, 6});
  causes.add_row(0);
  causes.add_row(1);
  causes.add_row(2, [](double distance) { return distance == 0 ? 0 : NAN; });
  causes.close();
  const std::vector<Group> found = causes.refitted({causes.group({"m0", "m2"}), causes.group({"m0", "m1"})});
  EXPECT_EQ(causes.names_of(found), std::vector<std::string>{"m0 m1"});
}

/// Up to 20 an effect of 4 at most, which a fit from the null ends at; further out any effect.
double wavy(double distance) {
  return 4 * std::sin(std::numbers::pi * distance / 20) + std::max(0.0, distance - 20) / 10;
}

TEST(GroupFits, SearchAgainWhereTheBaseFitIsAtABound) {
  for (const bool at_a_bound : {false, true}) {
    Rows causes({10, 8}, at_a_bound);
    causes.add_row(0, wavy);
    causes.add_row(1);
    causes.close();
    const std::vector<Group> found = causes.refitted(
        {causes.group({"m0", "m1"})}, {causes.known("m0", always_left + 5000), causes.known("m1", always_left + 6000)});
    ASSERT_THAT(found, SizeIs(1));
    const double left = at_a_bound ? 0 : 36;
    EXPECT_NEAR(found[0].refit->fit.chi2, always_left + left, ends) << at_a_bound;
    // Nor is then believed what was fitted before.
    EXPECT_THAT(found[0].losses, at_a_bound
                                     ? ElementsAre(DoubleNear(100, ends), DoubleNear(64, ends))
                                     : ElementsAre(DoubleNear(6000 - left, ends), DoubleNear(5000 - left, ends)));
  }
}

// m0 … m7 explain 400 each, so that all pairs weigh the same and stay in the order they come in.
TEST(GroupFits, SearchAgainForMembersOfTheFirstSixGroupsAlone) {
  Rows causes(std::vector<double>(14, 20), true);
  for (Eigen::Index row = 0; row < 14; ++row) causes.add_row(row);
  causes.close();
  std::vector<Group> groups;
  std::vector<Single> singles;
  for (int k = 0; k < 7; ++k) {
    groups.push_back(causes.group({"m" + std::to_string(2 * k), "m" + std::to_string(2 * k + 1)}));
    singles.push_back(causes.known("m" + std::to_string(2 * k), 1e5));
  }
  const std::vector<Group> found = causes.refitted(groups, singles);
  ASSERT_THAT(found, SizeIs(7));
  for (std::size_t g = 0; g < 7; ++g)
    EXPECT_NEAR(found[g].losses[1], g < 6 ? 400 : 1e5 - found[g].refit->fit.chi2, 1e-3) << g;
}

/// Six pairs, of which so many need both members, and a seventh that is less likely by 20.
std::vector<std::string> kept_of_seven(std::size_t needed) {
  std::vector<double> shown;
  for (std::size_t k = 0; k < 6; ++k) shown.insert(shown.end(), {20, k < needed ? 20.0 : 1.0});
  for (std::size_t k = 1; k < 12; k += 2)
    if (shown[k] == 1) shown[k - 1] = std::sqrt(799);  // as likely as the others
  shown.insert(shown.end(), {20, std::sqrt(360)});
  Rows causes(shown);
  for (Eigen::Index row = 0; row < 14; ++row) causes.add_row(row);
  causes.close();
  causes.calibrate_by_noise();
  std::vector<Group> groups;
  for (int k = 0; k < 7; ++k)
    groups.push_back(causes.group({"m" + std::to_string(2 * k), "m" + std::to_string(2 * k + 1)}));
  return causes.names_of(causes.refitted(groups));
}

TEST(GroupFits, FarBelowThreeThatStandAreNotAskedFor) {
  EXPECT_EQ(kept_of_seven(2), (std::vector<std::string>{"m0 m1", "m2 m3", "m12 m13"}));
  EXPECT_EQ(kept_of_seven(3), (std::vector<std::string>{"m0 m1", "m2 m3", "m4 m5"}));
}

}  // namespace
}  // namespace tunica::diagnosis
