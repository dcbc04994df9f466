// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "tunica/test.hpp"

namespace tunica {

/// Position of a mapped abscissa among those of the rows; none if the data have no such column.
inline std::optional<std::size_t> abscissa_index(const TestRows& rows, std::string_view observable) {
  const auto found = std::ranges::find(rows.abscissae, observable, &TestRows::Column::observable);
  if (found == rows.abscissae.end()) return std::nullopt;
  return static_cast<std::size_t>(found - rows.abscissae.begin());
}

/// Position of a fitted channel among those of the rows; none if the data have no such column.
inline std::optional<std::size_t> channel_index(const TestRows& rows, std::string_view observable) {
  const auto found = std::ranges::find(rows.channels, observable);
  if (found == rows.channels.end()) return std::nullopt;
  return static_cast<std::size_t>(found - rows.channels.begin());
}

/// The abscissae of a prediction: those of the input or, if it has none, those of the rows.
inline std::vector<std::span<const double>> abscissae(const TestInput& input, const TestRows& rows) {
  std::vector<std::span<const double>> columns(input.abscissae.begin(), input.abscissae.end());
  if (columns.empty())
    for (const TestRows::Column& column : rows.abscissae) columns.push_back(column.values);
  return columns;
}

/// A base test that a mechanism wraps: one more parameter, the amplitude, after those of the base.
///
/// Rows, agreement and snapshots are those of the base. A subclass implements predict(): it calls base().predict() with
/// bare(input), and adds what the mechanism changes. At the null it returns the numbers of the base, bit for bit; do
/// not even add 0, because −0 would change its sign.
///
/// Jacobian: base_jacobian() goes to the base, own_jacobian() is the column of the amplitude. A mechanism that changes
/// abscissae, of which a model with memory sees more than the row's own, asks remembers() and differences that column.
class DecoratedTest : public Test {
 public:
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    return base_->agreement(bare(input), found);
  }
  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override {
    return base_->snapshots(bare(input), rows, found);
  }
  /// Passed on to the test inside.
  [[nodiscard]] std::vector<Effort> efforts() const override { return base_->efforts(); }

 protected:
  /// Appends `amplitude` with its `null` to the parameters of the base.
  DecoratedTest(std::unique_ptr<Test> base, const Parameter& amplitude, double null)
      : base_(std::move(base)), description_(base_->describe()) {
    description_.parameters.push_back(amplitude);
    description_.nulls.push_back(null);
  }

  /// The test without the mechanism.
  [[nodiscard]] const Test& base() const { return *base_; }
  /// c·n: the number of predictions, and of entries in one column of the Jacobian.
  [[nodiscard]] std::size_t prediction_count() const { return rows().channels.size() * rows().count; }
  /// The amplitude of this prediction.
  [[nodiscard]] static double amplitude(const TestInput& input) { return input.test_parameters.back(); }
  /// The input of the base: without the amplitude.
  [[nodiscard]] static TestInput bare(TestInput input) {
    input.test_parameters = input.test_parameters.first(input.test_parameters.size() - 1);
    return input;
  }
  /// Whether the model carries something from row to row. Then a row depends on the abscissae of all rows before it,
  /// and abscissa_derivative of a base, which is by the abscissa of the same row, says too little.
  [[nodiscard]] static bool remembers(const TestInput& input) {
    if (input.layers.empty()) return input.model.describe().history_size > 0;
    return std::ranges::any_of(input.layers, [](const Model* layer) { return layer->describe().history_size > 0; });
  }
  /// The column of the amplitude as a difference of whole predictions: central, or where that would leave the bounds
  /// (4f(h) − 3f(0) − f(2h))/2h on the side of the range. Good to about 1e-9 of the column.
  Status difference_by_amplitude(const TestInput& input, std::span<double> column) const {
    const Parameter& parameter = description_.parameters.back();
    const double at = amplitude(input), scale = std::max(std::abs(at), 0.01 * (parameter.max - parameter.min));
    const double h = std::cbrt(std::numeric_limits<double>::epsilon()) * scale;
    const bool below = at - h >= parameter.min, above = at + h <= parameter.max, central = below && above;
    const double first = above ? h : -h, second = central ? -h : 2 * first;
    std::vector<double> own(input.test_parameters.begin(), input.test_parameters.end()), here(column.size()),
        near(column.size()), far(column.size());
    TestInput shifted = input;
    shifted.test_parameters = own;
    const auto predict_at = [&](double offset, std::span<double> values) {
      own.back() = at + offset;
      return predict(shifted, {values, {}, {}, {}});
    };
    if (Status status = predict_at(first, near); !status.ok()) return status;
    if (Status status = predict_at(second, far); !status.ok()) return status;
    if (!central)
      if (Status status = predict_at(0, here); !status.ok()) return status;
    for (std::size_t i = 0; i < column.size(); ++i)
      column[i] = central ? (near[i] - far[i]) / (2 * h) : (4 * near[i] - 3 * here[i] - far[i]) / (2 * first);
    return {};
  }
  /// The columns of the base; empty if no Jacobian is wanted.
  [[nodiscard]] std::span<double> base_jacobian(const TestOutput& output) const {
    return output.jacobian.first(output.jacobian.empty() ? 0 : output.jacobian.size() - prediction_count());
  }
  /// The column of the amplitude; empty if no Jacobian is wanted.
  [[nodiscard]] std::span<double> own_jacobian(const TestOutput& output) const {
    return output.jacobian.last(output.jacobian.empty() ? 0 : prediction_count());
  }

 private:
  std::unique_ptr<Test> base_;
  TestDescription description_;
};

}  // namespace tunica
