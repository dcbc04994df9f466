// SPDX-License-Identifier: Apache-2.0
#include "field_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::field {

FieldRows::FieldRows(const TestSetup& setup, const Edges& edges) {
  take_rows(setup);
  take_frames(setup, edges);
}

void FieldRows::take_rows(const TestSetup& setup) {
  for (const auto& column : setup.rows.abscissae)
    for (std::size_t k = 0; k < 3; ++k)
      if (column.observable == std::array{"step", "x", "y"}[k])
        abscissae_[k].assign(column.values.begin(), column.values.end());
  const std::size_t n = setup.rows.count;
  const auto& [step, x, y] = abscissae_;
  if (x.empty() || y.empty())
    throw InputError("full_field: no columns are mapped to 'x' and 'y', where the points are before loading; map them");
  rows_.count = n;
  for (const auto& column : setup.rows.abscissae) {
    rows_.abscissae.push_back(column);
    rows_.abscissae.back().values = abscissae_[column.observable == "step" ? 0 : column.observable == "x" ? 1 : 2];
  }
  rows_.channels = setup.rows.channels;
  for (const std::string& name : rows_.channels)
    channels_.push_back(
        static_cast<Channel>(std::find(channel_names.begin(), channel_names.end(), name) - channel_names.begin()));
  std::map<double, std::size_t> number;
  for (const double value : step) {
    if (!std::isfinite(value)) throw InputError("full_field: a row has no step; give every row its step");
    number.emplace(value, 0);
  }
  for (auto& [value, index] : number) {
    index = steps_.size();
    steps_.push_back({value, {}, {}});
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isfinite(x[i]) != std::isfinite(y[i]))
      throw InputError(fmt::format("full_field: row {} has one of x and y; give both, or none for forces", i + 1));
    point_.push_back(none);
    steps_[number.at(step[i])].rows.push_back(i);
  }
}

/// The points of each step and the values measured there.
void FieldRows::take_frames(const TestSetup& setup, const Edges& edges) {
  std::array<std::span<const double>, 2> measured;
  for (std::size_t k = 0; k < channels_.size() && k < setup.measured.size(); ++k)
    if (channels_[k] == Channel::ux || channels_[k] == Channel::uy)
      measured[channels_[k] == Channel::ux ? 0 : 1] = setup.measured[k];
  for (std::size_t c = 0; c < 2; ++c)
    for (const auto& side : edges)
      if ((side[c] == Edge::uniform || side[c] == Edge::measured) && measured[c].empty())
        throw InputError(
            fmt::format("full_field: a side moves as measured in {0}, and no column is mapped to 'u{0}'; "
                        "map it",
                        c == 0 ? "x" : "y"));
  std::map<Vector, std::size_t> known;
  for (Step& step : steps_) {
    for (const std::size_t i : step.rows) {
      const Vector point{abscissae_[1][i], abscissae_[2][i]};
      if (!std::isfinite(point[0])) continue;
      const auto [found, is_new] = known.emplace(point, points_.size());
      if (is_new) points_.push_back(point);
      point_[i] = found->second;
      step.frame.points.push_back(point);
      for (std::size_t c = 0; c < 2; ++c)
        step.frame.displacements[c].push_back(measured[c].empty() ? std::nan("") : measured[c][i]);
    }
    if (step.frame.points.empty())
      throw InputError(fmt::format(
          "full_field: step {:g} has forces and no points; leave its row out with \"where\" or \"rows\"", step.value));
  }
}

Eigen::VectorXd FieldRows::measured(const Step& step) {
  std::vector<double> values;
  for (const auto& component : step.frame.displacements)
    for (const double value : component)
      if (std::isfinite(value)) values.push_back(value);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace tunica::field
