// SPDX-License-Identifier: Apache-2.0
#include "population/covariance.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::population {
namespace {

constexpr double widest = 20;     // of a spread, in scales
constexpr double steepest = 20;   // |r|: a correlation of 0.9988
constexpr double noise_log = 23;  // φ_c between 1e-10 and 1e10

}  // namespace

ChosenShape choose(std::optional<Shape> stated, std::size_t parameters, double freedom) {
  if (stated) return {*stated, ShapeReason::stated};
  if (parameters > 1 && freedom >= 5 * static_cast<double>(parameters)) return {Shape::full, ShapeReason::enough};
  return {Shape::diagonal, ShapeReason::too_few};
}

Coordinates::Coordinates(const Cohort& cohort, Shape within, std::optional<Shape> between)
    : p_(cohort.parameters.size()), within_(within), channels_(cohort.channels.size()) {
  for (const Parameter& parameter : cohort.parameters) scales_.push_back(parameter.scale);
  add(within);
  first_between_ = lower_.size();
  if (between) {
    between_ = Part{first_between_, *between};
    add(*between);
  }
  first_noise_ = lower_.size();
  for (std::size_t c = 0; c < channels_; ++c) {
    if (!cohort.channels[c].estimated) continue;
    estimated_.push_back(c);
    lower_.push_back(-noise_log);
    upper_.push_back(noise_log);
  }
}

void Coordinates::add(Shape shape) {
  lower_.insert(lower_.end(), p_, 0.0);
  upper_.insert(upper_.end(), p_, widest);
  if (shape == Shape::diagonal) return;
  lower_.insert(lower_.end(), p_ * (p_ - 1) / 2, -steepest);
  upper_.insert(upper_.end(), p_ * (p_ - 1) / 2, steepest);
}

std::vector<Coordinates::Spread> Coordinates::spreads() const {
  std::vector<Spread> result;
  for (std::size_t j = 0; j < p_; ++j) result.push_back({j, j, false});
  for (std::size_t j = 0; j < p_ && between_; ++j) result.push_back({first_between_ + j, j, true});
  return result;
}

std::vector<double> Coordinates::start(const std::vector<double>& noise) const {
  std::vector<double> x(size(), 0.0);
  for (const Spread& spread : spreads()) x[spread.coordinate] = 0.3;
  for (std::size_t k = 0; k < estimated_.size(); ++k)
    x[first_noise_ + k] = std::clamp(std::log(noise[estimated_[k]]), -noise_log, noise_log);
  return x;
}

Eigen::MatrixXd Coordinates::directions(const std::vector<double>& x, Part part) const {
  const auto p = static_cast<Eigen::Index>(p_);
  Eigen::MatrixXd U = Eigen::MatrixXd::Identity(p, p);
  std::size_t next = part.first + p_;
  for (Eigen::Index j = 1; j < p && part.shape == Shape::full; ++j) {
    for (Eigen::Index k = 0; k < j; ++k) U(j, k) = x[next++];
    U.row(j) /= U.row(j).norm();
  }
  return U;
}

Variances Coordinates::variances(const std::vector<double>& x) const {
  const auto root = [&](Part part) {
    Eigen::MatrixXd L = directions(x, part);
    for (std::size_t j = 0; j < p_; ++j) L.row(static_cast<Eigen::Index>(j)) *= x[part.first + j] * scales_[j];
    return L;
  };
  Variances result{root({0, within_}), between_ ? root(*between_) : Eigen::MatrixXd(),
                   std::vector<double>(channels_, 1.0)};
  for (std::size_t k = 0; k < estimated_.size(); ++k) result.noise[estimated_[k]] = std::exp(x[first_noise_ + k]);
  return result;
}

// With G = ∂F/∂Ω and Ω = L Lᵀ, ∂F/∂L = 2 G L. Rows: L_j = ω_j U_j, U_j = u/|u|, ∂U_j/∂u = (I − U_j U_jᵀ)/|u|.
void Coordinates::chain(const std::vector<double>& x, Part part, const Eigen::MatrixXd& by_covariance,
                        double* by_x) const {
  const auto p = static_cast<Eigen::Index>(p_);
  const Eigen::MatrixXd U = directions(x, part);
  Eigen::VectorXd omega(p);
  for (Eigen::Index j = 0; j < p; ++j)
    omega[j] = x[part.first + static_cast<std::size_t>(j)] * scales_[static_cast<std::size_t>(j)];
  const Eigen::MatrixXd by_root = 2 * by_covariance * omega.asDiagonal() * U;
  std::size_t next = part.first + p_;
  for (Eigen::Index j = 0; j < p; ++j) {
    by_x[part.first + static_cast<std::size_t>(j)] =
        by_root.row(j).dot(U.row(j)) * scales_[static_cast<std::size_t>(j)];
    if (part.shape == Shape::diagonal) continue;
    const Eigen::RowVectorXd q = omega[j] * by_root.row(j);
    const double along = q.dot(U.row(j)), norm = 1 / U(j, j);
    for (Eigen::Index k = 0; k < j; ++k) by_x[next++] = (q[k] - along * U(j, k)) / norm;
  }
}

void Coordinates::chain(const std::vector<double>& x, const VarianceGradient& by_variance, double* by_x) const {
  chain(x, {0, within_}, by_variance.within, by_x);
  if (between_) chain(x, *between_, by_variance.between, by_x);
  for (std::size_t k = 0; k < estimated_.size(); ++k)
    by_x[first_noise_ + k] = by_variance.noise[static_cast<Eigen::Index>(estimated_[k])];
}

}  // namespace tunica::population
