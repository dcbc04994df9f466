// SPDX-License-Identifier: Apache-2.0
#include "calibration/straightness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

namespace tunica::calibration {

Straightness::Straightness(const Assembly& assembly, const Whitening& noise, std::span<const double> free)
    : assembly_(assembly),
      noise_(noise),
      workspace_(assembly.make_workspace()),
      free_(free.begin(), free.end()),
      predictions_(assembly.prediction_count()),
      by_free_(predictions_.size() * free.size()),
      residuals_(noise.count()),
      jacobian_(noise.count() * free.size()),
      centre_(free.size()) {
  assembly.to_unit(free, centre_);
  least_ = fit(centre_, {});
}

bool Straightness::holds(Eigen::Index parameter, double half_width, double quantile) {
  const auto j = static_cast<std::size_t>(parameter);
  for (const double side : {-1.0, 1.0}) {
    std::vector<double> x = centre_;
    x[j] = std::clamp(x[j] + side * half_width, 0.0, 1.0);
    const double expected = std::pow(quantile * (x[j] - centre_[j]) / half_width, 2);
    if (expected < 0.05) continue;  // next to a bound: nothing to tell
    const double rise = (fit(x, parameter) - least_) / expected;
    if (!(rise > 0.5 && rise < 2)) return false;
  }
  return true;
}

double Straightness::linearise(const std::vector<double>& x) {
  assembly_.from_unit(x, free_);
  if (!assembly_.predict(free_, predictions_, by_free_, *workspace_).ok())
    return std::numeric_limits<double>::infinity();
  whitened_residuals(noise_, free_, predictions_, by_free_, residuals_, jacobian_);
  assembly_.jacobian_to_unit(free_, jacobian_, *workspace_);
  return Eigen::Map<const Vector>(residuals_.data(), static_cast<Eigen::Index>(residuals_.size())).squaredNorm();
}

double Straightness::fit(std::vector<double>& x, std::optional<Eigen::Index> held) {
  constexpr int iterations = 8, halvings = 4;
  constexpr double enough = 1e-2;  // of −2 ln L, where intervals end at about 4
  const auto n = static_cast<Eigen::Index>(x.size());
  double here = linearise(x);
  for (int k = 0; k < iterations && std::isfinite(here); ++k) {
    std::vector<Eigen::Index> moving;
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(
        jacobian_.data(), static_cast<Eigen::Index>(residuals_.size()), n);
    const Eigen::Map<const Vector> r(residuals_.data(), J.rows());
    const Vector slope = J.transpose() * r;
    for (Eigen::Index j = 0; j < n; ++j) {
      const double at = x[static_cast<std::size_t>(j)];
      const bool pressed = (at <= 0 && slope[j] > 0) || (at >= 1 && slope[j] < 0);  // against its bound
      if (j != held && !pressed) moving.push_back(j);
    }
    if (moving.empty()) break;
    const Vector step = Eigen::CompleteOrthogonalDecomposition<Matrix>(J(Eigen::all, moving)).solve(-r);
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
    if (!(there < here)) break;
    const double gain = here - there;
    x = std::move(next), here = there;
    if (gain < enough) break;
  }
  return here;
}

}  // namespace tunica::calibration
