// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "assembly/assembly.hpp"
#include "assembly/whitening.hpp"
#include "posterior/discrepancy.hpp"

namespace tunica::posterior {

/// The ingredients of the posterior of a run. Nothing in it changes while draws are made.
///
/// The likelihood is that of the intervals (whitening.hpp): r are the whitened residuals of the N fitted rows, σ that
/// of the best point. Where all noise is stated and χ² does not contradict it, ln L = −½ ‖r‖². Else one common factor s
/// of all σ is unknown, as in Student's t of the intervals. With the prior 1/s it is integrated out:
///
///   ∫ s^{−N} exp(−‖r‖²/2s²) ds/s ∝ ‖r‖^{−N},   ln L = −(N/2) ln ‖r‖²,
///
/// whose Laplace approximation is the t distribution with N − n degrees of freedom of the linearised interval (A.
/// Gelman et al., Bayesian Data Analysis, 3rd ed. (2013), section 3.2 and 14.2).
///
/// With a discrepancy the likelihood is the one of discrepancy.hpp. σ is then as stated, or as estimated without a
/// model.
///
/// A parameter with a prior has that normal density, between its bounds. Any other is uniform between its bounds in the
/// coordinate of the search: in p on a linear scale, in ln p on a logarithmic one. Where a constraint is broken, or a
/// simulation fails, the density is zero.
struct Question {
  const assembly::Assembly& assembly;
  assembly::Whitening whitening;
  bool factor_known;  ///< s = 1
  std::optional<Discrepancy> discrepancy = {};

  /// N, as a number.
  [[nodiscard]] double rows() const { return static_cast<double>(whitening.rows.size()); }
};

/// At the best point of a run; `measured` in the layout of the predictions stands in for the data unless empty. None,
/// with the reason, where that point cannot be simulated, or nothing is fitted.
std::optional<Question> question_at(const assembly::Assembly& assembly, std::span<const double> best,
                                    std::span<const double> measured, Status& status, bool discrepancy = false);

/// Where a chain may be: z in R^n, with x_j = Φ(z_j) in the unit box, so that a uniform prior is N(0, 1) in z_j. With
/// rows H = (c r, prior residuals, z), c² the slope of −ln L by ‖r‖²/2 at the centre,
///
///   ln p(z) = ln L + ln prior − ½ ‖z‖²,   which is −½ ‖H‖² where the factor is known.
///
/// With a discrepancy G r of its metric stands for c r.
struct Point {
  Eigen::VectorXd z, rows;    ///< H
  Eigen::VectorXd residuals;  ///< r
  Eigen::MatrixXd slopes;     ///< ∂H/∂z
  Eigen::VectorXd gradient;   ///< of ln p
  double log_density = 0;     ///< −∞ where a constraint is broken
};

/// The density, for one thread.
class Target {
 public:
  using Metric = Discrepancy::Metric;

  Target(const Question& question, Metric metric);
  /// `scale`: c.
  Target(const Question& question, double scale) : Target(question, Metric{scale, {}}) {}

  /// False where the simulation fails.
  bool evaluate(const Eigen::VectorXd& z, Point& point);

  [[nodiscard]] std::vector<double> free(const Eigen::VectorXd& z) const;
  [[nodiscard]] Eigen::VectorXd coordinates(std::span<const double> free) const;
  /// The metric of the header at a point.
  [[nodiscard]] Metric metric_at(const Point& point) const;

  std::size_t evaluations = 0, failures = 0;  ///< simulations, and those that failed

 private:
  const Question& question_;
  Metric metric_;
  std::size_t n_;
  assembly::WorkspacePointer workspace_;
  std::vector<double> unit_, free_, predictions_, by_free_, residuals_, jacobian_;
};

}  // namespace tunica::posterior
