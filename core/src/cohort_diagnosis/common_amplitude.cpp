// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/common_amplitude.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::cohort_diagnosis {
namespace {

constexpr int means = 121, spreads = 25;

/// A value with its weight.
using Weighed = std::vector<std::pair<double, double>>;

double quantile(Weighed values, double share) {
  std::sort(values.begin(), values.end());
  double all = 0, sum = 0;
  for (const auto& [value, weight] : values) all += weight;
  for (const auto& [value, weight] : values)
    if ((sum += weight) >= share * all) return value;
  return values.back().first;
}

/// m + τ φ(m/τ)/Φ(m/τ) of a normal distribution cut off at 0.
double mean_above_null(double mean, double sd) {
  const double z = mean / sd;
  return mean + sd * std::exp(-z * z / 2 - 0.5 * std::log(2 * M_PI) - log_normal_below(z));
}

}  // namespace

CommonAmplitude common_amplitude(const Hypothesis& hypothesis, const std::vector<bool>& counts) {
  const Profile& like = hypothesis.like();
  double farthest = 0, squares = 0, seen = 0;
  for (std::size_t s = 0; s < counts.size(); ++s) {
    if (!counts[s] || !hypothesis.sees[s]) continue;
    farthest = std::max(farthest, std::abs(hypothesis.seen[s].distance()));
    squares += std::pow(hypothesis.seen[s].active().length, 2);
    seen += 1;
  }
  const double unit = seen > 0 ? std::sqrt(seen / squares) : 1, reach = 1.5 * farthest + 2 * unit;
  const bool one_sided = !(like.up && like.down);
  const double side = like.up ? 1 : -1, from = one_sided ? 0 : -reach;
  std::vector<double> logs;
  Weighed mean, spread;
  for (int i = 0; i < means; ++i)
    for (int j = 0; j < spreads; ++j) {
      const double m = side * (from + (reach - from) * i / (means - 1));
      const double sd = 0.02 * reach * std::pow(100, static_cast<double>(j) / (spreads - 1));
      double log = 0;
      for (std::size_t s = 0; s < counts.size(); ++s)
        if (counts[s] && hypothesis.sees[s]) log += log_with_strangers(log_marginal(hypothesis.seen[s], {m, sd}));
      logs.push_back(log);
      mean.emplace_back(one_sided ? side * mean_above_null(side * m, sd) : m, 0);
      spread.emplace_back(sd, 0);
    }
  const double most = *std::max_element(logs.begin(), logs.end());
  for (std::size_t k = 0; k < logs.size(); ++k) mean[k].second = spread[k].second = std::exp(logs[k] - most);
  const double null = like.even ? 0 : like.null;
  return {like.amplitude,
          like.unit,
          null + quantile(mean, 0.5),
          null + quantile(mean, 0.025),
          null + quantile(mean, 0.975),
          quantile(spread, 0.5),
          like.even};
}

}  // namespace tunica::cohort_diagnosis
