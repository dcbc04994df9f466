// SPDX-License-Identifier: Apache-2.0
#include "support/test_conformance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <thread>

namespace tunica::testing {
namespace {

using Values = std::vector<double>;

std::size_t size_of(const Simulation& s) { return s.test.rows().count * s.test.rows().channels.size(); }

/// Predictions at the test's own abscissae, or with abscissa k replaced by `other`.
Values values_at(const Simulation& s, const Values& p, const Values& q, const Values& other = {}, std::size_t k = 0) {
  std::vector<std::span<const double>> abscissae;
  if (!other.empty()) {
    for (const auto& column : s.test.rows().abscissae) abscissae.push_back(column.values);
    abscissae[k] = other;
  }
  Values values(size_of(s));
  const Status status = s.test.predict({s.model, p, q, abscissae, s.layers}, {values, {}, {}, {}});
  if (!status.ok()) throw std::runtime_error(status.reason());
  return values;
}

/// Largest entry of a column within the channel that row i belongs to.
double scale_at(const Simulation& s, std::span<const double> column, std::size_t i) {
  const std::size_t n = s.test.rows().count, begin = i / n * n;
  double scale = 1e-6;
  for (const double entry : column.subspan(begin, n)) scale = std::max(scale, std::abs(entry));
  return scale;
}

}  // namespace

std::string jacobian_matches_differences(const Simulation& s) {
  const std::size_t rows = size_of(s), models = s.model_parameters.size(), all = models + s.test_parameters.size();
  Values values(rows), jacobian(all * rows);
  const Status status = s.test.predict(s.input(), {values, jacobian, {}, {}});
  if (!status.ok()) return status.reason();
  for (std::size_t j = 0; j < all; ++j) {
    Values p_up = s.model_parameters, p_down = p_up, q_up = s.test_parameters, q_down = q_up;
    double& up = j < models ? p_up[j] : q_up[j - models];
    double& down = j < models ? p_down[j] : q_down[j - models];
    const double h = up == 0 ? 1e-3 : 1e-5 * std::abs(up);
    up += h, down -= h;
    const Values above = values_at(s, p_up, q_up), below = values_at(s, p_down, q_down);
    const std::span<const double> column(jacobian.data() + j * rows, rows);
    for (std::size_t i = 0; i < rows; ++i) {
      const double expected = (above[i] - below[i]) / (2 * h);
      // Differences lose what the values themselves have in rounding.
      const double allowed = 1e-6 * scale_at(s, column, i) + 1e-13 * scale_at(s, values, i) / h;
      if (!(std::abs(column[i] - expected) <= allowed))
        return fmt::format("parameter {}, row {}: {:.12g}, differences give {:.12g}", j, i, column[i], expected);
    }
  }
  return {};
}

std::string abscissa_derivative_matches_differences(const Simulation& s) {
  const std::size_t rows = size_of(s), n = s.test.rows().count, count = s.test.rows().abscissae.size();
  Values derivative(count * rows);
  const Status status = s.test.predict(s.input(), {{}, {}, derivative, {}});
  if (!status.ok()) return status.reason();
  constexpr double h = 1e-5;
  for (std::size_t k = 0; k < count; ++k) {
    const auto bound = s.test.rows().abscissae[k].values;
    Values up(bound.begin(), bound.end()), down = up;
    for (std::size_t i = 0; i < n; ++i) up[i] += h, down[i] -= h;
    const Values above = values_at(s, s.model_parameters, s.test_parameters, up, k),
                 below = values_at(s, s.model_parameters, s.test_parameters, down, k);
    for (std::size_t i = 0; i < rows; ++i) {
      const double given = derivative[k * rows + i], expected = (above[i] - below[i]) / (2 * h);
      if (!(std::abs(given - expected) <= 1e-6 * std::max(1.0, std::abs(expected))))
        return fmt::format("abscissa {}, row {}: {:.12g}, differences give {:.12g}", k, i, given, expected);
    }
  }
  return {};
}

std::string values_do_not_depend_on_the_other_outputs(const Simulation& s) {
  const std::size_t rows = size_of(s), all = s.model_parameters.size() + s.test_parameters.size();
  const Values alone = values_at(s, s.model_parameters, s.test_parameters);
  Values values(rows), jacobian(all * rows), diagnostics(s.test.describe().diagnostics.size() * s.test.rows().count);
  const TestInput input = s.input();
  if (const Status status = s.test.predict(input, {values, jacobian, {}, diagnostics}); !status.ok())
    return status.reason();
  for (std::size_t i = 0; i < rows; ++i)
    if (!(std::abs(values[i] - alone[i]) <= 1e-10 * scale_at(s, alone, i)))
      return fmt::format("row {}: {:.15g} alone, {:.15g} with a Jacobian", i, alone[i], values[i]);
  return s.test.predict(input, {}).reason();
}

std::string given_abscissae_replace_the_bound_ones(const Simulation& s) {
  const auto bound = s.test.rows().abscissae[0].values;
  const Values own = values_at(s, s.model_parameters, s.test_parameters),
               given = values_at(s, s.model_parameters, s.test_parameters, {bound.begin(), bound.end()});
  for (std::size_t i = 0; i < own.size(); ++i)
    if (!(std::abs(own[i] - given[i]) <= 1e-9 * scale_at(s, own, i)))
      return fmt::format("row {}: {:.15g} bound, {:.15g} given", i, own[i], given[i]);
  return {};
}

std::string concurrent_predictions_agree(const Simulation& s) {
  std::array<Values, 4> results;
  std::vector<std::thread> threads;
  for (auto& result : results)
    threads.emplace_back([&s, &result] {
      for (int call = 0; call < 100; ++call) {
        Values p = s.model_parameters;
        p[0] *= 1 + 0.01 * call;
        const Values values = values_at(s, p, s.test_parameters);
        result.insert(result.end(), values.begin(), values.end());
      }
    });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results)
    if (result != results[0]) return "four threads with the same calls got different predictions";
  return {};
}

std::string overflow_is_a_status(const Simulation& s) {
  Values values(size_of(s));
  const Status status = s.test.predict(s.input(), {values, {}, {}, {}});
  if (status.kind() != Status::Kind::failed) return fmt::format("the status is '{}'", name(status.kind()));
  if (status.reason().find("row ") == std::string::npos) return "the reason names no row: " + status.reason();
  return {};
}

const std::vector<TestProperty>& test_properties() {
  static const std::vector<TestProperty> properties{
      {"JacobianMatchesDifferences", jacobian_matches_differences},
      {"AbscissaDerivativeMatchesDifferences", abscissa_derivative_matches_differences},
      {"ValuesDoNotDependOnTheOtherOutputs", values_do_not_depend_on_the_other_outputs},
      {"GivenAbscissaeReplaceTheBoundOnes", given_abscissae_replace_the_bound_ones},
      {"ConcurrentPredictionsAgree", concurrent_predictions_agree}};
  return properties;
}

}  // namespace tunica::testing
