// SPDX-License-Identifier: Apache-2.0
#include "budget/unlisted.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/unlisted_prior.hpp"
#include "diagnosis/evidence/misfit_size.hpp"
#include "diagnosis/evidence/projection.hpp"
#include "diagnosis/evidence/smooth_columns.hpp"
#include "diagnosis/naming/singles.hpp"

namespace tunica::budget {

namespace unlisted = assembly::unlisted;

UnlistedMisfit::UnlistedMisfit(const diagnosis::Evidence& evidence, unsigned degree, double noise) : noise_(noise) {
  const Eigen::Index rows = evidence.fit.residuals.size();
  const diagnosis::SmoothShapes shapes = diagnosis::smooth_shapes(evidence.curves, rows, degree);
  columns_ = shapes.columns;
  const Eigen::VectorXd ratios = diagnosis::MisfitSize(evidence).ranges_over_sigma();
  for (Eigen::Index k = 0; k < columns_.cols(); ++k) columns_.col(k) = columns_.col(k).cwiseProduct(ratios) / noise;
  basis_ = diagnosis::basis(columns_, 1e-8);
  const Eigen::MatrixXd squares = columns_.transpose() * columns_;
  std::vector<double> logs;
  for (const double tau : unlisted::sizes)
    for (std::size_t roughness = 0; roughness < unlisted::falls.size(); ++roughness) {
      const unlisted::Variances D(roughness, degree);
      Prior prior;
      prior.scale.resize(columns_.cols());
      for (Eigen::Index k = 0; k < columns_.cols(); ++k)
        prior.scale[k] = tau * std::sqrt(D.of(shapes.degree[static_cast<std::size_t>(k)]));
      Eigen::MatrixXd inner = prior.scale.asDiagonal() * squares * prior.scale.asDiagonal();
      inner.diagonal().array() += 1;
      prior.factor.compute(inner);
      prior.log_determinant = 2 * prior.factor.matrixLLT().diagonal().array().log().sum();
      prior.log_weight = unlisted::log_weight(tau);
      logs.push_back(prior.log_weight);
      priors_.push_back(std::move(prior));
    }
  const double all = diagnosis::log_sum(logs);
  for (Prior& prior : priors_) prior.log_weight -= all;
}

double UnlistedMisfit::log_evidence(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& base,
                                    const Eigen::MatrixXd& added) const {
  const Eigen::MatrixXd Q = diagnosis::basis(base, 1e-10);
  const Eigen::Index q = Q.cols(), a = added.cols();
  Eigen::MatrixXd all(residuals.size(), q + a + 1);
  all << Q, added / noise_, residuals / noise_;
  const Eigen::MatrixXd products = all.transpose() * all, seen = columns_.transpose() * all;
  std::vector<double> logs;
  for (const Prior& prior : priors_) {
    // [Q A r]ᵀ Σ⁻¹ [Q A r] by Woodbury's identity.
    const Eigen::MatrixXd half = prior.factor.matrixL().solve(prior.scale.asDiagonal() * seen);
    const Eigen::MatrixXd whole = products - half.transpose() * half;
    double value = prior.log_weight - prior.log_determinant / 2;
    Eigen::MatrixXd rest = whole.bottomRightCorner(a + 1, a + 1);
    if (q > 0) {
      const Eigen::LLT<Eigen::MatrixXd> of_base(whole.topLeftCorner(q, q));
      const Eigen::MatrixXd part = of_base.matrixL().solve(whole.topRightCorner(q, a + 1));
      rest -= part.transpose() * part;
      value -= of_base.matrixLLT().diagonal().array().log().sum();
    }
    value -= rest(a, a) / 2;
    if (a > 0) {
      Eigen::MatrixXd inner = rest.topLeftCorner(a, a);
      inner.diagonal().array() += 1;
      const Eigen::LLT<Eigen::MatrixXd> of_added(inner);
      value += of_added.matrixL().solve(rest.topRightCorner(a, 1)).squaredNorm() / 2;
      value -= of_added.matrixLLT().diagonal().array().log().sum();
    }
    if (std::isfinite(value)) logs.push_back(value);
  }
  return diagnosis::log_sum(logs);
}

UnlistedMisfit::Rough UnlistedMisfit::rough(const Eigen::VectorXd& residuals) const {
  return {residuals.squaredNorm() - (basis_.transpose() * residuals).squaredNorm(),
          static_cast<double>(std::max<Eigen::Index>(residuals.size() - basis_.cols(), 1))};
}

}  // namespace tunica::budget
