// SPDX-License-Identifier: Apache-2.0
#include "posterior/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "numerics/distributions.hpp"

namespace tunica::posterior {
namespace {

constexpr double not_judged = std::numeric_limits<double>::quiet_NaN();

/// The first and the second half of each; the middle of an odd number is left out.
Chains split(const Chains& chains) {
  Chains halves;
  for (const auto& chain : chains) {
    const auto half = static_cast<std::ptrdiff_t>(chain.size() / 2);
    halves.emplace_back(chain.begin(), chain.begin() + half);
    halves.emplace_back(chain.end() - half, chain.end());
  }
  return halves;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double variance(const std::vector<double>& values) {
  const double centre = mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - centre) * (value - centre);
  return squares / static_cast<double>(values.size() - 1);
}

/// W, and var⁺ = (n − 1)/n W + B/n.
struct Variances {
  double within, total;
};
Variances variances(const Chains& chains) {
  std::vector<double> means, own;
  for (const auto& chain : chains) {
    means.push_back(mean(chain));
    own.push_back(variance(chain));
  }
  const auto n = static_cast<double>(chains.front().size());
  const double within = mean(own);
  return {within, (n - 1) / n * within + (means.size() > 1 ? variance(means) : 0)};
}

/// Every value by a function of it.
template <class Function>
Chains mapped(Chains chains, Function function) {
  for (auto& chain : chains)
    for (double& value : chain) value = function(value);
  return chains;
}

std::vector<double> sorted(const Chains& chains) {
  std::vector<double> all;
  for (const auto& chain : chains) all.insert(all.end(), chain.begin(), chain.end());
  std::sort(all.begin(), all.end());
  return all;
}

/// z of the header; equal values share the mean of their ranks.
Chains normal_scores(const Chains& chains) {
  const std::vector<double> all = sorted(chains);
  const auto count = static_cast<double>(all.size());
  return mapped(chains, [&](double value) {
    const auto [low, high] = std::equal_range(all.begin(), all.end(), value);
    const double rank = 0.5 * static_cast<double>((low - all.begin()) + 1 + (high - all.begin()));
    return numerics::normal_quantile((rank - 0.375) / (count + 0.25));
  });
}

bool can_be_judged(const Chains& chains) {
  if (chains.empty() || chains.front().size() < 4) return false;
  const double first = chains.front().front();
  return std::any_of(chains.begin(), chains.end(), [first](const auto& chain) {
    return std::any_of(chain.begin(), chain.end(), [first](double value) { return value != first; });
  });
}

/// Of whole sequences.
double size_of(const Chains& chains) {
  const std::size_t n = chains.front().size();
  const auto all = static_cast<double>(n * chains.size());
  const Variances spread = variances(chains);
  std::vector<double> means;
  for (const auto& chain : chains) means.push_back(mean(chain));
  // ρ_t = 1 − (W − mean of the autocovariances at lag t)/var⁺
  const auto correlation = [&](std::size_t lag) {
    double covariance = 0;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      double sum = 0;
      for (std::size_t i = lag; i < n; ++i) sum += (chains[c][i] - means[c]) * (chains[c][i - lag] - means[c]);
      covariance += sum / static_cast<double>(n);
    }
    covariance /= static_cast<double>(chains.size());
    const double unbiased = spread.within * static_cast<double>(n - 1) / static_cast<double>(n);
    return 1 - (unbiased - covariance) / spread.total;
  };
  double sum = 0, before = std::numeric_limits<double>::infinity();
  for (std::size_t lag = 0; lag + 1 < n; lag += 2) {
    double pair = (lag == 0 ? 1 : correlation(lag)) + correlation(lag + 1);
    if (!(pair > 0)) break;
    pair = std::min(pair, before);
    before = pair;
    sum += pair;
  }
  // τ = −1 + 2 Σ of pairs; antithetic chains may be worth more than their draws, up to S log₁₀ S.
  return all / std::max(-1 + 2 * sum, 1 / std::log10(all));
}

}  // namespace

double quantile_of(const std::vector<double>& ascending, double share) {
  const double place = share * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return ascending[below] + (place - static_cast<double>(below)) * (ascending[above] - ascending[below]);
}

double split_r_hat(const Chains& chains) {
  if (!can_be_judged(chains)) return not_judged;
  const Variances spread = variances(split(chains));
  return std::sqrt(spread.total / spread.within);
}

double effective_size(const Chains& chains) { return can_be_judged(chains) ? size_of(split(chains)) : not_judged; }

Convergence convergence(const Chains& chains) {
  if (!can_be_judged(chains)) return {not_judged, not_judged, not_judged};
  const std::vector<double> all = sorted(chains);
  const double median = quantile_of(all, 0.5);
  const Chains scores = normal_scores(chains);
  const Chains folded = normal_scores(mapped(chains, [median](double value) { return std::abs(value - median); }));
  const auto size_below = [&](double share) {
    const double end = quantile_of(all, share);
    return effective_size(mapped(chains, [end](double value) { return value <= end ? 1.0 : 0.0; }));
  };
  return {std::max(split_r_hat(scores), split_r_hat(folded)), effective_size(scores),
          std::min(size_below(0.05), size_below(0.95))};
}

}  // namespace tunica::posterior
