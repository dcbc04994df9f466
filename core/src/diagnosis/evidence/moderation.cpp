// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/moderation.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>

namespace tunica::diagnosis {
namespace {

constexpr std::size_t least_channels = 4;
constexpr double least_scatter = 0.15;  ///< of ln σ²: no two instruments agree more closely

/// x with ψ′(x) = y, by bisection of ln x.
double trigamma_inverse(double y) {
  double low = std::log(1e-3), high = std::log(1e6);
  for (int i = 0; i < 45; ++i) {
    const double middle = (low + high) / 2;
    (boost::math::trigamma(std::exp(middle)) > y ? low : high) = middle;
  }
  return std::exp((low + high) / 2);
}

}  // namespace

Moderation moderation_of(const std::vector<double>& ratios, const std::vector<double>& freedom) {
  const auto count = static_cast<double>(ratios.size());
  if (ratios.size() < least_channels) return {};
  std::vector<double> x;
  double mean = 0, sampling = 0, spread = 0;
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    x.push_back(std::log(ratios[k]) - boost::math::digamma(freedom[k] / 2) + std::log(freedom[k] / 2));
    mean += x.back() / count;
    sampling += boost::math::trigamma(freedom[k] / 2) / count;
  }
  for (const double value : x) spread += (value - mean) * (value - mean) / (count - 1);
  const double error = spread * std::sqrt(2 / (count - 1));
  const double scatter = std::max(std::max(spread - sampling, 0.0) + error, least_scatter);
  const double half = trigamma_inverse(scatter);
  return {2 * half, std::exp(mean + boost::math::digamma(half) - std::log(half))};
}

}  // namespace tunica::diagnosis
