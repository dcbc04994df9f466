// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/large_noise.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/evidence/projection.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double tail_level = 0.01;

/// P(so small a mean square) under the noise.
double lower_tail(double squares, double rows, double freedom_of_noise) {
  if (freedom_of_noise > 0) return numerics::f_below(squares / rows, rows, freedom_of_noise);
  return numerics::chi_squared_below(squares, rows);
}

}  // namespace

std::optional<Warning> large_noise_warning(const Evidence& evidence, const Fit& best) {
  const Eigen::MatrixXd Q = basis(interior(best), 1e-8);
  std::vector<std::string> small;
  for (const Curve& curve : evidence.curves) {
    const double squares = best.residuals.segment(curve.first, curve.count).squaredNorm();
    const double rows = static_cast<double>(curve.count) - Q.middleRows(curve.first, curve.count).squaredNorm();
    if (rows < 1) continue;
    if (lower_tail(squares, rows, curve.noise.freedom) * static_cast<double>(evidence.curves.size()) > tail_level)
      continue;
    small.push_back(fmt::format("{}, {} ({:.2f} σ)", curve.test, curve.channel, std::sqrt(squares / rows)));
  }
  if (small.empty()) return std::nullopt;
  const bool stated = std::all_of(evidence.noise.begin(), evidence.noise.end(),
                                  [](const NoiseSource& source) { return source.kind == NoiseSource::Kind::stated; });
  return Warning{
      WarningKind::noise_too_large,
      fmt::format("the residuals are smaller than the stated noise implies (1 σ is expected): {}. That σ is too large, "
                  "and misfits can hide below it. {}",
                  fmt::join(small, "; "),
                  stated ? "State the noise within one test, without differences between specimens and protocols"
                         : "State noise.absolute and noise.relative of the instruments, or measure more rows")};
}

}  // namespace tunica::diagnosis
