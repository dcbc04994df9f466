// SPDX-License-Identifier: Apache-2.0
#include "shifted.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace tunica::controlled_strip {

using namespace temperature_shift;

Temperature temperature_of(const TestSetup& setup, const char* type) {
  const std::string begin = std::string(type) + ": ";
  Temperature at{shift_named(setup.options.text("shift")), setup.options.number("temperature"),
                 setup.options.number("reference_temperature")};
  if (at.shift == Shift::none) {
    if (at.T > 0)
      throw InputError(begin +
                       "\"temperature\" changes nothing without \"shift\"; take 'wlf' or 'arrhenius', or leave "
                       "it out");
    return at;
  }
  if (!(at.T > 0 && at.T0 > 0))
    throw InputError(begin +
                     "\"shift\" needs \"temperature\" and \"reference_temperature\"; give both, for example "
                     "\"25 degC\"");
  if (setup.rows.time.empty())
    throw InputError(begin + "\"shift\" changes nothing without a time; map a column to 'time', or leave it out");
  return at;
}

/// ∂v/∂p = ∂v/∂ ln a_T ∂ ln a_T/∂p; the first factor by differences of four points, as models have no derivatives by
/// the time.
Status follow_shifted(const Strip& strip, const Temperature& at, std::span<const LoadStep> steps,
                      const TestInput& input, const TestOutput& output) {
  if (at.shift == Shift::none) return follow(strip, steps, input, output);
  const std::span<const double> own = input.test_parameters.subspan(strip.has_set ? 1 : 0);
  Strip shifted = strip;
  const double factor = shift_factor(at.shift, at.T, at.T0, own);
  if (!(factor > 0 && std::isfinite(factor)))
    return Status::failed(std::string(strip.type) +
                          ": the temperature lies where the shift has no value; narrow the bounds of c2");
  shifted.time_factor = 1 / factor;
  if (Status status = follow(shifted, steps, input, output); !status.ok() || output.jacobian.empty()) return status;
  const std::size_t size = strip.channels.size() * strip.rows;
  constexpr double h = 1e-3;
  constexpr std::array shifts{1.0, -1.0, 2.0, -2.0};
  std::array<std::vector<double>, 4> moved;
  for (std::size_t k = 0; k < 4; ++k) {
    shifted.time_factor = std::exp(-shifts[k] * h) / factor;
    moved[k].resize(size);
    if (Status status = follow(shifted, steps, input, {moved[k], {}, {}, {}}); !status.ok()) return status;
  }
  const std::vector<double> slopes = shift_slopes(at.shift, at.T, at.T0, own);
  const std::size_t first = input.model_parameters.size() + (strip.has_set ? 1 : 0);
  for (std::size_t j = 0; j < slopes.size(); ++j)
    for (std::size_t i = 0; i < size; ++i)
      output.jacobian[(first + j) * size + i] =
          slopes[j] * (8 * (moved[0][i] - moved[1][i]) - (moved[2][i] - moved[3][i])) / (12 * h);
  return {};
}

}  // namespace tunica::controlled_strip
