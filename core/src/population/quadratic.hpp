// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace tunica::population {

/// A log likelihood that is quadratic in z: −2 ln L(z) = constant − 2 scoreᵀ z + zᵀ information z. The information may
/// be singular: what the data do not say, other specimens may.
struct Quadratic {
  Eigen::MatrixXd information;
  Eigen::VectorXd score;
  double constant = 0;

  static Quadratic zero(Eigen::Index size);
  Quadratic& operator+=(const Quadratic& other);
  [[nodiscard]] Eigen::Index size() const { return score.size(); }
  [[nodiscard]] double at(const Eigen::VectorXd& z) const;
};

/// The same of one specimen about where it peaks: −2 ln L(ξ) = constant + (ξ − mode)ᵀ information (ξ − mode). Kept so,
/// because a specimen that is known well has terms in ξ that are huge and cancel.
struct Peak {
  Eigen::MatrixXd information;
  Eigen::VectorXd mode;  ///< one of several where the information is singular
  double constant = 0;
};

/// What is left of a quadratic in (x, b) when b ~ N(0, Ω) is integrated out; x are its first coordinates. With
/// A the block of b, M = (I + AΩ)⁻¹ and V = ΩM,
///
///   information = A_xx − A_xb V A_bx,   score = s_x − A_xb V s_b,   constant += ln|I + AΩ| − s_bᵀ V s_b.
///
/// Neither A nor Ω has to be regular.
Quadratic integrated(const Quadratic& joint, const Eigen::MatrixXd& omega);

/// The same of a specimen with ξ = x + b, where it deviates from its mean x by b ~ N(0, Ω):
/// W = (I + AΩ)⁻¹A about the same mode, constant += ln|I + AΩ|.
Quadratic about_mean(const Peak& specimen, const Eigen::MatrixXd& omega);

/// q(D z): the quadratic of a linear map.
Quadratic mapped(const Quadratic& of_image, const Eigen::MatrixXd& map);

/// A normal distribution.
struct Gaussian {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// ξ given the data of a specimen, where ξ ~ N(mean, Ω) before: mean + V A (mode − mean), with covariance
/// V = Ω(I + AΩ)⁻¹.
Gaussian posterior(const Peak& specimen, const Eigen::VectorXd& mean, const Eigen::MatrixXd& omega);

}  // namespace tunica::population
