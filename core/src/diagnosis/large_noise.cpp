// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/large_noise.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>

#include "diagnosis/causes.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double level = 0.01;

/// P(so small a mean square) under the noise.
double lower_tail(double squares, double rows, double freedom_of_noise) {
  if (freedom_of_noise > 0) return boost::math::cdf(boost::math::fisher_f(rows, freedom_of_noise), squares / rows);
  return boost::math::cdf(boost::math::chi_squared(rows), squares);
}

}  // namespace

void warn_of_large_noise(Diagnosis& d, const Fit& best) {
  const Eigen::MatrixXd Q = basis(interior(best), 1e-8);
  std::vector<std::string> small;
  for (const Curve& curve : d.curves) {
    const double squares = best.residuals.segment(curve.first, curve.count).squaredNorm();
    const double rows = static_cast<double>(curve.count) - Q.middleRows(curve.first, curve.count).squaredNorm();
    if (rows < 1) continue;
    if (lower_tail(squares, rows, curve.noise.freedom) * static_cast<double>(d.curves.size()) > level) continue;
    small.push_back(fmt::format("{}, {} ({:.2f} σ)", curve.test, curve.channel, std::sqrt(squares / rows)));
  }
  if (small.empty()) return;
  const bool stated = std::all_of(d.noise.begin(), d.noise.end(),
                                  [](const NoiseSource& source) { return source.kind == NoiseSource::Kind::stated; });
  d.warnings.push_back(fmt::format(
      "residuals are smaller than their noise, of which 1 σ is usual: {}. That σ is too large, and what is wrong can "
      "hide below it; {}",
      fmt::join(small, "; "),
      stated ? "state what one test has, without what differs between specimens and protocols"
             : "state noise.absolute and noise.relative as the instruments have it, or measure more rows"));
}

}  // namespace tunica::diagnosis
