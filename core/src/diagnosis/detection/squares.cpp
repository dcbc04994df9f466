// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/squares.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/distributions.hpp"

namespace tunica::diagnosis {

double p_of_squares(const Evidence& evidence, const Fit& fit) {
  constexpr double beyond_doubt = 1e-6;
  const bool known = std::all_of(evidence.noise.begin(), evidence.noise.end(),
                                 [](const NoiseSource& source) { return source.kind == NoiseSource::Kind::stated; });
  const double freedom = static_cast<double>(fit.residuals.size() - interior(fit).cols());
  const double squares = fit.residuals.squaredNorm();
  if (!known || freedom < 1 || !std::isfinite(squares)) return 1;
  const double p = numerics::chi_squared_above(squares, freedom);
  return p < beyond_doubt ? p : 1;
}

}  // namespace tunica::diagnosis
