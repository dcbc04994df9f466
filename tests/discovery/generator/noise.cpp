// SPDX-License-Identifier: Apache-2.0
#include "noise.hpp"

#include <algorithm>
#include <cmath>

namespace blind {
namespace {

double significant(double value, int digits) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - digits + 1);
  return std::round(value / unit) * unit;
}

}  // namespace

const std::vector<std::string>& noise_kinds() {
  static const std::vector<std::string> all{"white", "relative", "quantised", "outliers", "ar1", "correlated", "none"};
  return all;
}

/// 1 to 2 % of what each curve of the bare specimen spans.
NoiseModel draw_noise(const std::string& kind, const Specimen& specimen, std::mt19937_64& random) {
  const auto y = observe(specimen.protocol, {specimen.tissue});
  const auto layout = channels(specimen.protocol);
  NoiseModel model{.kind = kind, .absolute = {}, .relative = {}, .step = {}};
  if (kind == "ar1") {
    model.correlation = 0.3;
    model.replicates = 4;
  }
  if (kind == "correlated") model.correlation = 0.3;
  for (auto* part : {&model.absolute, &model.relative, &model.step}) part->assign(layout.size(), 0.0);
  for (std::size_t k = 0; k < layout.size(); ++k) {
    const auto begin = y.begin() + static_cast<std::ptrdiff_t>(layout[k].first);
    const auto [low, high] = std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(layout[k].count));
    const double sd = significant(between(random, 0.01, 0.02) * (*high - *low), 3);
    model.absolute[k] = sd;
    if (kind == "relative") {
      model.absolute[k] = significant(0.5 * sd, 3);
      model.relative[k] = significant(0.87 * sd / std::max(std::abs(*low), std::abs(*high)), 3);
    }
    if (kind == "quantised") model.step[k] = significant(sd, 1);
  }
  return model;
}

Noise NoiseModel::about(const Protocol& protocol, std::span<const double> truth) const {
  Noise noise{Eigen::VectorXd(static_cast<Eigen::Index>(truth.size())), correlation};
  const auto layout = channels(protocol);
  for (std::size_t k = 0; k < layout.size(); ++k) {
    for (std::size_t i = layout[k].first; i < layout[k].first + layout[k].count; ++i) {
      const double a = absolute[k], b = relative[k] * truth[i], q = step[k];
      noise.sd[static_cast<Eigen::Index>(i)] =
          std::sqrt((a * a + b * b + q * q / 12) / static_cast<double>(replicates));
    }
  }
  return noise;
}

Records add_noise(const NoiseModel& model, const Protocol& protocol, std::span<const double> truth,
                  std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto layout = channels(protocol);
  Records records;
  for (std::size_t replicate = 0; replicate < model.replicates; ++replicate) {
    std::vector<double> y(truth.begin(), truth.end());
    for (std::size_t k = 0; k < layout.size() && model.kind != "none"; ++k) {
      double error = normal(random);
      for (std::size_t row = 0; row < layout[k].count; ++row) {
        if (row > 0)
          error = model.correlation * error + std::sqrt(1 - model.correlation * model.correlation) * normal(random);
        double& value = y[layout[k].first + row];
        value += error * std::hypot(model.absolute[k], model.relative[k] * value);
        if (model.kind == "outliers" && between(random, 0, 1) < 0.01) {
          const double shift = 8 * model.absolute[k] * normal(random);
          records.gross.push_back({k, row, shift});
          value += shift;
        }
        if (model.step[k] > 0) value = model.step[k] * std::round(value / model.step[k]);
      }
    }
    records.replicates.push_back(std::move(y));
  }
  return records;
}

}  // namespace blind
