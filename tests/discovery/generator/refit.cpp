// SPDX-License-Identifier: Apache-2.0
#include "refit.hpp"

#include <algorithm>
#include <cmath>

#include "bases.hpp"

namespace blind {
namespace {

using Point = Eigen::VectorXd;

Point point_of(const Tissue& tissue) {
  const auto& own = fitted(tissue.base);
  Point x(static_cast<Eigen::Index>(own.size()));
  for (std::size_t j = 0; j < own.size(); ++j) {
    const double value = tissue.*own[j].member;
    x[static_cast<Eigen::Index>(j)] = own[j].logarithmic ? std::log(value) : value / own[j].unit;
  }
  return x;
}
/// What is held is that of `start`.
Tissue tissue_of(const Point& x, const Tissue& start) {
  Tissue tissue = start;
  const auto& own = fitted(start.base);
  for (std::size_t j = 0; j < own.size(); ++j) {
    const double value = x[static_cast<Eigen::Index>(j)];
    tissue.*own[j].member = own[j].logarithmic ? std::exp(value) : own[j].unit * value;
  }
  return tissue;
}

Point clamped(Point x, Base base) {
  const auto& own = fitted(base);
  for (std::size_t j = 0; j < own.size(); ++j) {
    double& value = x[static_cast<Eigen::Index>(j)];
    value = own[j].logarithmic ? std::clamp(value, std::log(own[j].low), std::log(own[j].high))
                               : std::clamp(value, own[j].low / own[j].unit, own[j].high / own[j].unit);
  }
  return x;
}

}  // namespace

Eigen::VectorXd whiten(const Protocol& protocol, const Noise& noise, std::span<const double> error) {
  Eigen::VectorXd r = Eigen::Map<const Eigen::VectorXd>(error.data(), static_cast<Eigen::Index>(error.size()));
  r.array() /= noise.sd.array();
  if (noise.correlation == 0) return r;
  const Eigen::VectorXd plain = r;
  for (const Channel& channel : channels(protocol)) {
    for (std::size_t i = channel.first + 1; i < channel.first + channel.count; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      r[k] = (plain[k] - noise.correlation * plain[k - 1]) / std::sqrt(1 - noise.correlation * noise.correlation);
    }
  }
  return r;
}

/// Levenberg–Marquardt with forward differences (Marquardt 1963).
Refit refit(const Protocol& protocol, const Noise& noise, std::span<const double> data, const Tissue& start) {
  const auto residual = [&](const Point& x) {
    auto y = observe(protocol, {tissue_of(x, start)});
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = data[i] - y[i];
    return whiten(protocol, noise, y);
  };
  Point x = clamped(point_of(start), start.base);
  Eigen::VectorXd r = residual(x);
  double misfit = r.squaredNorm(), damping = 1e-4;
  Refit result;
  const Eigen::Index count = x.size();
  Eigen::MatrixXd J(r.size(), count);
  for (int iteration = 0; iteration < 60; ++iteration) {
    for (Eigen::Index j = 0; j < count; ++j) {
      Point moved = x;
      moved[j] += 1e-6;
      if (clamped(moved, start.base)[j] != moved[j]) moved[j] = x[j] - 1e-6;
      const double step = moved[j] - x[j];
      J.col(j) = (r - residual(moved)) / step;
    }
    if (!J.allFinite()) break;
    const Eigen::MatrixXd normal = J.transpose() * J;
    const Point slope = J.transpose() * r;
    bool moved = false;
    for (int trial = 0; trial < 12 && !moved; ++trial, damping *= 8) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() *= 1 + damping;
      for (Eigen::Index j = 0; j < count; ++j) {  // what is pressed against a bound stays there
        Point outward = x;
        outward[j] += slope[j] > 0 ? 1e-9 : -1e-9;
        if (clamped(outward, start.base)[j] != outward[j]) damped(j, j) = 1e12 * normal.trace();
      }
      const Point next = clamped(x + damped.ldlt().solve(slope), start.base);
      const Eigen::VectorXd r_next = residual(next);
      const double better = r_next.squaredNorm();
      if (!(better <= misfit)) continue;
      result.converged = misfit - better < 1e-6 * misfit + 1e-9;
      x = next;
      r = r_next;
      misfit = better;
      moved = true;
      damping = std::max(1e-9, damping / 60);
    }
    if (!moved) result.converged = true;  // no step gets lower: rounding
    if (result.converged) break;
  }
  result.tissue = tissue_of(x, start);
  result.misfit = misfit;
  result.residual = r;
  result.jacobian = J;
  return result;
}

}  // namespace blind
