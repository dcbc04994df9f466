// SPDX-License-Identifier: Apache-2.0
#include "late.hpp"

#include <utility>
#include <vector>

#include "tunica/error.hpp"
#include "tunica/tests/decorated_test.hpp"

namespace tunica::record_errors {
namespace {

class LateTest final : public DecoratedTest {
 public:
  LateTest(std::unique_ptr<Test> base, const Parameter& amplitude) : DecoratedTest(std::move(base), amplitude, 0) {}

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double lag = amplitude(input);
    std::vector<double> kept;
    TestOutput inner = output;
    inner.jacobian = base_jacobian(output);
    if (!output.jacobian.empty() && output.values.empty()) {
      kept.resize(prediction_count());
      inner.values = kept;
    }
    if (Status status = base().predict(bare(input), inner); !status.ok()) return status;
    const std::size_t n = rows().count;
    if (!output.jacobian.empty()) {
      const std::span<double> own = own_jacobian(output);
      for (std::size_t i = 0; i < own.size(); ++i) own[i] = -rate(inner.values.subspan(i - i % n, n), i % n);
    }
    if (lag == 0) return {};
    for (const std::span<double> columns : {output.values, inner.jacobian}) delay(columns, lag);
    // By the abscissa of the same row: the rows beside it do not move.
    for (std::size_t i = 0; i < output.abscissa_derivative.size(); ++i)
      output.abscissa_derivative[i] *= 1 - lag * own_part(i % n);
    return {};
  }

 private:
  struct Beside {
    std::size_t before, after;
    double time;  ///< between them; 0 where the clock stands
  };
  [[nodiscard]] Beside beside(std::size_t row) const {
    const std::size_t n = rows().count, before = row == 0 ? 0 : row - 1, after = row + 1 < n ? row + 1 : row;
    return {before, after, rows().time[after] - rows().time[before]};
  }
  [[nodiscard]] double rate(std::span<const double> values, std::size_t row) const {
    const Beside at = beside(row);
    return at.time > 0 ? (values[at.after] - values[at.before]) / at.time : 0;
  }
  /// Of the rate, by the value of the row itself.
  [[nodiscard]] double own_part(std::size_t row) const {
    const Beside at = beside(row);
    return at.time > 0 ? (static_cast<double>(at.after == row) - static_cast<double>(at.before == row)) / at.time : 0;
  }
  void delay(std::span<double> columns, double lag) const {
    const std::size_t n = rows().count;
    std::vector<double> rates(n);
    for (std::size_t first = 0; first < columns.size(); first += n) {
      const std::span<double> column = columns.subspan(first, n);
      for (std::size_t i = 0; i < n; ++i) rates[i] = rate(column, i);
      for (std::size_t i = 0; i < n; ++i) column[i] -= lag * rates[i];
    }
  }
};

}  // namespace

std::unique_ptr<Test> late(std::unique_ptr<Test> base, const Parameter& amplitude) {
  if (base->rows().time.size() < 2)
    throw InputError(
        "channel_lag: the test's data have no time, and nothing can come late; map a column to \"time\", or take the "
        "mechanism out");
  return std::make_unique<LateTest>(std::move(base), amplitude);
}

}  // namespace tunica::record_errors
