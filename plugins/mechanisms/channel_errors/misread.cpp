// SPDX-License-Identifier: Apache-2.0
#include "misread.hpp"

#include <algorithm>
#include <utility>

namespace tunica::channel_errors {
namespace {

class MisreadTest final : public Test {
 public:
  MisreadTest(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where)
      : base_(std::move(base)), description_(base_->describe()), error_(error), where_(std::move(where)) {
    description_.parameters.push_back(amplitude);
    description_.nulls.push_back(0);
    if (where_.share.empty()) where_.share.assign(base_->rows().count, 1);
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double amplitude = input.test_parameters.back();
    const Reading reading = error_(amplitude);
    const std::size_t n = rows().count, column = rows().channels.size() * n;
    const std::size_t bare_size = output.jacobian.empty() ? 0 : output.jacobian.size() - column;
    // The derivative by a gain is the true value.
    std::vector<double> kept;
    std::span<double> values = output.values;
    if (bare_size > 0 && values.empty() && reading.gain_slope != 0) kept.resize(column), values = kept;
    Status status = base_->predict(
        bare(input), {values, output.jacobian.first(bare_size), output.abscissa_derivative, output.diagnostics});
    if (!status.ok()) return status;
    if (bare_size > 0) {
      const auto by_amplitude = output.jacobian.subspan(bare_size);
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
      scale(output.jacobian.first(bare_size), channel, reading.gain);
      scale(output.abscissa_derivative, channel, reading.gain);
    }
    return {};
  }
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    return base_->agreement(bare(input), found);
  }
  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override {
    return base_->snapshots(bare(input), rows, found);
  }

 private:
  static TestInput bare(TestInput input) {
    input.test_parameters = input.test_parameters.first(input.test_parameters.size() - 1);
    return input;
  }
  void scale(std::span<double> columns, std::size_t channel, double gain) const {
    const std::size_t n = rows().count, column = rows().channels.size() * n;
    for (std::size_t at = channel * n; at < columns.size(); at += column)
      for (double& derivative : columns.subspan(at, n)) derivative *= gain;
  }

  std::unique_ptr<Test> base_;
  TestDescription description_;
  Error error_;
  Where where_;
};

}  // namespace

std::unique_ptr<Test> misread(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where) {
  return std::make_unique<MisreadTest>(std::move(base), amplitude, error, std::move(where));
}

}  // namespace tunica::channel_errors
