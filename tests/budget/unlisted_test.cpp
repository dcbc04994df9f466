// SPDX-License-Identifier: Apache-2.0
// The evidence beside an unlisted misfit, against the same integrals written out with dense matrices.
#include "budget/unlisted.hpp"

#include <array>
#include <cmath>
#include <functional>

#include <Eigen/Dense>
#include <gmock/gmock.h>

#include "diagnosis/evidence/smooth_columns.hpp"
#include "diagnosis/hand_made.hpp"

namespace tunica::budget {
namespace {

using ::testing::DoubleNear;

/// 24 rows from 0 to 12 kPa with σ = 0.2.
struct Curve : diagnosis::HandMade {
  Curve() {
    std::vector<double> x, y;
    for (int i = 0; i < 24; ++i) {
      x.push_back(i);
      y.push_back(12.0 * i / 23);
    }
    add("s", x, y, {0.2, 0, 0}, diagnosis::NoiseSource::Kind::stated);
    close();
  }
};

/// ln N(r; 0, I + τ²BDBᵀ + c QQᵀ + AAᵀ) as c grows, without what does not depend on the hypothesis; summed over τ and
/// D.
double dense(const Curve& bed, const Eigen::VectorXd& r, const Eigen::MatrixXd& base, const Eigen::MatrixXd& added) {
  const auto shapes = diagnosis::smooth_shapes(bed.evidence.curves, r.size(), 6);
  const Eigen::MatrixXd B = shapes.columns * (12 / 0.2);
  double total = 0, weights = 0;
  const Eigen::MatrixXd Q = base.householderQr().householderQ() * Eigen::MatrixXd::Identity(r.size(), base.cols());
  for (const double tau : {0.0025, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32})
    for (const auto& roughness : std::array<std::function<double(double)>, 6>{
             [](double k) { return 1 / ((1 + k) * (1 + k)); }, [](double k) { return std::pow(1 + k, -4); },
             [](double k) { return std::exp(-1.5 * k); }, [](double k) { return std::exp(-k * k / (2 * 1.5 * 1.5)); },
             [](double k) { return std::exp(-k * k / (2 * 3 * 3)); },
             [](double k) { return std::exp(-k * k / (2 * 6 * 6)); }}) {
      Eigen::VectorXd D(B.cols());
      double height = 0;
      for (Eigen::Index k = 0; k < B.cols(); ++k) {
        const double degree = shapes.degree[static_cast<std::size_t>(k)];
        D[k] = roughness(degree);
        height += D[k] / (2 * degree + 1);
      }
      D /= height;
      Eigen::MatrixXd S = tau * tau * B * D.asDiagonal() * B.transpose() + added * added.transpose();
      S.diagonal().array() += 1;
      const Eigen::MatrixXd inverse = S.inverse();
      const Eigen::MatrixXd inner = Q.transpose() * inverse * Q;
      const Eigen::VectorXd Qr = Q.transpose() * inverse * r;
      const double value = -0.5 * std::log(S.determinant()) - 0.5 * std::log(inner.determinant()) -
                           0.5 * (r.dot(inverse * r) - Qr.dot(inner.inverse() * Qr));
      const double weight = std::exp(-0.5 * std::pow(std::log(tau / 0.02) / 0.7, 2));
      total += weight * std::exp(value);
      weights += weight;
    }
  return std::log(total / weights);
}

TEST(UnlistedMisfit, HasTheEvidenceOfTheIntegralsWrittenOut) {
  const Curve bed;
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(24, -1, 1);
  Eigen::VectorXd r = 2 * diagnosis::rough(24, 1) + 3 * u.array().square().matrix() - 2 * u;
  Eigen::MatrixXd base(24, 2), added(24, 1);
  base << Eigen::VectorXd::Ones(24), 4 * u;
  added << 5 * (u.array() * 2).exp().matrix();
  const UnlistedMisfit unlisted(bed.evidence, 6);
  EXPECT_THAT(unlisted.log_evidence(r, base, Eigen::MatrixXd(24, 0)),
              DoubleNear(dense(bed, r, base, Eigen::MatrixXd::Zero(24, 1)), 1e-8));
  EXPECT_THAT(unlisted.log_evidence(r, base, added), DoubleNear(dense(bed, r, base, added), 1e-8));
}

TEST(UnlistedMisfit, PaysForASmoothMisfitAndMoreForARoughOne) {
  const Curve bed;
  const UnlistedMisfit unlisted(bed.evidence, 6);
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(24, -1, 1);
  const Eigen::MatrixXd base = Eigen::VectorXd::Ones(24), none(24, 0);
  const Eigen::VectorXd noise = diagnosis::rough(24, 1);
  const double clean = unlisted.log_evidence(noise, base, none);
  const double smooth = unlisted.log_evidence(noise + 8 * u, base, none);
  const double rough = unlisted.log_evidence(noise + 8 * diagnosis::rough(24, 3), base, none);
  EXPECT_GT(clean, smooth);
  EXPECT_GT(smooth, rough + 100);
}

TEST(UnlistedMisfit, TellsWhatItsShapesLeave) {
  const Curve bed;
  const UnlistedMisfit unlisted(bed.evidence, 6);
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(24, -1, 1);
  EXPECT_THAT(unlisted.rough(10 * u.array().cube().matrix()).squares, DoubleNear(0, 1e-8));
  EXPECT_EQ(unlisted.rough(u).expected, 24 - 7) << "degrees 0 to 6";
}

}  // namespace
}  // namespace tunica::budget
