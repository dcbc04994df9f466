// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "tunica/plugin.hpp"

namespace tunica::detail {

/// The rows of a test whose formulas take `count` abscissae at once: copied, checked, named.
template <std::size_t count>
class PointRows {
 public:
  /// What formulas get: one abscissa as it is, several as an array in the order of the observables.
  template <class T>
  using At = std::conditional_t<count == 1, T, std::array<T, count>>;
  using Columns = std::span<const std::span<const double>>;

  /// Throws InputError if an abscissa has no column, or if time runs backwards.
  PointRows(const char* type, const std::vector<Observable>& observables, const TestRows& rows)
      : type_(type), time_(rows.time.begin(), rows.time.end()) {
    std::vector<std::string> channels;
    for (const Observable& observable : observables) {
      if (observable.role == Observable::Role::channel) channels.push_back(observable.name);
      if (observable.role != Observable::Role::abscissa) continue;
      abscissae_.push_back(observable);
      values_.push_back(column_of(rows, observable.name));
    }
    if (abscissae_.size() != count)
      throw std::logic_error(type_ + ": the geometry declares another number of abscissae than it counts");
    columns_.assign(values_.begin(), values_.end());
    for (const std::string& channel : rows.channels) {
      const auto place = std::ranges::find(channels, channel);
      if (place == channels.end()) throw std::logic_error(type_ + ": the geometry declares no channel " + channel);
      channels_.push_back(static_cast<std::size_t>(place - channels.begin()));
    }
    names_ = rows.channels;
    for (std::size_t i = 1; i < time_.size(); ++i)
      if (!(time_[i] >= time_[i - 1]))
        throw InputError(type_ + ": time runs backwards at row " + std::to_string(i + 1) +
                         "; give the rows in the order in which they were measured");
  }
  // columns_ points into values_.
  PointRows(const PointRows&) = delete;
  PointRows& operator=(const PointRows&) = delete;

  [[nodiscard]] std::size_t size() const { return values_.front().size(); }
  [[nodiscard]] Columns columns() const { return columns_; }
  [[nodiscard]] const std::vector<Observable>& abscissae() const { return abscissae_; }
  /// The channels by their number among the observables, in the order of the predictions.
  [[nodiscard]] const std::vector<std::size_t>& channels() const { return channels_; }
  /// As Test::rows() answers them; they point into this object.
  [[nodiscard]] TestRows rows() const {
    TestRows rows{size(), {}, names_, time_};
    for (std::size_t a = 0; a < count; ++a) rows.abscissae.push_back({abscissae_[a].name, values_[a]});
    return rows;
  }
  /// Time since the row before, s; since rest at the first one; 0 without a clock.
  [[nodiscard]] double step(std::size_t row) const {
    if (time_.empty()) return 0;
    return row == 0 ? std::max(0.0, time_[0]) : time_[row] - time_[row - 1];
  }

  template <class T>
  static At<T> at_point(std::span<const T> x) {
    if constexpr (count == 1) {
      return x[0];
    } else {
      At<T> at;
      std::copy_n(x.begin(), count, at.begin());
      return at;
    }
  }
  static At<double> at_row(Columns columns, std::size_t row) {
    const std::array<double, count> x = values_at(columns, row);
    return at_point<double>(x);
  }
  /// "row 3 has shear 0.200000 1"
  [[nodiscard]] std::string named(std::size_t row, Columns columns) const {
    const std::array<double, count> x = values_at(columns, row);
    return named(row, x, abscissae_);
  }
  static std::string named(std::size_t row, std::span<const double> x, const std::vector<Observable>& abscissae) {
    std::string text = "row " + std::to_string(row + 1) + " has ";
    for (std::size_t a = 0; a < count; ++a)
      text += (a > 0 ? " and " : "") + abscissae[a].name + " " + std::to_string(x[a]) + " " + abscissae[a].unit;
    return text;
  }

 private:
  [[nodiscard]] std::vector<double> column_of(const TestRows& rows, const std::string& name) const {
    for (const TestRows::Column& column : rows.abscissae)
      if (column.observable == name) return {column.values.begin(), column.values.end()};
    throw InputError(type_ + ": no column is mapped to '" + name + "'; map one in \"columns\"");
  }
  static std::array<double, count> values_at(Columns columns, std::size_t row) {
    std::array<double, count> x;
    for (std::size_t a = 0; a < count; ++a) x[a] = columns[a][row];
    return x;
  }

  std::string type_;
  std::vector<Observable> abscissae_;
  std::vector<std::vector<double>> values_;  ///< of the rows, one an abscissa
  std::vector<std::span<const double>> columns_;
  std::vector<double> time_;
  std::vector<std::string> names_;  ///< of the channels
  std::vector<std::size_t> channels_;
};

}  // namespace tunica::detail
