// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::budget {

/// Evidence beside a smooth misfit that no hypothesis lists:
///
///   r ~ N(0, Σ),  Σ = I + τ² B D Bᵀ,
///
/// B smooth shapes of each curve (assembly/curve_shapes.hpp), whitened and as high as the range of its channel; τ the
/// root mean square as a share of the range; D_k the roughness for degree k. unlisted_prior.hpp has both and what is
/// believed of them. They are summed over and not estimated: with estimates, ranks go by roughness.
class UnlistedMisfit {
 public:
  /// Shapes up to the degree, a third as many as rows at most; noise so many times as large as it is said to be.
  UnlistedMisfit(const diagnosis::Evidence& evidence, unsigned degree, double noise = 1);

  /// ln p(r) of a fit. Columns of the base are integrated over with a flat prior, in the coordinates of an orthonormal
  /// basis; those that were added with a Gaussian one of standard deviation 1 about the fit, so they come scaled by
  /// their prior width:
  ///
  ///   ln p = ln Σ_{τ,D} |Σ|^−½ |QᵀΣ⁻¹Q|^−½ |I + AᵀMA|^−½ π exp(−½ rᵀMr + ½ nᵀ(I + AᵀMA)⁻¹n),
  ///   M = Σ⁻¹ − Σ⁻¹Q(QᵀΣ⁻¹Q)⁻¹QᵀΣ⁻¹,  n = AᵀMr.
  [[nodiscard]] double log_evidence(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& base,
                                    const Eigen::MatrixXd& added) const;

  /// What the shapes leave of residuals: |r|², and how much of it is expected of noise.
  struct Rough {
    double squares, expected;
  };
  [[nodiscard]] Rough rough(const Eigen::VectorXd& residuals) const;

 private:
  struct Prior {
    Eigen::VectorXd scale;  ///< τ √D of each column
    Eigen::LLT<Eigen::MatrixXd> factor;
    double log_determinant;  ///< of Σ
    double log_weight = 0;
  };
  Eigen::MatrixXd columns_;
  Eigen::MatrixXd basis_;  ///< orthonormal, of the columns
  std::vector<Prior> priors_;
  double noise_;
};

}  // namespace tunica::budget
