// SPDX-License-Identifier: Apache-2.0
#include "assembly/channel_noise.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/restricted_variance.hpp"
#include "assembly/smooth_shapes.hpp"
#include "text/units.hpp"

namespace tunica::assembly {
namespace {

constexpr double assumed_share = 0.01;  ///< of the largest value
constexpr double no_noise = 1e-6;       ///< of the largest value

/// σ² of a row's value from the replicates, with its degrees of freedom; 0 where they agree.
std::pair<double, double> pooled_deviation(const data::Channel& channel, const std::vector<std::size_t>& rows) {
  const auto replicates = static_cast<double>(channel.replicates.size());
  double sum = 0;
  for (const std::size_t row : rows)
    for (const auto& replicate : channel.replicates) sum += std::pow(replicate[row] - channel.values[row], 2);
  const double freedom = static_cast<double>(rows.size()) * (replicates - 1);
  return {sum / freedom / replicates, freedom};
}

}  // namespace

ChannelNoise channel_noise(const data::Channel& channel,
                           const std::vector<std::pair<std::string, std::vector<double>>>& abscissae,
                           const std::vector<bool>& fitted, const std::string& where,
                           std::vector<std::string>& warnings) {
  if (channel.noise) return {noise_model(channel, {}, fitted, where, warnings), NoiseOrigin::stated, 0};
  std::vector<std::size_t> rows;
  std::vector<double> values;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    if (!fitted[i]) continue;
    rows.push_back(i);
    values.push_back(channel.values[i]);
  }
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const double rounding = value_step(values) / std::sqrt(12.0);
  ChannelNoise found;
  double sd = 0;
  if (channel.replicates.size() > 1) {
    const auto [variance, freedom] = pooled_deviation(channel, rows);
    if (variance > 0) {
      found.origin = NoiseOrigin::replicates;
      found.freedom = freedom;
      sd = std::sqrt(variance);
    }
  }
  if (sd == 0)
    if (const auto scatter = smooth_scatter(channel.values, abscissae, fitted);
        scatter && std::sqrt(scatter->variance) > no_noise * largest) {
      found.origin = NoiseOrigin::smooth_shapes;
      found.freedom = scatter->freedom;
      sd = std::sqrt(scatter->variance);
    }
  if (sd == 0) sd = assumed_share * largest;
  sd = std::max(sd, rounding);
  if (!(sd > 0)) sd = 1;  // every row measures 0: nothing to scale by
  found.rows.sd.assign(rows.size(), sd);
  found.rows.estimated = true;
  return found;
}

std::string noise_words(const ChannelNoise& noise, const std::string& test, const std::string& observable,
                        const std::string& unit) {
  const char* const from = noise.origin == NoiseOrigin::replicates      ? "from the replicates"
                           : noise.origin == NoiseOrigin::smooth_shapes ? "from smooth shapes"
                                                                        : "assumed, 1 % of the largest value";
  return fmt::format("{} of {}: {:.3g}{} {}", observable, test, noise.rows.sd.empty() ? 0 : noise.rows.sd.front(),
                     text::unit_suffix(unit), from);
}

}  // namespace tunica::assembly
