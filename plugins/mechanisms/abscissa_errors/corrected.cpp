// SPDX-License-Identifier: Apache-2.0
#include "corrected.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "tunica/tests/decorated_test.hpp"

namespace tunica::abscissa_errors {
namespace {

/// The abscissae of a prediction, with one corrected. It owns the data that the input refers to.
struct Corrected {
  std::vector<double> values;
  std::vector<std::span<const double>> columns;
};

class CorrectedTest final : public DecoratedTest {
 public:
  CorrectedTest(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where)
      : DecoratedTest(std::move(base), amplitude, 0), error_(error), where_(where) {}

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double amplitude = DecoratedTest::amplitude(input);
    if (!output.jacobian.empty() && remembers(input)) return predict_along_path(input, output);
    Corrected memory;
    const TestInput truth = corrected_input(input, memory);
    const std::size_t size = prediction_count();
    TestOutput inner = output;
    inner.jacobian = base_jacobian(output);

    std::vector<double> own_values, own_slopes;
    if (!output.jacobian.empty() && output.abscissa_derivative.empty()) {
      own_slopes.resize(rows().abscissae.size() * size);
      // Tests may take another path where derivatives by abscissae are wanted too. At the null, where the base's own
      // numbers are promised, it is asked twice, unless that is dear.
      if (amplitude != 0 || describe().costly) inner.abscissa_derivative = own_slopes;
    }
    const bool sloped = !output.jacobian.empty() || !output.abscissa_derivative.empty();
    if (where_.power != 0 && output.values.empty() && sloped) {
      own_values.resize(size);
      inner.values = own_values;
    }
    if (Status status = base().predict(truth, inner); !status.ok()) return status;
    if (!own_slopes.empty() && inner.abscissa_derivative.empty()) {
      if (Status status = base().predict(truth, {{}, {}, own_slopes, {}}); !status.ok()) return status;
      inner.abscissa_derivative = own_slopes;
    }
    if (!output.jacobian.empty()) set_by_amplitude(input, amplitude, inner, own_jacobian(output));
    if (amplitude != 0) recompute(input, amplitude, inner.values, output);
    return {};
  }
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    Corrected memory;
    return base().agreement(corrected_input(input, memory), found);
  }
  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override {
    Corrected memory;
    return base().snapshots(corrected_input(input, memory), rows, found);
  }

 private:
  [[nodiscard]] std::span<const double> measured(const TestInput& input) const {
    return input.abscissae.empty() ? rows().abscissae[where_.abscissa].values : input.abscissae[where_.abscissa];
  }

  TestInput corrected_input(const TestInput& measured_input, Corrected& memory) const {
    TestInput input = bare(measured_input);
    const double amplitude = DecoratedTest::amplitude(measured_input);
    if (amplitude == 0) return input;
    const Correction correction = error_(amplitude);
    for (const double value : measured(input)) memory.values.push_back(correction.scale * value + correction.shift);
    memory.columns = abscissae(input, rows());
    memory.columns[where_.abscissa] = memory.values;
    input.abscissae = memory.columns;
    return input;
  }

  /// A row of a model with memory depends on the abscissae of all rows before it, not on its own alone: the column of
  /// the amplitude is a difference of whole predictions, all others are those of the base.
  Status predict_along_path(const TestInput& input, const TestOutput& output) const {
    const double amplitude = DecoratedTest::amplitude(input);
    Corrected memory;
    TestOutput inner = output;
    inner.jacobian = base_jacobian(output);
    if (Status status = base().predict(corrected_input(input, memory), inner); !status.ok()) return status;
    if (amplitude != 0) recompute(input, amplitude, inner.values, output);
    return difference_by_amplitude(input, own_jacobian(output));
  }

  /// With s = true/measured,  d(s^q v)/da = s^q ∂v/∂true ∂true/∂a + q s^{q−1} ∂s/∂a v,  with the derivative of the base
  /// still by the true abscissa.
  void set_by_amplitude(const TestInput& input, double amplitude, const TestOutput& inner,
                        std::span<double> column) const {
    const std::size_t n = rows().count, size = column.size();
    const Correction c = error_(amplitude);
    const std::span<const double> slopes = inner.abscissa_derivative.subspan(where_.abscissa * size, size);
    const std::span<const double> at = measured(input);
    for (std::size_t i = 0; i < size; ++i) {
      const double m = at[i % n];
      column[i] = slopes[i] * (c.scale_slope * m + c.shift_slope);
      if (where_.power == 0 || i / n != where_.channel) continue;
      const double s = c.ratio(m), factor = std::pow(s, where_.power);
      column[i] = factor * column[i] + where_.power * factor / s * c.ratio_slope(m) * inner.values[i];
    }
  }

  /// What the base predicts, `values`, and its derivatives by its parameters, to the data's numbers: times s^q in the
  /// channel. Derivatives by the abscissa become those by the measured one, times ∂true/∂measured; and with ∂s by it.
  void recompute(const TestInput& input, double amplitude, std::span<const double> values,
                 const TestOutput& output) const {
    const std::size_t n = rows().count, size = prediction_count();
    const Correction c = error_(amplitude);
    const auto slopes = output.abscissa_derivative.empty()
                            ? std::span<double>()
                            : output.abscissa_derivative.subspan(where_.abscissa * size, size);
    for (double& slope : slopes) slope *= c.scale;
    if (where_.power == 0) return;
    const std::span<const double> at = measured(input);
    const std::size_t first = where_.channel * n;
    for (std::size_t i = 0; i < n; ++i) {
      const double s = c.ratio(at[i]), factor = std::pow(s, where_.power);
      const double by_measured =
          slopes.empty() ? 0 : where_.power * factor / s * c.ratio_by_measured(at[i]) * values[first + i];
      for (const std::span<double> columns : {output.values, base_jacobian(output), output.abscissa_derivative})
        for (std::size_t k = first + i; k < columns.size(); k += size) columns[k] *= factor;
      if (!slopes.empty()) slopes[first + i] += by_measured;
    }
  }

  Error error_;
  Where where_;
};

}  // namespace

std::unique_ptr<Test> corrected(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where) {
  return std::make_unique<CorrectedTest>(std::move(base), amplitude, error, where);
}

}  // namespace tunica::abscissa_errors
