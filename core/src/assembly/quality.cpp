// SPDX-License-Identifier: Apache-2.0
#include "assembly/quality.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tunica::assembly {

Agreement agreement(std::span<const double> measured, std::span<const double> predicted) {
  Agreement found;
  found.rows = measured.size();
  const auto n = static_cast<double>(measured.size());
  const double mean = std::accumulate(measured.begin(), measured.end(), 0.0) / n;
  double squares = 0, about_mean = 0, deviation = 0, size_measured = 0, size_predicted = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double error = measured[i] - predicted[i];
    squares += error * error;
    about_mean += (measured[i] - mean) * (measured[i] - mean);
    deviation += std::abs(error);
    size_measured += std::abs(measured[i]);
    size_predicted += std::abs(predicted[i]);
  }
  found.rmse = std::sqrt(squares / n);
  if (about_mean > 0) found.r2 = 1 - squares / about_mean;
  const double larger = std::max(size_measured, size_predicted);
  if (larger > 0) found.nmad = 100 * deviation / larger;
  return found;
}

std::vector<ChannelQuality> quality(const Assembly& assembly, std::span<const double> predictions) {
  std::vector<ChannelQuality> all;
  for (const MeasuredChannel& view : assembly.layout().channels) {
    std::vector<double> measured[2], predicted[2];
    for (std::size_t i = 0; i < view.count; ++i) {
      if (!view.fitted[i] && !view.held_out(i)) continue;
      measured[view.fitted[i]].push_back(view.measured[i]);
      predicted[view.fitted[i]].push_back(predictions[view.offset + i]);
    }
    ChannelQuality found{view.test, view.observable, view.unit, view.drawn_over.name, {}, {}};
    if (!measured[1].empty()) found.fitted = agreement(measured[1], predicted[1]);
    if (!measured[0].empty()) found.held_out = agreement(measured[0], predicted[0]);
    all.push_back(std::move(found));
  }
  return all;
}

}  // namespace tunica::assembly
