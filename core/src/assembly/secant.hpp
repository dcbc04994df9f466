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

/// One search's memory of tests without derivatives, by test. It belongs to a search, not to a thread, so results do
/// not depend on the number of threads.
struct SecantMemory {
  std::vector<SecantPoint> tests;
};

/// The length scale of a change of the parameter: |p|, but on a linear scale at least a hundredth of its range.
double parameter_scale(double value, const FreeParameter& parameter);

/// Moves `point` to the values predicted at `at` by Broyden's update. Returns false if the Jacobian must be computed
/// anew, because it predicted the change of the values badly or was updated often. If the cost has risen, it returns
/// true even then, and after a bad prediction the point stays. A search turns back from there, so a new Jacobian would
/// be wasted.
bool update_secant(SecantPoint& point, const RunTest& test, std::span<const FreeParameter> parameters,
                   std::span<const double> at, std::span<const double> values, double cost);

}  // namespace tunica::assembly
