// SPDX-License-Identifier: Apache-2.0
#include "conformance/predictions.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "conformance/handout.hpp"

namespace tunica::conformance {

Prediction predict(const Test& test, const TestInput& input, const PredictionSelection& wanted) {
  const std::size_t n = test.rows().count, size = n * test.rows().channels.size();
  const TestDescription& description = test.describe();
  Handout handout("the test");
  std::vector<std::span<const double>> abscissae;
  for (const auto& column : input.abscissae) abscissae.push_back(handout.input("abscissae", column));
  const TestInput given{input.model, handout.input("model_parameters", input.model_parameters),
                        handout.input("test_parameters", input.test_parameters), abscissae, input.layers};
  const std::size_t parameters = input.model_parameters.size() + input.test_parameters.size();
  const TestOutput out{
      handout.output("values", wanted.values ? size : 0),
      handout.output("jacobian", wanted.jacobian ? size * parameters : 0),
      handout.output("abscissa_derivative", wanted.abscissa_derivative ? size * test.rows().abscissae.size() : 0),
      handout.output("diagnostics", wanted.diagnostics ? n * description.diagnostics.size() : 0)};
  Prediction found;
  found.status = test.predict(given, out);
  handout.verify(found.status.ok());
  const auto copy = [](std::span<const double> output) { return Values(output.begin(), output.end()); };
  found.values = copy(out.values);
  found.jacobian = copy(out.jacobian);
  found.abscissa_derivative = copy(out.abscissa_derivative);
  found.diagnostics = copy(out.diagnostics);
  return found;
}

Values values_at(const Simulation& s, const Values& p, const Values& q, const Values& other, std::size_t k) {
  std::vector<std::span<const double>> abscissae;
  if (!other.empty()) {
    for (const auto& column : s.test.rows().abscissae) abscissae.push_back(column.values);
    abscissae[k] = other;
  }
  const Prediction found = predict(s.test, {s.model, p, q, abscissae, s.layers});
  if (!found.status.ok()) throw std::runtime_error("the test answers '" + found.status.reason() + "'");
  return found.values;
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
