// SPDX-License-Identifier: Apache-2.0
#include "dissection.hpp"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "factor.hpp"
#include "levels.hpp"

namespace tunica::testing::dissection_test {
namespace {

struct Case {
  const char* name;
  std::size_t order, radial, axial;
};

fe::Mesh mesh_of(const Case& is) { return {is.order, is.radial, is.axial, 3.71, 5.77, 7, 1.5, fe::Ends::clamped}; }

/// A seeded matrix on a mesh, whose diagonal is dominant and of one sign or of both, and the same one densely.
struct Pair {
  fe::Stencil stencil;
  Eigen::MatrixXd dense;

  Pair(const fe::Mesh& mesh, bool definite, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    stencil.resize(mesh);
    const auto size = static_cast<Eigen::Index>(2 * mesh.nodes());
    dense = Eigen::MatrixXd::Zero(size, size);
    const std::size_t n = mesh.order;
    for (std::size_t e = 0; e < mesh.radial; ++e)
      for (std::size_t row = 0; row < mesh.axial; ++row) {
        std::vector<std::size_t> positions;
        for (std::size_t k = row * n; k <= (row + 1) * n; ++k)
          for (std::size_t i = e * n; i <= (e + 1) * n; ++i)
            for (std::size_t d = 0; d < 2; ++d) positions.push_back(2 * mesh.node(i, k) + d);
        for (const std::size_t i : positions)
          for (const std::size_t j : positions)
            if (i >= j) add(i, j, i == j ? (definite || i % 3 != 0 ? 50 : -50) : unit(engine));
      }
  }
  void add(std::size_t i, std::size_t j, double value) {
    stencil.add(i, j, value);
    const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
    dense(row, column) += value;
    if (i != j) dense(column, row) += value;
  }
};

class DissectedMatrix : public ::testing::TestWithParam<Case> {};

/// With prescribed positions and without, on every level; the factor of before leaves nothing behind.
TEST_P(DissectedMatrix, SolvesAndCountsNegativePivotsLikeEigen) {
  const fe::Mesh mesh = mesh_of(GetParam());
  const std::size_t size = 2 * mesh.nodes(), end = mesh.planes() - 1;
  std::vector<std::size_t> fixed;
  for (std::size_t i = 0; i < mesh.across(); ++i) {
    fixed.push_back(2 * mesh.node(i, 0) + 1);
    fixed.push_back(2 * mesh.node(i, end));
    fixed.push_back(2 * mesh.node(i, end) + 1);
  }
  fe::Dissection factor;
  factor.prepare(mesh, Pair(mesh, true, 4).stencil);
  for (const bool definite : {true, false})
    for (const bool held : {false, true}) {
      Pair pair(mesh, definite, 4);
      const std::span<const std::size_t> prescribed(fixed.data(), held ? fixed.size() : 0);
      for (const std::size_t position : prescribed) {
        const auto i = static_cast<Eigen::Index>(position);
        pair.dense.row(i).setZero();
        pair.dense.col(i).setZero();
        pair.dense(i, i) = 7;
      }
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(pair.dense).eigenvalues();
      const Eigen::MatrixXd right = Eigen::MatrixXd::Random(pair.dense.rows(), 3);
      const Eigen::MatrixXd expected = pair.dense.partialPivLu().solve(right);
      for_every_level([&] {
        const auto negative = factor.factorise(pair.stencil, prescribed, 7, {});
        EXPECT_EQ(negative, static_cast<std::size_t>((values.array() < 0).count()));
        EXPECT_EQ(definite, negative == 0u);
        Eigen::MatrixXd found = right, alone = right;
        std::vector<std::span<double>> together;
        for (Eigen::Index k = 0; k < 3; ++k) together.emplace_back(found.col(k).data(), size);
        factor.solve(together);
        EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
        for (Eigen::Index k = 0; k < 3; ++k) {
          const std::span<double> one(alone.col(k).data(), size);
          factor.solve({&one, 1});
        }
        EXPECT_EQ(alone, found);
      });
    }
}

/// What is said before the memory is taken.
TEST_P(DissectedMatrix, TakesTheMemoryThatItsCostSays) {
  const fe::Mesh mesh = mesh_of(GetParam());
  const Pair pair(mesh, true, 5);
  fe::Dissection factor;
  factor.prepare(mesh, pair.stencil);
  const fe::FactorCost cost = fe::Dissection::cost(mesh);
  EXPECT_EQ(cost.kept, static_cast<double>(factor.kept()));
  EXPECT_EQ(cost.working, static_cast<double>(factor.working()));
}

INSTANTIATE_TEST_SUITE_P(All, DissectedMatrix,
                         ::testing::Values(Case{"OneElement", 1, 1, 1}, Case{"OneLeaf", 1, 4, 3},
                                           Case{"OneElementAcross", 1, 1, 40}, Case{"OneCut", 1, 4, 7},
                                           Case{"Square", 1, 13, 13}, Case{"Long", 1, 5, 30}, Case{"Wide", 1, 22, 6},
                                           Case{"NineNodes", 2, 1, 1}, Case{"NineNodesSquare", 2, 7, 6},
                                           Case{"NineNodesLong", 2, 3, 17}),
                         [](const auto& at) { return std::string(at.param.name); });

TEST(Dissection, IsTakenWhereItIsCheaperThanTheBand) {
  EXPECT_FALSE(fe::Factor::dissects(mesh_of({"", 1, 25, 50})));
  EXPECT_TRUE(fe::Factor::dissects(mesh_of({"", 1, 100, 400})));
  EXPECT_TRUE(fe::Factor::dissects(mesh_of({"", 2, 25, 100})));
  // 200 × 2000 elements take less than a third of the memory of their band.
  const fe::Mesh largest = mesh_of({"", 1, 200, 2000});
  EXPECT_LT(3 * fe::Dissection::cost(largest).bytes(),
            fe::Banded::bytes(2 * largest.nodes(), fe::Stencil::width_of(largest)));
}

TEST(Dissection, AsksWhetherItIsLateAndStops) {
  const fe::Mesh mesh = mesh_of({"", 1, 60, 200});
  fe::Stencil matrix;
  matrix.resize(mesh);
  for (std::size_t j = 0; j < matrix.size(); ++j) matrix.add(j, j, 1);
  fe::Dissection factor;
  factor.prepare(mesh, matrix);
  int asked = 0;
  EXPECT_EQ(factor.factorise(matrix, {}, 1, [&] { return ++asked == 1; }), std::nullopt);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(factor.factorise(matrix, {}, 1, [] { return false; }), std::optional<std::size_t>(0));
}

}  // namespace
}  // namespace tunica::testing::dissection_test
