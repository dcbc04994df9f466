// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tunica/options.hpp"

/// \file
/// Experiments that a lab could make next, as TestFactory::plan has them. A plan is a function of what is known: it
/// keeps nothing, and several threads may ask at once. What it throws ends the diagnosis with the name of its plugin.
/// So does a plan with columns of unequal length, or with names that the test does not have.

namespace tunica {

/// What is known when the next experiment is chosen. A plan that needs more than this is left out by its plugin.
struct PlanningScope {
  /// A test of the type in question that was made, on one model throughout. Tests with layers are not told.
  struct Made {
    /// Its name in the experiment file, for descriptions.
    std::string name;
    /// All of its options, with defaults filled in.
    Options options;
    /// The largest value of its first abscissa, in the base unit.
    double largest_loaded;
  };
  /// The largest stretch of the specimens so far, held between 1.15 and 8.
  double reach = 1;
  /// Duration of the shortest test that has a clock, s; 0 where none has one.
  double shortest_time = 0;
  /// Duration of the longest of them, s; 0 where there is none.
  double longest_time = 0;
  /// In the order of the file; empty where no test of the type was made.
  std::vector<Made> made;
};

/// An experiment that a lab could make next, as the rows that it would have. The host weighs what its rows would tell
/// against those of other plans, with the noise that the data have. It leaves out a plan whose test cannot be made or
/// predicted.
struct PlannedTest {
  /// For users, behind "measure": "a sheet stretched equally in both directions".
  std::string description;
  /// Options that differ from their defaults, as TestFactory::options declares them; of two of one name the last holds.
  std::vector<std::pair<std::string, Option::Value>> options;
  /// Observable → n values, in base units; at least one observable, all of one length n ≥ 1.
  std::vector<std::pair<std::string, std::vector<double>>> abscissae;
  /// n values, s, in loading order; empty where the rows have no clock.
  std::vector<double> time;
  /// Observables that would be measured.
  std::vector<std::string> channels;
  /// Parameters of the test that differ from their null, in base units. They may lie outside their bounds. The test
  /// must have each of them with these options.
  std::vector<std::pair<std::string, double>> parameters = {};
};

/// `count` values in even steps, in any unit. The first is one step from `from`, the last is `to`.
/// For example, even_steps(1, 1.4, 2) is {1.2, 1.4}.
inline std::vector<double> even_steps(double from, double to, std::size_t count = 20) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(from + (to - from) * static_cast<double>(i + 1) / static_cast<double>(count));
  return values;
}

}  // namespace tunica
