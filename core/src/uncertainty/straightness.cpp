// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/straightness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/orthogonal.hpp"
#include "search/constrained_step.hpp"

namespace tunica::uncertainty {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

Straightness::Straightness(const assembly::Assembly& assembly, const assembly::Whitening& noise,
                           std::span<const double> free)
    : assembly_(assembly),
      noise_(noise),
      workspace_(assembly.evaluator().make_workspace()),
      free_(free.begin(), free.end()),
      predictions_(assembly.layout().prediction_count),
      by_free_(predictions_.size() * free.size()),
      residuals_(noise.count()),
      jacobian_(noise.count() * free.size()),
      constraints_(assembly.constraints().count()),
      by_constraint_(constraints_.size() * free.size()),
      centre_(free.size()) {
  assembly.box().to_unit(free, centre_);
  least_ = fit(centre_, {}, {});
  if (!constraints_.empty() || !std::isfinite(here_ ? least_ : linearise(centre_))) return;
  centre_residuals_ = residuals_;
  centre_jacobian_ = jacobian_;
}

/// Along the tangent of the likelihood's valley the others begin where the linear model has its minimum.
void Straightness::move_along(Eigen::Index parameter, double by, std::vector<double>& x) const {
  const auto rows = static_cast<Eigen::Index>(centre_residuals_.size()), n = static_cast<Eigen::Index>(x.size());
  x[static_cast<std::size_t>(parameter)] += by;
  if (rows == 0 || n == 1) return;
  const Eigen::Map<const Rows> J(centre_jacobian_.data(), rows, n);
  const Eigen::Map<const Vector> r(centre_residuals_.data(), rows);
  std::vector<Eigen::Index> moving;
  for (Eigen::Index j = 0; j < n; ++j)
    if (j != parameter) moving.push_back(j);
  const Vector others = numerics::shortest_least_squares_solution(J(Eigen::all, moving), -(r + by * J.col(parameter)));
  for (std::size_t a = 0; a < moving.size(); ++a) {
    double& value = x[static_cast<std::size_t>(moving[a])];
    value = std::clamp(value + others[static_cast<Eigen::Index>(a)], 0.0, 1.0);
  }
}

Straightness::Straightness(const Straightness& other)
    : assembly_(other.assembly_),
      noise_(other.noise_),
      workspace_(assembly_.evaluator().make_workspace()),
      free_(other.free_),
      predictions_(other.predictions_),
      by_free_(other.by_free_),
      residuals_(other.residuals_),
      jacobian_(other.jacobian_),
      constraints_(other.constraints_),
      by_constraint_(other.by_constraint_),
      penalty_(other.penalty_),
      violation_(other.violation_),
      centre_(other.centre_),
      centre_residuals_(other.centre_residuals_),
      centre_jacobian_(other.centre_jacobian_),
      least_(other.least_) {}

bool Straightness::holds(Eigen::Index parameter, double side, double half_width, double quantile) const {
  const auto j = static_cast<std::size_t>(parameter);
  std::vector<double> x = centre_;
  move_along(parameter, std::clamp(x[j] + side * half_width, 0.0, 1.0) - x[j], x);
  const double expected = std::pow(quantile * (x[j] - centre_[j]) / half_width, 2);
  if (expected < 0.05) return true;  // next to a bound: nothing to tell
  Straightness own(*this);
  // What surely lies between these needs no second decimal.
  const Between settled{least_ + 0.6 * expected, least_ + 1.8 * expected};
  const double rise = (own.fit(x, parameter, settled) - least_) / expected;
  return rise > 0.5 && rise < 2;
}

double Straightness::linearise(const std::vector<double>& x) {
  assembly_.box().from_unit(x, free_);
  if (!assembly_.evaluator().predict(free_, predictions_, by_free_, *workspace_).ok())
    return std::numeric_limits<double>::infinity();
  assembly::whitened_residuals(noise_, free_, predictions_, by_free_, residuals_, jacobian_);
  assembly_.box().jacobian_to_unit(free_, jacobian_);
  violation_ = 0;
  if (!constraints_.empty()) {
    if (!assembly_.constraints().evaluate(free_, constraints_, by_constraint_).ok())
      return std::numeric_limits<double>::infinity();
    assembly_.box().jacobian_to_unit(free_, by_constraint_);
    for (const double c : constraints_) violation_ += std::max(0.0, c);
  }
  const Eigen::Map<const Vector> r(residuals_.data(), static_cast<Eigen::Index>(residuals_.size()));
  return r.squaredNorm() + penalty_ * violation_;
}

Vector Straightness::step(const std::vector<double>& x, const std::vector<Eigen::Index>& moving) {
  const auto n = static_cast<Eigen::Index>(x.size()), m = static_cast<Eigen::Index>(constraints_.size());
  const Eigen::Map<const Rows> J(jacobian_.data(), static_cast<Eigen::Index>(residuals_.size()), n);
  const Eigen::Map<const Vector> r(residuals_.data(), J.rows());
  if (m == 0) return numerics::shortest_least_squares_solution(J(Eigen::all, moving), -r);
  const auto k = static_cast<Eigen::Index>(moving.size());
  Matrix A = Matrix::Zero(m + 2 * k, k);
  Vector c(m + 2 * k);
  A.topRows(m) = Eigen::Map<const Rows>(by_constraint_.data(), m, n)(Eigen::all, moving);
  c.head(m) = Eigen::Map<const Vector>(constraints_.data(), m);
  for (Eigen::Index a = 0; a < k; ++a) {
    const double at = x[static_cast<std::size_t>(moving[static_cast<std::size_t>(a)])];
    A(m + a, a) = 1;
    c[m + a] = at - 1;
    A(m + k + a, a) = -1;
    c[m + k + a] = -at;
  }
  const auto found = search::constrained_step(J(Eigen::all, moving), r, A, c);
  if (!found) return {};
  penalty_ = std::max(penalty_, 2 * found->largest_multiplier);
  return found->step;
}

double Straightness::fit(std::vector<double>& x, std::optional<Eigen::Index> held, const Between& settled) {
  const int iterations = constraints_.empty() ? 8 : 20;
  constexpr int halvings = 4;
  constexpr double enough = 1e-2;  // of −2 ln L, where intervals end at about 4
  const auto n = static_cast<Eigen::Index>(x.size());
  double here = linearise(x);
  here_ = true;
  for (int k = 0; k < iterations && std::isfinite(here); ++k) {
    std::vector<Eigen::Index> moving;
    const Eigen::Map<const Rows> J(jacobian_.data(), static_cast<Eigen::Index>(residuals_.size()), n);
    const Eigen::Map<const Vector> r(residuals_.data(), J.rows());
    const Vector slope = J.transpose() * r;
    for (Eigen::Index j = 0; j < n; ++j) {
      const double at = x[static_cast<std::size_t>(j)];
      // Against its bound; where constraints push too, the step itself keeps within the bounds.
      const bool pressed = constraints_.empty() && ((at <= 0 && slope[j] > 0) || (at >= 1 && slope[j] < 0));
      if (j != held && !pressed) moving.push_back(j);
    }
    if (moving.empty()) break;
    const double violation = violation_, penalty = penalty_;
    const Vector step = this->step(x, moving);
    if (step.size() == 0) break;
    // If no constraint is violated, the gain is known before the simulation.
    const double ahead = (r + J(Eigen::all, moving) * step).squaredNorm();
    if (violation == 0 && (here - ahead < enough || (ahead > settled.low && here < settled.high))) break;
    here += (penalty_ - penalty) * violation;
    std::vector<double> next;
    double there = std::numeric_limits<double>::infinity(), length = 1;
    for (int half = 0; half < halvings && !(there < here); ++half, length /= 2) {
      next = x;
      for (std::size_t a = 0; a < moving.size(); ++a) {
        double& value = next[static_cast<std::size_t>(moving[a])];
        value = std::clamp(value + length * step[static_cast<Eigen::Index>(a)], 0.0, 1.0);
      }
      there = linearise(next);
    }
    here_ = there < here;
    if (!here_) break;
    const double gain = here - there;
    x = std::move(next);
    here = there;
    if (gain < enough) break;
  }
  return here;
}

}  // namespace tunica::uncertainty
