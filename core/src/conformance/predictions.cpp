// SPDX-License-Identifier: Apache-2.0
#include "conformance/predictions.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace tunica::conformance {

Values values_at(const Simulation& s, const Values& p, const Values& q, const Values& other, std::size_t k) {
  std::vector<std::span<const double>> abscissae;
  if (!other.empty()) {
    for (const auto& column : s.test.rows().abscissae) abscissae.push_back(column.values);
    abscissae[k] = other;
  }
  Values values(size_of(s));
  const Status status = s.test.predict({s.model, p, q, abscissae, s.layers}, {values, {}, {}, {}});
  if (!status.ok()) throw std::runtime_error("the test answers '" + status.reason() + "'");
  return values;
}

double channel_scale(const Simulation& s, std::span<const double> column, std::size_t i) {
  const std::size_t n = s.test.rows().count, begin = i / n * n;
  double scale = 1e-6;
  for (const double entry : column.subspan(begin, n)) scale = std::max(scale, std::abs(entry));
  return scale;
}

std::string place(const Simulation& s, std::size_t i) {
  const TestRows& rows = s.test.rows();
  const std::size_t row = i % rows.count;
  std::string text = fmt::format("row {}", row + 1);
  if (!rows.abscissae.empty())
    text += fmt::format(" ({} = {:.6g})", rows.abscissae[0].observable, rows.abscissae[0].values[row]);
  return text + fmt::format(", channel {}", rows.channels[i / rows.count]);
}

std::string parameter_name(const Simulation& s, std::size_t j) {
  const std::size_t models = s.model_parameters.size();
  const auto& of_model = s.model.describe().parameters;
  if (j >= models) return "the test's " + s.test.describe().parameters[j - models].name;
  return "the model's " + (of_model.empty() ? "?" : of_model[j % of_model.size()].name);
}

}  // namespace tunica::conformance
