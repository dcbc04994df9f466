// SPDX-License-Identifier: Apache-2.0
#include "misread.hpp"

#include <algorithm>
#include <utility>

#include "tunica/tests/decorated_test.hpp"

namespace tunica::channel_errors {
namespace {

class MisreadTest final : public DecoratedTest {
 public:
  MisreadTest(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where)
      : DecoratedTest(std::move(base), amplitude, 0), error_(error), where_(std::move(where)) {
    if (where_.share.empty()) where_.share.assign(rows().count, 1);
  }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double amplitude = DecoratedTest::amplitude(input);
    const Reading reading = error_(amplitude);
    const std::size_t n = rows().count;
    const std::span<double> by_base = base_jacobian(output), by_amplitude = own_jacobian(output);
    // The derivative by a gain is the true value.
    std::vector<double> kept;
    std::span<double> values = output.values;
    if (!by_base.empty() && values.empty() && reading.gain_slope != 0) {
      kept.resize(prediction_count());
      values = kept;
    }
    Status status = base().predict(bare(input), {values, by_base, output.abscissa_derivative, output.diagnostics});
    if (!status.ok()) return status;
    if (!by_base.empty()) {
      std::fill(by_amplitude.begin(), by_amplitude.end(), 0.0);
      for (const std::size_t channel : where_.channels) {
        for (std::size_t row = 0; row < n; ++row) {
          const std::size_t i = channel * n + row;
          by_amplitude[i] = reading.shift_slope * where_.share[row];
          if (reading.gain_slope != 0) by_amplitude[i] += reading.gain_slope * values[i];
        }
      }
    }
    if (amplitude == 0) return {};  // not even 0 is added at the null: −0 would change its sign
    for (const std::size_t channel : where_.channels) {
      for (std::size_t row = 0; row < (output.values.empty() ? 0 : n); ++row) {
        double& value = output.values[channel * n + row];
        value = reading.gain * value + reading.shift * where_.share[row];
      }
      scale(by_base, channel, reading.gain);
      scale(output.abscissa_derivative, channel, reading.gain);
    }
    return {};
  }

 private:
  void scale(std::span<double> columns, std::size_t channel, double gain) const {
    const std::size_t n = rows().count, column = prediction_count();
    for (std::size_t at = channel * n; at < columns.size(); at += column)
      for (double& derivative : columns.subspan(at, n)) derivative *= gain;
  }

  Error error_;
  Where where_;
};

}  // namespace

std::unique_ptr<Test> misread(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where) {
  return std::make_unique<MisreadTest>(std::move(base), amplitude, error, std::move(where));
}

}  // namespace tunica::channel_errors
