// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tunica::assembly {

struct FreeParameter;
struct RunTest;

/// The last point of a search at which the Jacobian of one test is known, see Differencing::updates.
struct SecantPoint {
  std::vector<double> at;        ///< free parameters; empty = nothing known yet
  std::vector<double> values;    ///< predictions there
  std::vector<double> jacobian;  ///< row r of RunTest::columns at [r·size + i]
  std::size_t updates = 0;       ///< since the last differences
  double least = 0;              ///< smallest cost of the test that the search has seen
};

/// What one search remembers of tests without derivatives, by test. It belongs to a search, not to a thread, so that
/// results are the same for any number of threads.
struct SecantMemory {
  std::vector<SecantPoint> tests;
};

/// The length that a change of the parameter is measured by: |p|, on a linear scale at least a hundredth of its range.
double parameter_scale(double value, const FreeParameter& parameter);

/// Moves `point` to the values predicted at `at` by Broyden's update. False where the Jacobian has to be taken anew: it
/// predicted the change of the values badly, or has been updated often. Where the cost has risen it is not worth that:
/// a search turns back from there, and the point stays.
bool update_secant(SecantPoint& point, const RunTest& test, std::span<const FreeParameter> parameters,
                   std::span<const double> at, std::span<const double> values, double cost);

}  // namespace tunica::assembly
