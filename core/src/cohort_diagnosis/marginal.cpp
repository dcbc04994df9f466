// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/marginal.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::cohort_diagnosis {
namespace {

double log_add(double a, double b) {
  const double most = std::max(a, b);
  return std::isfinite(most) ? most + std::log1p(std::exp(std::min(a, b) - most)) : most;
}

/// ln ∫ over y > 0, the population's mean taken in the direction of the half.
double log_half(const Half& half, double mean, double sd) {
  const double I = half.length * half.length, u = half.t * half.length, D = 1 + sd * sd * I;
  const double whole = -0.5 * std::log(D) + (u * u * sd * sd + 2 * u * mean - mean * mean * I) / (2 * D);
  return whole + log_normal_below((mean + sd * sd * u) / (sd * std::sqrt(D)));
}

}  // namespace

double log_normal_below(double z) {
  if (z > -35) return std::log(0.5 * std::erfc(-z / M_SQRT2));
  // Φ(−x) = φ(x)/x (1 − 1/x² + …)
  return -z * z / 2 - std::log(-z * std::sqrt(2 * M_PI)) + std::log1p(-1 / (z * z));
}

double log_marginal(const Profile& profile, const Population& population) {
  const auto& [mean, sd] = population;
  if (profile.up && profile.down) return log_add(log_half(*profile.up, mean, sd), log_half(*profile.down, -mean, sd));
  const double side = profile.up ? 1 : -1;
  return log_half(profile.up ? *profile.up : *profile.down, side * mean, sd) - log_normal_below(side * mean / sd);
}

std::vector<Population> populations(const Extent& scale, bool coarse) {
  constexpr double usual = 25;
  const double step = std::log(usual) / (coarse ? 4 : 8);
  const int steps = 1 + static_cast<int>(std::ceil(std::log(std::max(usual, 1.5 * scale.largest_score)) / step - 1e-9));
  std::vector<Population> all;
  const std::vector<double> shares = coarse ? std::vector<double>{0.25, 0.6} : std::vector<double>{0.2, 0.4, 0.6, 0.8};
  for (int k = 0; k < steps; ++k) {
    const double size = scale.unit * std::exp(step * k);
    for (const double share : shares) {
      const double mean = size * std::sqrt(1 - share * share);
      if (scale.up) all.push_back({mean, share * size});
      if (scale.down) all.push_back({-mean, share * size});
    }
    all.push_back({0, size});
    if (scale.up && scale.down) all.push_back({0, size});  // no side, as likely as one of them with the same spread
  }
  return all;
}

double log_with_strangers(double log_likelihood) {
  return log_add(log_likelihood + std::log1p(-stranger), std::log(stranger));
}

}  // namespace tunica::cohort_diagnosis
