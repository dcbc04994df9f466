// SPDX-License-Identifier: Apache-2.0
#include "refit.hpp"

#include <algorithm>
#include <cmath>

namespace blind {
namespace {

using Point = Eigen::Vector4d;

Point point_of(const Tissue& t) { return {std::log(t.mu), std::log(t.k1), std::log(t.k2), t.theta / 30}; }
Tissue tissue_of(const Point& x) {
  Tissue t;
  t.mu = std::exp(x[0]);
  t.k1 = std::exp(x[1]);
  t.k2 = std::exp(x[2]);
  t.theta = 30 * x[3];
  return t;
}

Point clamped(Point x) {
  for (int j = 0; j < 4; ++j) {
    const Bounds& b = bounds()[static_cast<std::size_t>(j)];
    x[j] = j < 3 ? std::clamp(x[j], std::log(b.low), std::log(b.high)) : std::clamp(x[j], b.low / 30, b.high / 30);
  }
  return x;
}

}  // namespace

const std::array<Bounds, 4>& bounds() {
  static const std::array<Bounds, 4> all{{{0.1, 200}, {0.01, 1000}, {0.001, 100}, {0, 90}}};
  return all;
}

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
    auto y = observe(protocol, {tissue_of(x), {}, {}, {}, {}});
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = data[i] - y[i];
    return whiten(protocol, noise, y);
  };
  Point x = clamped(point_of(start));
  Eigen::VectorXd r = residual(x);
  double misfit = r.squaredNorm(), damping = 1e-4;
  Refit result;
  Eigen::MatrixXd J(r.size(), 4);
  for (int iteration = 0; iteration < 60; ++iteration) {
    for (int j = 0; j < 4; ++j) {
      Point moved = x;
      moved[j] += 1e-6;
      if (clamped(moved)[j] != moved[j]) moved[j] = x[j] - 1e-6;
      const double step = moved[j] - x[j];
      J.col(j) = (r - residual(moved)) / step;
    }
    if (!J.allFinite()) break;
    const Eigen::Matrix4d normal = J.transpose() * J;
    const Point slope = J.transpose() * r;
    bool moved = false;
    for (int trial = 0; trial < 12 && !moved; ++trial, damping *= 8) {
      Eigen::Matrix4d damped = normal;
      damped.diagonal() *= 1 + damping;
      for (int j = 0; j < 4; ++j) {  // what is pressed against a bound stays there
        Point outward = x;
        outward[j] += slope[j] > 0 ? 1e-9 : -1e-9;
        if (clamped(outward)[j] != outward[j]) damped(j, j) = 1e12 * normal.trace();
      }
      const Point next = clamped(x + damped.ldlt().solve(slope));
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
  result.tissue = tissue_of(x);
  result.misfit = misfit;
  result.residual = r;
  result.jacobian = J;
  return result;
}

}  // namespace blind
