// SPDX-License-Identifier: Apache-2.0
// The correlation of neighbouring rows beside the matrices of its header, written out.
#include "diagnosis/evidence/row_correlation.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "assembly/restricted_variance.hpp"
#include "diagnosis/hand_made.hpp"

namespace tunica::diagnosis::row_correlation_test {
namespace {

constexpr std::size_t known = assembly::known_variance;

/// Curves of these rows of their tests, one behind the other, and a span of smooth columns.
Evidence evidence_of(const std::vector<std::vector<std::size_t>>& rows, const std::vector<std::size_t>& group,
                     Eigen::Index columns) {
  Evidence evidence;
  for (const auto& own : rows) {
    Curve curve;
    curve.first = evidence.curves.empty() ? 0 : evidence.curves.back().first + evidence.curves.back().count;
    curve.count = static_cast<Eigen::Index>(own.size());
    curve.rows = own;
    evidence.curves.push_back(curve);
  }
  const auto n = static_cast<Eigen::Index>(group.size());
  Eigen::MatrixXd X(n, columns);
  for (Eigen::Index k = 0; k < columns; ++k)
    X.col(k) = Eigen::ArrayXd::LinSpaced(n, -1, 1).pow(static_cast<double>(k)) +
               0.3 * rough(n, 1.0 + static_cast<double>(k)).array();
  evidence.estimated.span = X.householderQr().householderQ() * Eigen::MatrixXd::Identity(n, columns);
  evidence.estimated.group = group;
  return evidence;
}

Fit fit_of(const Eigen::VectorXd& residuals) {
  Fit fit;
  fit.residuals = residuals;
  return fit;
}

/// rᵀPKPr / 2 tr(PKPK) and 1/√(2 tr(PKPK)), of the pairs of neighbours (the first of each).
RowCorrelation by_matrices(const Evidence& evidence, const std::vector<Eigen::Index>& pairs, const Eigen::VectorXd& r) {
  const Eigen::Index n = r.size();
  const Eigen::MatrixXd& Q = evidence.estimated.span;
  const Eigen::MatrixXd P = Eigen::MatrixXd::Identity(n, n) - Q * Q.transpose();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n), D = M;
  for (const Eigen::Index i : pairs) {
    M(i, i + 1) = M(i + 1, i) = 0.5;
    D(i, i) = D(i + 1, i + 1) = 1;
  }
  const Eigen::MatrixXd K = M - D * ((P * M).trace() / (P * D).trace());
  const double spread = (P * K * P * K).trace();
  return {r.dot(P * K * P * r) / (2 * spread), 1 / std::sqrt(2 * spread)};
}

void expect_same(const Evidence& evidence, const std::vector<Eigen::Index>& pairs) {
  const Eigen::VectorXd r = rough(static_cast<Eigen::Index>(evidence.estimated.group.size()), 3);
  const auto found = row_correlation(evidence, fit_of(r));
  const RowCorrelation expected = by_matrices(evidence, pairs, r);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, expected.value, 1e-12);
  EXPECT_NEAR(found->sd, expected.sd, 1e-12);
}

TEST(RowCorrelationByHand, IsOfAllNeighboursOfACurve) {
  const std::vector<std::size_t> rows{0, 1, 2, 3, 4, 5, 6};
  expect_same(evidence_of({rows}, std::vector<std::size_t>(7, 0), 2), {0, 1, 2, 3, 4, 5});
  expect_same(evidence_of({rows}, std::vector<std::size_t>(7, 0), 1), {0, 1, 2, 3, 4, 5});
}

// Rows 4 and 6 of the first test have one between them that is held out; the curves are no neighbours of each other.
TEST(RowCorrelationByHand, IsNotAcrossGapsNorCurves) {
  expect_same(evidence_of({{2, 3, 4, 6, 7}, {8, 9, 10, 11}}, std::vector<std::size_t>(9, 0), 2), {0, 1, 3, 5, 6, 7});
}

TEST(RowCorrelationByHand, IsOfRowsWhoseNoiseIsEstimated) {
  const std::vector<std::size_t> rows{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  expect_same(evidence_of({rows}, {known, 0, 0, 0, 0, known, 0, 0, 0, known}, 2), {1, 2, 3, 6, 7});
}

TEST(RowCorrelationByHand, IsNoneWhereNothingIsEstimatedOrLeft) {
  const std::vector<std::size_t> rows{0, 1, 2, 3};
  const std::vector<std::size_t> group(4, 0);
  EXPECT_FALSE(row_correlation(evidence_of({rows}, group, 0), fit_of(rough(4, 1))));
  EXPECT_FALSE(row_correlation(evidence_of({rows}, group, 3), fit_of(rough(4, 1)))) << "one degree of freedom";
  EXPECT_FALSE(row_correlation(evidence_of({rows}, {0, known, 0, known}, 1), fit_of(rough(4, 1)))) << "no neighbours";
}

}  // namespace
}  // namespace tunica::diagnosis::row_correlation_test
