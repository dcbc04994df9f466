// SPDX-License-Identifier: Apache-2.0
#include "banded.hpp"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "levels.hpp"

namespace tunica::testing::banded_test {
namespace {

struct Case {
  std::size_t size, width;
};

/// A seeded band matrix, indefinite or (by a dominant diagonal) definite, and the same one densely.
struct Pair {
  fe::Banded banded;
  Eigen::MatrixXd dense;

  Pair(const Case& is, double diagonal, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    banded.resize(is.size, is.width);
    dense = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(is.size), static_cast<Eigen::Index>(is.size));
    for (std::size_t j = 0; j < is.size; ++j)
      for (std::size_t i = j; i <= std::min(j + is.width, is.size - 1); ++i) {
        const double sign = diagonal < 0 && j % 3 == 0 ? -1 : 1;
        const double value = i == j ? sign * std::abs(diagonal) + unit(engine) : unit(engine);
        i % 2 == 0 ? banded.add(i, j, value) : banded.add(j, i, value);
        dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = value;
        dense(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = value;
      }
  }
};

std::size_t negative_eigenvalues(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
  return static_cast<std::size_t>((values.array() < 0).count());
}

double dominant(const Case& is) { return 3 * static_cast<double>(is.width + 1); }

class BandedMatrix : public ::testing::TestWithParam<Case> {};

TEST_P(BandedMatrix, MultipliesLikeADenseOne) {
  const Pair pair(GetParam(), 1, 3);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(pair.dense.rows(), -1, 2), expected = pair.dense * x;
  std::vector<double> y(GetParam().size, 7);
  pair.banded.multiply({x.data(), GetParam().size}, y);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], expected[static_cast<Eigen::Index>(i)], 1e-13 * 50);
}

/// Dominant diagonals of one sign, and of both: no pivoting is needed for either.
TEST_P(BandedMatrix, SolvesAndCountsNegativePivotsLikeEigen) {
  for (const double diagonal : {dominant(GetParam()), -dominant(GetParam())}) {
    Pair pair(GetParam(), diagonal, 4);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(pair.dense.rows(), 1, -3);
    const Eigen::VectorXd expected = Eigen::LDLT<Eigen::MatrixXd>(pair.dense).solve(b);
    EXPECT_EQ(pair.banded.factorise(), negative_eigenvalues(pair.dense));
    std::vector<double> x(b.data(), b.data() + b.size());
    pair.banded.solve(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(x[i], expected[static_cast<Eigen::Index>(i)], 1e-12 * expected.cwiseAbs().maxCoeff()) << i;
  }
}

/// Every level to rounding, several right sides as each of them alone to the last bit.
TEST_P(BandedMatrix, SolvesTheSameOnEveryVectorLevelAndForSeveralRightSides) {
  for_every_level([&] {
    Pair pair(GetParam(), dominant(GetParam()), 7);
    const Eigen::LDLT<Eigen::MatrixXd> exact(pair.dense);
    pair.banded.factorise();
    std::vector<std::vector<double>> x, alone;
    for (std::size_t k = 0; k < 3; ++k) {
      x.emplace_back(GetParam().size, static_cast<double>(k));
      x[k][GetParam().size / 2] = -1;
    }
    alone = x;
    std::vector<std::span<double>> all(x.begin(), x.end());
    pair.banded.solve(all);
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::VectorXd expected =
          exact.solve(Eigen::Map<const Eigen::VectorXd>(alone[k].data(), pair.dense.rows()));
      for (std::size_t i = 0; i < x[k].size(); ++i)
        EXPECT_NEAR(x[k][i], expected[static_cast<Eigen::Index>(i)], 1e-13 * expected.cwiseAbs().maxCoeff()) << i;
      pair.banded.solve(alone[k]);
      EXPECT_EQ(alone[k], x[k]);
    }
  });
}

/// What is asked in between decides, and only for matrices that take a while.
TEST(Banded, GivesUpWhereTheTimeIsOver) {
  fe::Banded matrix;
  matrix.resize(4000, 1000);
  for (std::size_t j = 0; j < matrix.size(); ++j) matrix.add(j, j, 1);
  int asked = 0;
  EXPECT_FALSE(matrix.factorise([&asked] { return ++asked == 3; }).has_value());
  EXPECT_EQ(asked, 3);
}

TEST_P(BandedMatrix, CanBeFactorisedAgainAfterItIsCleared) {
  Pair pair(GetParam(), dominant(GetParam()), 5);
  const Pair same(GetParam(), dominant(GetParam()), 5);
  pair.banded.factorise();
  pair.banded.clear();
  for (std::size_t j = 0; j < pair.banded.size(); ++j)
    for (std::size_t i = j; i <= std::min(j + pair.banded.width(), pair.banded.size() - 1); ++i)
      pair.banded.add(i, j, pair.dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  for (std::size_t j = 0; j < pair.banded.size(); ++j)
    for (std::size_t i = 0; i <= pair.banded.width(); ++i)
      EXPECT_EQ(pair.banded.column(j)[i], same.banded.column(j)[i]) << i << ", " << j;
}

TEST_P(BandedMatrix, FixesARowAndItsColumn) {
  const Case is = GetParam();
  const std::size_t fixed = is.size / 2;
  Pair pair(is, dominant(is), 6);
  pair.banded.fix(fixed, 2.5);
  const auto at = static_cast<Eigen::Index>(fixed);
  pair.dense.row(at).setZero();
  pair.dense.col(at).setZero();
  pair.dense(at, at) = 2.5;
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(pair.dense.rows(), -1, 2), expected = pair.dense * x;
  std::vector<double> y(is.size);
  pair.banded.multiply({x.data(), is.size}, y);
  for (std::size_t i = 0; i < y.size(); ++i)
    EXPECT_NEAR(y[i], expected[static_cast<Eigen::Index>(i)], 1e-13 * dominant(is));
}

// Widths as four- and nine-node meshes have them, sizes of every remainder by the panel of eight, one panel alone.
INSTANTIATE_TEST_SUITE_P(Sizes, BandedMatrix,
                         ::testing::Values(Case{24, 7}, Case{25, 7}, Case{26, 7}, Case{27, 8}, Case{28, 9},
                                           Case{29, 15}, Case{30, 16}, Case{31, 17}, Case{4, 3}, Case{5, 4}, Case{8, 7},
                                           Case{7, 3}, Case{6, 9}, Case{201, 57}, Case{322, 105}));

TEST(BandedMatrix, AZeroPivotLeavesNumbersThatAreNotFinite) {
  fe::Banded matrix;
  matrix.resize(6, 3);
  for (std::size_t i = 0; i < 6; ++i) matrix.add(i, i, i == 2 ? 0 : 1);
  matrix.factorise();
  std::vector<double> x(6, 1);
  matrix.solve(x);
  EXPECT_FALSE(std::isfinite(x[2]));
}

}  // namespace
}  // namespace tunica::testing::banded_test
