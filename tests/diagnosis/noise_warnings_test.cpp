// SPDX-License-Identifier: Apache-2.0
// Warnings of noise that vanishes near zero, and of noise that is larger than the residuals allow; and what is left of
// columns off others. Residuals as written down here.
#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/evidence/large_noise.hpp"
#include "diagnosis/evidence/projection.hpp"
#include "diagnosis/evidence/vanishing_noise.hpp"
#include "diagnosis/hand_made.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis::noise_warnings_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr data::Noise tenth{.absolute = 0, .relative = 0.1};

std::vector<double> numbered(std::size_t count) {
  std::vector<double> x;
  for (std::size_t i = 0; i < count; ++i) x.push_back(static_cast<double>(i));
  return x;
}

struct Written : HandMade {
  void residuals(const std::string& name, const std::vector<double>& r) {
    const Curve& of = curve(name);
    for (std::size_t i = 0; i < r.size(); ++i) evidence.fit.residuals[of.first + static_cast<Eigen::Index>(i)] = r[i];
  }
  [[nodiscard]] std::string vanishing() const {
    const auto warning = vanishing_noise_warning(evidence);
    EXPECT_TRUE(!warning || warning->kind == WarningKind::noise_vanishes);
    return warning ? warning->text : "";
  }
};

/// Three readings of 1 among seven of 10, with a tenth as noise.
std::string of_three_small(const std::vector<double>& r, const data::Noise& noise = tenth) {
  Written made;
  made.add("a", numbered(10), {1, 10, 10, 1, 10, 10, 10, 10, 1, 10}, noise);
  made.close();
  made.residuals("a", r);
  return made.vanishing();
}

TEST(NoiseThatVanishes, IsToldWithTheShareOfItsRows) {
  EXPECT_THAT(of_three_small({5, 1, 1, 5, 1, 1, 1, 1, 5, 1}), HasSubstr("a, y (3 of 10 rows carry 91 % of its |r|²)"));
  EXPECT_EQ(of_three_small({5, 1, 1, 5, 1, 1, 1, 1, 5, 1}, {.absolute = 1e-3, .relative = 0.1}), "");
}

TEST(NoiseThatVanishes, HasToCarryHalf) {
  EXPECT_THAT(of_three_small({5, 3.2, 3.2, 5, 3.2, 3.2, 3.2, 3.2, 5, 3.2}), HasSubstr("carry 51 %"));
  EXPECT_EQ(of_three_small({5, 3.4, 3.4, 5, 3.4, 3.4, 3.4, 3.4, 5, 3.4}), "") << "75 of 156";
}

TEST(NoiseThatVanishes, HasToBeThreeARow) {
  EXPECT_THAT(of_three_small({1.74, 0, 0, 1.74, 0, 0, 0, 0, 1.74, 0}), HasSubstr("carry 100 %"));
  EXPECT_EQ(of_three_small({1.72, 0, 0, 1.72, 0, 0, 0, 0, 1.72, 0}), "") << "8.9 in three rows";
}

/// The median of ten readings is the sixth, 10; below 3 they are near zero.
TEST(NoiseThatVanishes, IsBelowThreeTenthsOfTheMedian) {
  Written made;
  made.add("a", numbered(10), {40, 2.9, 20, 3.1, 9, 1, 9.5, 50, 10, 30}, tenth);
  made.close();
  made.residuals("a", {0, 9, 0, 1, 0, 9, 0, 0, 0, 0});
  EXPECT_THAT(made.vanishing(), HasSubstr("(2 of 10 rows carry 99 %"));
}

/// Each channel by itself, and channels that are held out have no residuals.
TEST(NoiseThatVanishes, IsToldOfEveryChannelThatIsFitted) {
  Written made;
  const std::vector<double> y{1, 10, 10, 10, 10}, large{9, 1, 1, 1, 1}, small{1, 1, 1, 1, 1};
  for (const char* name : {"a", "b", "c", "d", "e"}) made.add(name, numbered(5), y, tenth);
  made.experiment.tests[0].hold_out.all = true;
  made.experiment.tests[2].data.noise = {{"y", {.absolute = 1}}};
  made.experiment.tests[4].hold_out.all = true;
  made.close();
  made.residuals("b", large);
  made.residuals("c", large);
  made.residuals("d", large);
  EXPECT_THAT(made.vanishing(), HasSubstr("b, y (1 of 5 rows carry 95 % of its |r|²); d, y (1 of 5"));
  made.residuals("b", small);
  EXPECT_THAT(made.vanishing(), AllOf(HasSubstr("d, y ("), Not(HasSubstr("b, y ("))));
  made.residuals("d", small);
  EXPECT_EQ(made.vanishing(), "");
}

/// Twenty rows of each test, all residuals alike; a warning comes below 1 % of the channels.
std::string of_alike(const std::vector<double>& each, double freedom = 0,
                     NoiseSource::Kind kind = NoiseSource::Kind::stated, bool constant = false) {
  Written made;
  const std::vector<std::string> names{"a", "b", "c"};
  for (std::size_t k = 0; k < each.size(); ++k)
    made.add(names[k], numbered(20), std::vector<double>(20, 1), {.absolute = 1}, kind);
  made.close();
  for (std::size_t k = 0; k < each.size(); ++k) {
    made.residuals(names[k], std::vector<double>(20, each[k]));
    made.source(names[k]).freedom = freedom;
    made.evidence.curves[k].noise.freedom = freedom;
  }
  if (constant) made.add_column(made.in_curve("a", Eigen::VectorXd::Ones(20)));
  const auto warning = large_noise_warning(made.evidence, made.evidence.fit);
  EXPECT_TRUE(!warning || warning->kind == WarningKind::noise_too_large);
  return warning ? warning->text : "";
}

/// The root mean square at which the lower tail of χ² or F is p.
double level(double p, double rows, double freedom = 0) {
  double low = 0, high = 1;
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2, squares = middle * middle;
    const double tail =
        freedom > 0 ? numerics::f_below(squares, rows, freedom) : numerics::chi_squared_below(squares * rows, rows);
    (tail < p ? low : high) = middle;
  }
  return low;
}

TEST(NoiseThatIsTooLarge, IsToldBelowOnePercent) {
  EXPECT_THAT(of_alike({0.3}), HasSubstr("a, y (0.30 σ)"));
  EXPECT_NE(of_alike({0.999 * level(0.01, 20)}), "");
  EXPECT_EQ(of_alike({1.001 * level(0.01, 20)}), "");
}

TEST(NoiseThatIsTooLarge, SharesTheLevelAmongChannels) {
  EXPECT_NE(of_alike({0.999 * level(0.01 / 3, 20), 1, 1}), "");
  EXPECT_EQ(of_alike({1.001 * level(0.01 / 3, 20), 1, 1}), "");
  EXPECT_THAT(of_alike({0.3, 1, 0.2}), HasSubstr("a, y (0.30 σ); c, y (0.20 σ). "));
}

/// σ̂ itself may be off.
TEST(NoiseThatIsTooLarge, AllowsForNoiseThatIsOnlyEstimated) {
  ASSERT_LT(level(0.01, 20, 6), 0.9 * level(0.01, 20));
  EXPECT_NE(of_alike({0.999 * level(0.01, 20, 6)}, 6), "");
  EXPECT_EQ(of_alike({1.001 * level(0.01, 20, 6)}, 6), "");
}

/// What the fit absorbs is no row: a constant leaves 19 of 20.
TEST(NoiseThatIsTooLarge, CountsRowsWithoutThoseThatTheFitTakes) {
  const double to_19 = std::sqrt(19. / 20);
  EXPECT_NE(of_alike({0.999 * to_19 * level(0.01, 19)}, 0, NoiseSource::Kind::stated, true), "");
  EXPECT_EQ(of_alike({1.001 * to_19 * level(0.01, 19)}, 0, NoiseSource::Kind::stated, true), "");
  EXPECT_THAT(of_alike({0.3}, 0, NoiseSource::Kind::stated, true), HasSubstr("(0.31 σ)"));
  // A fit through every row says nothing of them.
  Written made;
  made.add("a", {0, 1}, {1, 1}, {.absolute = 1}, NoiseSource::Kind::stated);
  made.close();
  made.source("a").freedom = made.evidence.curves[0].noise.freedom = 0;
  made.add_column(Eigen::Vector2d(1, 0));
  made.add_column(Eigen::Vector2d(0, 1));
  EXPECT_FALSE(large_noise_warning(made.evidence, made.evidence.fit));
}

TEST(NoiseThatIsTooLarge, IsToBeStatedWhereItIsNot) {
  EXPECT_THAT(of_alike({0.3}), HasSubstr("within one test, without differences between specimens"));
  EXPECT_THAT(of_alike({0.3}, 0, NoiseSource::Kind::replicates), HasSubstr("State noise.absolute and noise.relative"));
}

TEST(Basis, LeavesOutColumnsThatAreNothingBesideOthers) {
  Eigen::MatrixXd columns(3, 4);
  columns << 0, 2e-9, 1e4, 0, /**/ 0, 0, 0, 1e-9, /**/ 0, 0, 0, 0;
  EXPECT_EQ(basis(columns, 1e-8).cols(), 1) << "1e-9 is below 1e-12 of 1e4, and the second is the third";
  columns(1, 3) = 1e-7;
  const Eigen::MatrixXd two = basis(columns, 1e-8);
  ASSERT_EQ(two.cols(), 2) << "lengths do not count beyond that";
  EXPECT_LT((two.transpose() * two - Eigen::Matrix2d::Identity()).norm(), 1e-14);
  EXPECT_EQ(basis(Eigen::MatrixXd::Zero(3, 2), 1e-8).cols(), 0);
  EXPECT_EQ(basis(Eigen::MatrixXd::Zero(3, 2), 1e-8).rows(), 3);
}

TEST(Projection, TakesColumnsThatDifferByLittleForOne) {
  const auto left_of = [](double differ) {
    Eigen::MatrixXd J(3, 2);
    J << 1, 1, 0, differ, 0, 0;
    return Projection(J).off(Eigen::Vector3d(1, 1, 1)).norm();
  };
  EXPECT_NEAR(left_of(1e-6), 1, 1e-9) << "two directions are taken off";
  EXPECT_NEAR(left_of(1e-9), std::sqrt(2), 1e-6) << "one is";
  EXPECT_EQ(Projection(Eigen::MatrixXd(3, 0)).off(Eigen::Vector3d(1, 2, 3)), Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace tunica::diagnosis::noise_warnings_test
