// SPDX-License-Identifier: Apache-2.0
#include "axes_path.hpp"

#include <cmath>

#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
namespace {

bool all_finite(std::span<const double> values) { return detail::all_finite(values.data(), values.size()); }

/// Predictions run concurrently and thousands of times a second: one scratch a thread spares every one its allocations.
free_strip::Scratch& thread_scratch() {
  thread_local free_strip::Scratch instance;
  return instance;
}

}  // namespace

bool AxesPath::solved_by_model(const Strip& strip, const TestInput& input, const TestOutput& output,
                               std::span<const double> stretch, Status& status) const {
  const std::size_t n = stretch.size(), parameters = input.model_parameters.size();
  std::size_t lost = StripPath::none;
  StripPath path{
      .loaded = strip.loaded, .parameters = input.model_parameters, .stretch = stretch, .stress = output.values};
  if (!output.jacobian.empty()) path.stress_dp = output.jacobian.first(parameters * n);
  path.lost = &lost;
  if (input.abscissae.empty()) start_.set(path);
  if (!input.model.solve_strip(path, status)) return false;
  if (!status.ok()) {
    if (lost != StripPath::none)
      status = Status::failed("uniaxial: " + status.reason() + ", at " + row_name(strip, stretch, lost));
    return true;
  }
  if (all_finite(output.values)) return true;  // the host checks derivatives
  std::size_t bad = 0;
  while (bad + 1 < n && std::isfinite(output.values[bad])) ++bad;
  status = Status::failed("uniaxial: the stress overflows at " + row_name(strip, stretch, bad));
  return true;
}

Status AxesPath::predict(const Strip& strip, const TestInput& input, const TestOutput& output) const {
  const std::span<const double> stretch =
      input.abscissae.empty() ? std::span<const double>(strip.stretch) : input.abscissae[0];
  const std::size_t n = stretch.size(), channels = strip.channels.size();
  const bool plain = channels == 1 && strip.channels[0] == Channel::stress && strip.measure == Measure::cauchy &&
                     output.abscissa_derivative.empty() && output.diagnostics.empty();
  if (plain) {
    Status solved;
    if (solved_by_model(strip, input, output, stretch, solved)) return solved;
  }
  free_strip::Scratch& s = thread_scratch();
  s.reserve(n, input.model_parameters.size());
  const std::span<double> u(s.u.data(), n);
  const free_strip::Pull pull{input.model, input.model_parameters, strip.loaded};
  free_strip::Batch batch(pull, stretch, s);
  std::optional<std::size_t> lost;
  static const free_strip::Start without_nodes;
  Status status = (input.abscissae.empty() ? start_ : without_nodes).guess(pull, stretch, s, u, lost);
  if (status.ok()) status = free_strip::iterate(pull, stretch, free_strip::last_step, batch, u, lost);
  if (lost) return Status::failed("uniaxial: " + status.reason() + ", at " + row_name(strip, stretch, *lost));
  if (!status.ok()) return status;
  if (!output.jacobian.empty() || !output.abscissa_derivative.empty()) {
    for (std::size_t i = 0; i < n; ++i) u[i] *= 1 + s.step[i];
    if (status = batch.evaluate(u.data(), !output.jacobian.empty()); !status.ok()) return status;
  }

  const std::size_t rows = channels * n;
  bool finite = true;
  if (plain && !output.values.empty()) {
    for (std::size_t i = 0; i < n; ++i) output.values[i] = s.stress[i] + s.stress_by_y[i] * s.step[i];
    finite = all_finite(output.values);
  }
  for (std::size_t i = 0; !plain && i < n; ++i) {
    RowSolution row{stretch[i], s.stress[i] + s.stress_by_y[i] * s.step[i], std::log(u[i]) + std::log1p(s.step[i]), 0,
                    0};
    if (!output.abscissa_derivative.empty()) batch.by_stretch(i, row.stress_by_l, row.y_by_l);
    finite &= std::isfinite(row.stress) && std::isfinite(row.y);
    for (std::size_t k = 0; k < channels; ++k) {
      const std::size_t at = k * n + i;
      if (!output.values.empty()) output.values[at] = channel_value(strip.channels[k], strip.measure, row);
      if (!output.abscissa_derivative.empty())
        output.abscissa_derivative[at] = channel_by_stretch(strip.channels[k], strip.measure, row);
    }
    if (!output.diagnostics.empty()) {
      output.diagnostics[i] = std::exp(row.y / 2);
      output.diagnostics[n + i] = 1 / (stretch[i] * output.diagnostics[i]);
    }
  }
  if (!output.jacobian.empty() && plain) batch.prepare_parameters();
  for (std::size_t j = 0; !output.jacobian.empty() && j < input.model_parameters.size(); ++j) {
    double* const column = output.jacobian.data() + j * rows;
    if (plain) {
      batch.stress_by_parameter(j, column);
    } else {
      for (std::size_t i = 0; i < n; ++i) {
        double stress_p, y_p;
        batch.by_parameter(i, j, stress_p, y_p);
        const RowSolution row{stretch[i], s.stress[i], std::log(u[i]), 0, 0};
        for (std::size_t k = 0; k < channels; ++k)
          column[k * n + i] = channel_derivative(strip.channels[k], strip.measure, row, stress_p, y_p);
      }
    }
    finite &= all_finite({column, rows});
  }
  if (!finite) {
    std::size_t bad = 0;
    while (bad + 1 < n && std::isfinite(s.stress[bad])) ++bad;
    return Status::failed("uniaxial: the stress overflows at " + row_name(strip, stretch, bad));
  }
  return {};
}

}  // namespace tunica::uniaxial
