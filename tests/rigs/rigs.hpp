// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/loaded.hpp"

namespace tunica::testing {

using RigColumns = std::vector<std::pair<std::string, std::vector<double>>>;

/// A test with the options given and every other one at its default.
inline std::unique_ptr<Test> make_rig(const std::string& type,
                                      const std::vector<std::pair<std::string, Option::Value>>& options,
                                      const RigColumns& columns, const std::vector<std::string>& channels) {
  const auto& entry = catalogue().tests().at(type);
  TestSetup setup;
  setup.options = defaults(entry.factory.options);
  for (const auto& [name, value] : options) setup.options.set(name, value);
  setup.stress_measure = "cauchy";
  setup.rows.count = columns.empty() ? 0 : columns.front().second.size();
  for (const auto& [name, values] : columns) setup.rows.abscissae.push_back({name, values});
  setup.rows.channels = channels;
  return plugins::create(entry, setup);
}

/// The test's own parameters at their nulls.
inline std::vector<double> at_null(const Test& test) { return test.describe().nulls; }

/// Predictions where they must succeed.
inline std::vector<double> predicted(const Test& test, const Model& model, const std::vector<double>& p,
                                     std::vector<double> own = {}) {
  if (own.empty()) own = at_null(test);
  std::vector<double> values(test.rows().count * test.rows().channels.size());
  const Status status = test.predict({model, p, own}, {values, {}, {}, {}});
  if (!status.ok()) throw std::runtime_error(status.reason());
  return values;
}

/// Why a prediction fails.
inline std::string failure(const Test& test, const Model& model, const std::vector<double>& p) {
  const std::vector<double> own = at_null(test);
  std::vector<double> values(test.rows().count * test.rows().channels.size());
  return test.predict({model, p, own}, {values, {}, {}, {}}).reason();
}

/// Holds all derivatives of a test to central differences: of the model's parameters, its own, and the abscissae.
inline void expect_exact_derivatives(const Test& test, const Model& model, const std::vector<double>& p,
                                     const std::vector<double>& own, double tolerance = 1e-6) {
  const std::size_t n = test.rows().count, size = n * test.rows().channels.size(),
                    columns = test.rows().abscissae.size();
  std::vector<double> values(size), jacobian((p.size() + own.size()) * size), by_abscissa(columns * size);
  ASSERT_TRUE(test.predict({model, p, own}, {values, jacobian, by_abscissa, {}}).ok());
  const auto difference = [&](const std::function<std::vector<double>(double)>& at, double h) {
    const auto up = at(h), down = at(-h), far_up = at(2 * h), far_down = at(-2 * h);
    std::vector<double> slope(size);
    for (std::size_t i = 0; i < size; ++i) slope[i] = (8 * (up[i] - down[i]) - (far_up[i] - far_down[i])) / (12 * h);
    return slope;
  };
  const auto hold = [&](std::span<const double> given, const std::vector<double>& expected, const std::string& name) {
    for (std::size_t k = 0; k < size; k += n) {
      double scale = 0;
      for (std::size_t i = k; i < k + n; ++i) scale = std::max({scale, std::abs(expected[i]), std::abs(given[i])});
      for (std::size_t i = k; i < k + n; ++i)
        EXPECT_NEAR(given[i], expected[i], tolerance * scale + 1e-8)
            << name << ", " << test.rows().channels[k / n] << ", row " << i - k + 1;
    }
  };
  for (std::size_t j = 0; j < p.size() + own.size(); ++j) {
    const bool of_model = j < p.size();
    const double at = of_model ? p[j] : own[j - p.size()];
    const auto expected = difference(
        [&](double h) {
          auto moved_p = p, moved_own = own;
          (of_model ? moved_p[j] : moved_own[j - p.size()]) += h;
          return predicted(test, model, moved_p, moved_own);
        },
        1e-4 * std::max(std::abs(at), 0.1));
    hold(std::span<const double>(jacobian).subspan(j * size, size), expected,
         of_model ? model.describe().parameters[j].name : test.describe().parameters[j - p.size()].name);
  }
  for (std::size_t a = 0; a < columns; ++a) {
    const auto bound = test.rows().abscissae[a].values;
    const auto expected = difference(
        [&](double h) {
          std::vector<std::span<const double>> given;
          for (const auto& column : test.rows().abscissae) given.push_back(column.values);
          std::vector<double> moved(bound.begin(), bound.end()), out(size);
          for (double& one : moved) one += h;
          given[a] = moved;
          const Status status = test.predict({model, p, own, given}, {out, {}, {}, {}});
          if (!status.ok()) throw std::runtime_error(status.reason());
          return out;
        },
        1e-4);
    hold(std::span<const double>(by_abscissa).subspan(a * size, size), expected, test.rows().abscissae[a].observable);
  }
}

}  // namespace tunica::testing
