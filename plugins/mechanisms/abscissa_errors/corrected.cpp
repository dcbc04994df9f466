// SPDX-License-Identifier: Apache-2.0
#include "corrected.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace tunica::abscissa_errors {
namespace {

/// The abscissae of a prediction, one of them corrected; what the input refers to lives here.
struct Corrected {
  std::vector<double> values;
  std::vector<std::span<const double>> columns;
};

class CorrectedTest final : public Test {
 public:
  CorrectedTest(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where)
      : base_(std::move(base)), description_(base_->describe()), error_(error), where_(where) {
    description_.parameters.push_back(amplitude);
    description_.nulls.push_back(0);
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double amplitude = input.test_parameters.back();
    Corrected memory;
    const TestInput truth = bare(input, memory);
    const std::size_t size = rows().channels.size() * rows().count;
    const std::size_t bare_size = output.jacobian.empty() ? 0 : output.jacobian.size() - size;
    TestOutput inner = output;
    inner.jacobian = output.jacobian.first(bare_size);

    std::vector<double> own_values, own_slopes;
    if (!output.jacobian.empty() && output.abscissa_derivative.empty()) {
      own_slopes.resize(rows().abscissae.size() * size);
      // Tests may take another path where derivatives by abscissae are wanted too. At the null, where the base's own
      // numbers are promised, it is asked twice, unless that is dear.
      if (amplitude != 0 || description_.costly) inner.abscissa_derivative = own_slopes;
    }
    if (where_.power != 0 && output.values.empty() && !output.jacobian.empty())
      own_values.resize(size), inner.values = own_values;
    if (Status status = base_->predict(truth, inner); !status.ok()) return status;
    if (!own_slopes.empty() && inner.abscissa_derivative.empty()) {
      if (Status status = base_->predict(truth, {{}, {}, own_slopes, {}}); !status.ok()) return status;
      inner.abscissa_derivative = own_slopes;
    }
    if (!output.jacobian.empty()) by_amplitude(input, amplitude, inner, output.jacobian.subspan(bare_size));
    if (amplitude != 0) recompute(amplitude, bare_size, output);
    return {};
  }
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    Corrected memory;
    return base_->agreement(bare(input, memory), found);
  }
  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override {
    Corrected memory;
    return base_->snapshots(bare(input, memory), rows, found);
  }

 private:
  [[nodiscard]] std::span<const double> measured(const TestInput& input) const {
    return input.abscissae.empty() ? rows().abscissae[where_.abscissa].values : input.abscissae[where_.abscissa];
  }

  TestInput bare(TestInput input, Corrected& memory) const {
    const double amplitude = input.test_parameters.back();
    input.test_parameters = input.test_parameters.first(input.test_parameters.size() - 1);
    if (amplitude == 0) return input;
    const Correction correction = error_(amplitude);
    for (const double value : measured(input)) memory.values.push_back(correction.scale * value + correction.shift);
    memory.columns.assign(input.abscissae.begin(), input.abscissae.end());
    if (memory.columns.empty())
      for (const TestRows::Column& column : rows().abscissae) memory.columns.push_back(column.values);
    memory.columns[where_.abscissa] = memory.values;
    input.abscissae = memory.columns;
    return input;
  }

  /// d(s^q v)/da = s^q ∂v/∂true ∂true/∂a + q s^{q−1} s' v, with the derivative of the base still by the true abscissa.
  void by_amplitude(const TestInput& input, double amplitude, const TestOutput& inner, std::span<double> column) const {
    const std::size_t n = rows().count, size = column.size();
    const Correction c = error_(amplitude);
    const std::span<const double> slopes = inner.abscissa_derivative.subspan(where_.abscissa * size, size);
    const std::span<const double> at = measured(input);
    for (std::size_t i = 0; i < size; ++i) {
      column[i] = slopes[i] * (c.scale_slope * at[i % n] + c.shift_slope);
      if (where_.power == 0 || i / n != where_.channel) continue;
      const double factor = std::pow(c.scale, where_.power);
      column[i] = factor * column[i] + where_.power * factor / c.scale * c.scale_slope * inner.values[i];
    }
  }

  /// What the base predicts, and its derivatives by its parameters, to the data's numbers: times s^q in the channel.
  /// Derivatives by the abscissa become those by the measured one, times s.
  void recompute(double amplitude, std::size_t bare_size, const TestOutput& output) const {
    const std::size_t n = rows().count, size = rows().channels.size() * n;
    const Correction correction = error_(amplitude);
    if (!output.abscissa_derivative.empty())
      for (double& slope : output.abscissa_derivative.subspan(where_.abscissa * size, size)) slope *= correction.scale;
    if (where_.power == 0) return;
    const double factor = std::pow(correction.scale, where_.power);
    for (const std::span<double> columns :
         {output.values, output.jacobian.first(bare_size), output.abscissa_derivative})
      for (std::size_t begin = where_.channel * n; begin < columns.size(); begin += size)
        for (double& value : columns.subspan(begin, n)) value *= factor;
  }

  std::unique_ptr<Test> base_;
  TestDescription description_;
  Error error_;
  Where where_;
};

}  // namespace

std::unique_ptr<Test> corrected(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where) {
  return std::make_unique<CorrectedTest>(std::move(base), amplitude, error, where);
}

}  // namespace tunica::abscissa_errors
