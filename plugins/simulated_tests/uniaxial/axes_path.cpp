// SPDX-License-Identifier: Apache-2.0
#include "axes_path.hpp"

#include <cmath>

#include "tunica/detail/solve_strip.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
namespace {

/// Predictions run concurrently and thousands of times a second: one scratch a thread spares every one its allocations.
struct Scratch {
  free_strip::Scratch batches;
  std::vector<double> stress, y, stress_by_l, y_by_l, stress_dp, y_dp;  ///< of all rows, as in StripPath
};

Scratch& thread_scratch() {
  thread_local Scratch instance;
  return instance;
}

Status overflow(const Strip& strip, std::span<const double> stretch, std::size_t row) {
  return Status::failed("uniaxial: the stress overflows at " + row_name(strip, stretch, row));
}

/// All requested outputs, from the solution of every row.
Status write(const Strip& strip, const StripPath& path, const TestOutput& output) {
  const std::size_t n = path.stretch.size(), rows = strip.channels.size() * n;
  for (std::size_t i = 0; i < n; ++i) {
    RowSolution row{path.stretch[i], path.stress[i], path.lateral[i], 0, 0};
    if (!std::isfinite(row.stress) || !std::isfinite(row.y)) return overflow(strip, path.stretch, i);
    if (!path.stress_by_l.empty()) {
      row.stress_by_l = path.stress_by_l[i];
      row.y_by_l = path.lateral_by_l[i];
    }
    for (std::size_t k = 0; k < strip.channels.size(); ++k) {
      const Channel channel = strip.channels[k];
      const std::size_t at = k * n + i;
      if (!output.values.empty()) output.values[at] = channel_value(channel, strip.measure, row);
      if (!output.abscissa_derivative.empty())
        output.abscissa_derivative[at] = channel_by_stretch(channel, strip.measure, row);
      for (std::size_t j = 0; j * n < path.stress_dp.size(); ++j)
        output.jacobian[j * rows + at] =
            channel_derivative(channel, strip.measure, row, path.stress_dp[j * n + i], path.lateral_dp[j * n + i]);
    }
    if (!output.diagnostics.empty()) {
      output.diagnostics[i] = std::exp(row.y / 2);
      output.diagnostics[n + i] = 1 / (row.stretch * output.diagnostics[i]);
    }
  }
  return {};
}

}  // namespace

/// A channel of Cauchy stress alone is written by the solver; everything else is made of stress and y.
Status AxesPath::predict(const Strip& strip, const TestInput& input, const TestOutput& output) const {
  const std::span<const double> stretch =
      input.abscissae.empty() ? std::span<const double>(strip.stretch) : input.abscissae[0];
  const std::size_t n = stretch.size(), by_parameters = output.jacobian.empty() ? 0 : input.model_parameters.size() * n;
  const bool plain = strip.channels.size() == 1 && strip.channels[0] == Channel::stress &&
                     strip.measure == Measure::cauchy && output.abscissa_derivative.empty() &&
                     output.diagnostics.empty();
  Scratch& s = thread_scratch();
  std::size_t lost = StripPath::none;
  StripPath path{
      .loaded = strip.loaded, .parameters = input.model_parameters, .stretch = stretch, .stress = {}, .lost = &lost};
  if (input.abscissae.empty()) start_.set(path);
  if (plain) {
    path.stress = output.values;
    path.stress_dp = output.jacobian.first(by_parameters);
  } else {
    path.stress = room(s.stress, n);
    path.lateral = room(s.y, n);
    path.stress_dp = room(s.stress_dp, by_parameters);
    path.lateral_dp = room(s.y_dp, by_parameters);
    if (!output.abscissa_derivative.empty()) {
      path.stress_by_l = room(s.stress_by_l, n);
      path.lateral_by_l = room(s.y_by_l, n);
    }
  }
  if (const Status status = free_strip::solve(input.model, path, s.batches); !status.ok())
    return lost == StripPath::none
               ? status
               : Status::failed("uniaxial: " + status.reason() + ", at " + row_name(strip, stretch, lost));
  if (!plain) return write(strip, path, output);
  if (detail::all_finite(output.values.data(), output.values.size())) return {};  // the host checks derivatives
  std::size_t bad = 0;
  while (bad + 1 < n && std::isfinite(output.values[bad])) ++bad;
  return overflow(strip, stretch, bad);
}

}  // namespace tunica::uniaxial
