// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "assembly/assembly.hpp"
#include "assembly/whitening.hpp"
#include "posterior/counter_random.hpp"

namespace tunica::posterior {

/// A smooth misfit δ of unknown size beside the model, y = ŷ(p) + δ + s σ e (M. C. Kennedy, A. O'Hagan, J. R. Stat.
/// Soc. B 63:425, 2001). Over the shapes ψ of every curve δ = τ Σ_k √D_k b_k ψ_k with b ~ N(0, I), as
/// unlisted_prior.hpp has it, but for τ = 0, no misfit at all, which is as likely as all others together. With C the
/// whitened shapes in the N fitted rows, r their whitened residuals, and s = 1 or one common unknown factor of the
/// noise with the prior 1/s,
///
///   r ~ N(0, Σ),  Σ = s² I + τ² C D Cᵀ,   ln L = ln Σ_{τ,D,s} π |Σ|^{−½} exp(−½ rᵀ Σ⁻¹ r).
///
/// With an orthonormal basis Q of the columns of C, Qᵀ C D Cᵀ Q = U Λ Uᵀ, a = Qᵀ r and g = Uᵀ a
///
///   ln |Σ| = (N − q) ln s² + Σ_i ln v_i,   rᵀ Σ⁻¹ r = (‖r‖² − ‖a‖²)/s² + Σ_i g_i²/v_i,   v_i = s² + τ² Λ_i.
///
/// The range of a channel is that of its predictions at the best point, so that nothing is taken from held-out rows.
/// Rows of a measured field have no curve, and no shapes.
class Discrepancy {
 public:
  /// At the best point, whose whitened `residuals` say whether the noise can be believed. s = 1 where all of it is
  /// stated, and what the shapes leave does not contradict that.
  Discrepancy(const assembly::Assembly& assembly, const assembly::Whitening& whitening,
              std::span<const double> predictions, const Eigen::VectorXd& residuals);

  /// ln L up to a constant, and in `pull` −∂ ln L/∂r.
  double log_likelihood(const Eigen::VectorXd& r, Eigen::VectorXd& pull) const;

  /// A linear map of the residuals, G r = c (r + Q K Qᵀ r), with ‖G r‖² = rᵀ P r, P the mean of Σ⁻¹ at some r. Where
  /// r is near, −½ ‖G r‖² bends as ln L does.
  struct Metric {
    double scale = 1;       ///< c
    Eigen::MatrixXd inner;  ///< K; empty: 0
  };
  [[nodiscard]] Metric metric(const Eigen::VectorXd& r) const;
  /// G by a metric, of every column.
  void transform(const Metric& metric, Eigen::Ref<Eigen::MatrixXd> columns) const;

  /// One τ, D and s by their probability given r, and what is then known of δ at every prediction.
  struct Misfit {
    double size = 0, factor = 1;   ///< τ, s
    std::vector<double> mean, sd;  ///< of δ, in the units of the predictions
  };
  [[nodiscard]] Misfit draw(const Eigen::VectorXd& r, CounterRandom& random) const;

  [[nodiscard]] bool factor_known() const { return factors_.size() == 1; }
  /// s = 1 without a statement: shapes and parameters follow every row, and leave nothing to estimate s from.
  [[nodiscard]] bool factor_assumed() const { return factor_assumed_; }
  /// q
  [[nodiscard]] Eigen::Index shapes() const { return basis_.cols(); }

 private:
  /// All sizes and factors with one roughness; a row of the tables each.
  struct Roughness {
    std::vector<double> size, factor;
    Eigen::MatrixXd directions;    ///< U
    Eigen::MatrixXd precision;     ///< 1/v_i
    Eigen::VectorXd constant;      ///< ln π − ½ ln |Σ|
    Eigen::VectorXd of_rest;       ///< 1/s²
    Eigen::MatrixXd to_misfit;     ///< predictions × q: F D Rᵀ U, F the shapes at all predictions, C = Q R
    Eigen::VectorXd prior_square;  ///< of each prediction: Σ_k F_k² D_k
  };
  void choose_factors(const assembly::Whitening& whitening, const Eigen::VectorXd& residuals, std::size_t parameters);
  /// Probabilities of the rows of each table, and ln L; g of each.
  double weigh(const Eigen::VectorXd& r, std::vector<Eigen::VectorXd>& shares, std::vector<Eigen::VectorXd>& g) const;

  Eigen::MatrixXd basis_;  ///< Q
  std::vector<double> factors_{1};
  bool factor_assumed_ = false;
  std::vector<Roughness> kinds_;
};

}  // namespace tunica::posterior
