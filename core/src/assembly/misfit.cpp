// SPDX-License-Identifier: Apache-2.0
#include "assembly/misfit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "numerics/distributions.hpp"

namespace tunica::assembly {

double Misfit::times() const { return judged() ? std::sqrt(per_freedom()) : 0; }

std::string in_words(const Misfit& misfit, const char* noise) {
  std::string judgement;
  if (misfit.contradicts())
    judgement = ": the model misses the data";
  else if (misfit.small_but_real())
    judgement = fmt::format(": a small misfit, and a real one (chance {:.1g})", misfit.chance);
  else if (misfit.falls_short())
    judgement = ": the noise or a unit is wrong";
  return fmt::format("χ²/ν {:.3g} (χ² {:.4g}, ν {:.4g}), {:.2g} times the {} noise{}", misfit.per_freedom(),
                     misfit.chi_square, misfit.freedom, misfit.times(), noise, judgement);
}

Misfit misfit_of(double chi_square, std::size_t rows, std::size_t fitted, std::size_t parameters,
                 double noise_freedom) {
  Misfit found{chi_square, rows, 0, 1, noise_freedom};
  if (rows == 0) return found;
  found.freedom = static_cast<double>(rows) * (1 - static_cast<double>(parameters) / static_cast<double>(fitted));
  if (!found.judged() || !std::isfinite(chi_square)) return found;
  found.chance = noise_freedom > 0 ? numerics::f_above(found.per_freedom(), found.freedom, noise_freedom)
                                   : numerics::chi_squared_above(chi_square, found.freedom);
  return found;
}

Misfit misfit(const Assembly& assembly, NoiseKind kind, std::span<const double> predictions,
              std::span<const double> measured) {
  Misfit found;
  std::size_t fitted = 0;
  for (const MeasuredChannel& view : assembly.layout().channels) {
    if (!(view.weight > 0)) continue;
    const auto count = static_cast<std::size_t>(std::count(view.fitted.begin(), view.fitted.end(), true));
    fitted += count;
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
  return misfit_of(found.chi_square, found.rows, fitted, assembly.layout().parameters.size(), found.noise_freedom);
}

}  // namespace tunica::assembly
