// SPDX-License-Identifier: Apache-2.0
#include "assembly/misfit.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/distributions.hpp"

namespace tunica::assembly {

double Misfit::times() const { return judged() ? std::sqrt(per_freedom()) : 0; }

Misfit misfit(const Assembly& assembly, NoiseKind kind, std::span<const double> predictions,
              std::span<const double> measured) {
  Misfit found;
  double fitted = 0;
  for (const MeasuredChannel& view : assembly.layout().channels) {
    if (!(view.weight > 0)) continue;
    const auto count = static_cast<std::size_t>(std::count(view.fitted.begin(), view.fitted.end(), true));
    fitted += static_cast<double>(count);
    const ChannelNoise& noise = view.sigma;
    if (count == 0 || !noise.known() || noise.stated() != (kind == NoiseKind::stated)) continue;
    found.rows += count;
    found.noise_freedom += noise.freedom;
    double before = 0;
    for (std::size_t i = 0, k = 0; i < view.count; ++i) {
      if (!view.fitted[i]) continue;
      const std::size_t at = view.offset + i;
      const double e = (predictions[at] - (measured.empty() ? view.measured[i] : measured[at])) / noise.rows.sd[k];
      const double phi = noise.rows.neighbour.empty() ? 0 : noise.rows.neighbour[k];
      found.chi_square += std::pow(e - phi * before, 2) / (1 - phi * phi);
      before = e;
      ++k;
    }
  }
  if (found.rows == 0) return found;
  const double parameters = static_cast<double>(assembly.layout().parameters.size());
  found.freedom = static_cast<double>(found.rows) * (1 - parameters / fitted);
  if (!found.judged() || !std::isfinite(found.chi_square)) return found;
  found.chance = found.noise_freedom > 0 ? numerics::f_above(found.per_freedom(), found.freedom, found.noise_freedom)
                                         : numerics::chi_squared_above(found.chi_square, found.freedom);
  return found;
}

}  // namespace tunica::assembly
