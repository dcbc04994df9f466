// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "population/cohort.hpp"
#include "text/codes.hpp"

namespace tunica::population {

enum class Shape { diagonal, full };
inline constexpr text::Codes<Shape, 2> shape_codes = {{{Shape::diagonal, "diagonal"}, {Shape::full, "full"}}};

enum class ShapeReason { stated, enough, too_few };
inline constexpr text::Codes<ShapeReason, 3> shape_reason_codes = {
    {{ShapeReason::stated, "stated"}, {ShapeReason::enough, "enough_units"}, {ShapeReason::too_few, "too_few_units"}}};

struct ChosenShape {
  Shape shape = Shape::diagonal;
  ShapeReason reason = ShapeReason::too_few;
};
/// A full covariance of p parameters where `freedom`, units less columns of the design, is 5 p at least: a correlation
/// needs about that many. One parameter has no correlation.
ChosenShape choose(std::optional<Shape> stated, std::size_t parameters, double freedom);

/// What a linear mixed model draws from. Ω = within withinᵀ, Ω_a = between betweenᵀ.
struct Variances {
  Eigen::MatrixXd within;     ///< p × p, lower triangular, rows of zeros where a spread is zero
  Eigen::MatrixXd between;    ///< empty: not nested
  std::vector<double> noise;  ///< φ_c
};
/// ∂F/∂Ω, ∂F/∂Ω_a (symmetric), ∂F/∂log φ_c.
struct VarianceGradient {
  Eigen::MatrixXd within, between;
  Eigen::VectorXd noise;
};

/// The coordinates x of a search for variances, bounded and without singular places at a spread of zero:
///
///   Ω = D U Uᵀ D, D = diag(ω_j),  row j of U = (r_j1, …, r_j,j−1, 1, 0, …)/norm,  x = (ω_j/scale_j, r_jk, …, log φ_c).
///
/// A logarithm of the diagonal, as usual in log-Cholesky, would put a spread of zero at minus infinity; ω_j ≥ 0 reaches
/// it, as in lme4 (D. Bates et al., J. Stat. Softw. 67(1), 2015). A spread alone is one coordinate, so its profile is a
/// search in the others.
class Coordinates {
 public:
  Coordinates(const Cohort& cohort, Shape within, std::optional<Shape> between);

  std::size_t size() const { return lower_.size(); }
  const std::vector<double>& lower() const { return lower_; }
  const std::vector<double>& upper() const { return upper_; }
  struct Spread {
    std::size_t coordinate, parameter;
    bool between;  ///< of animals, not of specimens
  };
  std::vector<Spread> spreads() const;

  std::vector<double> start(const std::vector<double>& noise) const;
  Variances variances(const std::vector<double>& x) const;
  void chain(const std::vector<double>& x, const VarianceGradient& by_variance, double* by_x) const;

 private:
  struct Part {
    std::size_t first;
    Shape shape;
  };
  void add(Shape shape);
  Eigen::MatrixXd directions(const std::vector<double>& x, Part part) const;
  void chain(const std::vector<double>& x, Part part, const Eigen::MatrixXd& by_covariance, double* by_x) const;

  std::size_t p_;
  std::vector<double> scales_, lower_, upper_;
  std::optional<Part> between_;
  std::size_t first_between_ = 0, first_noise_ = 0;
  Shape within_;
  std::vector<std::size_t> estimated_;
  std::size_t channels_;
};

}  // namespace tunica::population
