// SPDX-License-Identifier: Apache-2.0
// What no energy explains: residuals written down here that differ between rows of the same strain.
#include "discovery/history.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "discover/paths_of.hpp"
#include "numerics/distributions.hpp"

namespace tunica::discovery::history_test {
namespace {

using ::testing::HasSubstr;

using trial::PathsOf;

/// Up to 1.5 in ten steps, and back to where it began.
std::vector<double> there_and_back() {
  std::vector<double> stretch;
  for (int i = 0; i <= 10; ++i) stretch.push_back(1 + 0.05 * i);
  for (int i = 9; i >= 0; --i) stretch.push_back(1 + 0.05 * i);
  return stretch;
}

/// An opening that is linear in the stretch is 3 of the shapes of each branch by itself (of degree 2) and none of those
/// in common; what both branches share, however rough, takes no part.
TEST(PathDependence, IsTheDifferenceOfBranches) {
  const PathsOf paths({{"axial", there_and_back()}});
  double of_opening = 0, of_both = 0;
  const auto opening = [](std::size_t row, double stretch) { return (row <= 10 ? 8 : -8) * (1.5 - stretch); };
  const auto rough = [](double stretch) { return 3 * std::cos(60 * stretch); };
  const std::vector<double> stretch = there_and_back();
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    of_opening += std::pow(opening(i, stretch[i]), 2);
    of_both += std::pow(opening(i, stretch[i]) + rough(stretch[i]), 2);
  }
  const PathDependence found =
      paths.with([&](const std::string&, std::size_t row, double x) { return opening(row, x) + rough(x); });
  EXPECT_TRUE(found.branches);
  EXPECT_EQ(found.where, "loading and unloading in the test 'axial'");
  // The row at 1.5 is on one branch alone, so that the shapes of both are not quite apart.
  EXPECT_NEAR(found.chi2, of_opening, 0.2 * of_opening);
  EXPECT_NEAR(found.p_value, numerics::chi_squared_above(found.chi2, 3), 1e-12);
  EXPECT_NEAR(found.share, (found.chi2 - 3) / (of_both - paths.rows()), 1e-12);
  const PathDependence alone =
      paths.with([&](const std::string&, std::size_t row, double x) { return opening(row, x); });
  EXPECT_NEAR(alone.chi2, of_opening, 1e-9 * of_opening);
  EXPECT_EQ(alone.share, 1) << "never more";
  const PathDependence common = paths.with([&](const std::string&, std::size_t, double x) { return 9 * x * x * x; });
  EXPECT_NEAR(common.chi2, 0, 1e-9);
  EXPECT_NEAR(common.p_value, 1, 1e-3);
}

/// Without a misfit beyond noise there is nothing to have a share of.
TEST(PathDependence, HasNoShareOfNothing) {
  const PathsOf paths({{"axial", there_and_back()}});
  EXPECT_EQ(paths.with([](const std::string&, std::size_t, double) { return 0.5; }).share, 0);
}

TEST(PathDependence, TurnsWhereTheStretchGoesBackByATwentieth) {
  const auto opens = [](const std::string&, std::size_t row, double) { return row < 8 ? 4. : -4.; };
  const std::vector<double> wobbling{1,   1.05, 1.1,  1.15, 1.2, 1.25, 1.3,  1.35, 1.33,
                                     1.4, 1.38, 1.45, 1.43, 1.5, 1.48, 1.55, 1.53, 1.6};
  const PathDependence one = PathsOf({{"axial", wobbling}}).with(opens);
  EXPECT_EQ(one.chi2, 0);
  EXPECT_EQ(one.p_value, 1);
  EXPECT_EQ(one.where, "");
  // Downwards first, then up again.
  std::vector<double> down = there_and_back();
  for (double& stretch : down) stretch = 2.5 - stretch;
  const PathDependence other =
      PathsOf({{"axial", down}}).with([](const std::string&, std::size_t row, double) { return row <= 10 ? 4. : -4.; });
  EXPECT_TRUE(other.branches);
  EXPECT_LT(other.p_value, 1e-4);
}

TEST(PathDependence, IsTheDifferenceOfTestsThatAreAlike) {
  const auto opens = [](const std::string& test, std::size_t, double x) { return test == "axial" ? 6 * x : -6 * x; };
  const PathsOf alike({{.name = "axial"}, {.name = "axial_2"}});
  const PathDependence found = alike.with(opens);
  EXPECT_FALSE(found.branches);
  EXPECT_EQ(found.where, "the tests 'axial' and 'axial_2', which are alike in all that an energy sees");
  EXPECT_TRUE(found.decides());
  EXPECT_NEAR(found.p_value, numerics::chi_squared_above(found.chi2, 3), 1e-12);
  const PathsOf apart({{.name = "axial"}, {.name = "circumferential"}});
  EXPECT_EQ(apart.with(opens).p_value, 1) << "another strain";
  EXPECT_EQ(apart.with(opens).share, 0);
}

/// Of several groups the worst is named; all count.
TEST(PathDependence, NamesTheWorst) {
  const PathsOf paths({{"axial", there_and_back()}, {"circumferential", there_and_back()}});
  const auto opens = [](double axial, double other) {
    return [=](const std::string& test, std::size_t row, double x) {
      return (row <= 10 ? 1 : -1) * (1.5 - x) * (test == "axial" ? axial : other);
    };
  };
  const PathDependence first = paths.with(opens(20, 10)), second = paths.with(opens(10, 20));
  EXPECT_THAT(first.where, HasSubstr("'axial'"));
  EXPECT_THAT(second.where, HasSubstr("'circumferential'"));
  EXPECT_NEAR(first.chi2, second.chi2, 1e-9 * first.chi2);
  EXPECT_NEAR(first.chi2, 1.25 * paths.with(opens(20, 0)).chi2, 1e-9 * first.chi2);
  EXPECT_NEAR(first.p_value, numerics::chi_squared_above(first.chi2, 6), 1e-12);
}

}  // namespace
}  // namespace tunica::discovery::history_test
