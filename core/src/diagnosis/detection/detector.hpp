// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/detection/noise_draws.hpp"
#include "diagnosis/detection/shapes.hpp"
#include "diagnosis/hypotheses/directions.hpp"

namespace tunica::diagnosis {

constexpr double smooth_price = 4;  ///< what a p-value of Q costs against one of B

/// The results of the two tests on residuals.
struct Detection {
  double p = 1;                       ///< of the smaller of the two, calibrated
  double smooth = 1, mechanisms = 1;  ///< of the smooth omnibus and of the mechanisms, each by itself
  double Q = 0;
  std::vector<double> by_candidate;    ///< p-value of the largest score of each; 1 where it has none
  std::vector<std::size_t> direction;  ///< the direction of that score
  std::vector<double> by_curve;        ///< p-value of the smooth shapes of each curve
};

/// The two tests for anything at all, calibrated by draws, and what each says: the smooth omnibus Q = |B̃ᵀr|², and the
/// marginal likelihood of all mechanisms against nothing,
///
///   B = ln mean over candidates of Σ share · exp(T/2) · {1 two-sided, 2Φ(√T) one-sided},
///
/// The largest term of B is the largest score; B has more power than this score alone if several candidates respond to
/// the same effect. The smaller of p_B and 4 p_Q is calibrated against its own distribution. Q detects shapes that no
/// mechanism produces.
class Detector {
 public:
  /// `draws` from noise_draws.
  Detector(const Projection& projection, std::vector<Direction> directions, std::size_t candidate_count,
           const Shapes& shapes, const Draws& draws);

  /// `precision`: of residuals simulated with σ = 1 in rows whose σ was then estimated as σ̂, (σ/σ̂)² by row. The scores
  /// are those of rows weighed by it,
  ///
  ///   t = Σ u w r / √(Σ u² w),
  ///
  /// to first order in w − 1 what a fit and signatures whitened by σ̂ would give.
  [[nodiscard]] Detection test(const Eigen::VectorXd& given, const Eigen::VectorXd& precision = {}) const;
  /// The score at which a candidate alone raises an alarm of this level.
  [[nodiscard]] double threshold(std::size_t candidate, double alpha) const;
  /// P-value of the largest score of one candidate under the null.
  [[nodiscard]] double candidate_p(std::size_t candidate, double T) const;
  /// The mean gain of the best mechanism under the null.
  [[nodiscard]] double gain_of_nothing() const { return gain_of_nothing_; }

 private:
  /// Projections of draws onto the smooth shapes and the directions (a column each).
  struct Seen {
    Eigen::VectorXf Q;
    Eigen::MatrixXf t;
  };
  [[nodiscard]] Seen seen_of(const Projection& projection, const Draws& draws) const;
  [[nodiscard]] double smooth_p(double Q) const;
  [[nodiscard]] double mechanisms_p(double B) const;

  std::vector<Direction> directions_;
  std::size_t candidates_;
  Eigen::MatrixXd smooth_;  ///< orthonormal
  std::vector<Eigen::MatrixXd> smooth_by_curve_;
  double smooth_scale_ = 1, gain_of_nothing_ = 0;
  std::vector<double> multiplicity_;  ///< K of p = K · P(χ²₁ > T) by candidate
  std::size_t visible_ = 0;           ///< candidates with a direction
  std::vector<float> smallest_;       ///< min(p_B, 4 p_Q) of the draws, ascending
  std::vector<float> likelihoods_;    ///< B of the draws, ascending
};

}  // namespace tunica::diagnosis
