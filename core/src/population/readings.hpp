// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/cohort.hpp"

namespace tunica::population {

/// Numbers that were read off every specimen, for example a stress at a stretch: value and standard error, or nothing.
struct Reading {
  std::string name;
  bool logarithmic = false;  ///< compare ratios: all values have to be above 0
  struct Value {
    double value = 0, standard_error = 0;
  };
  std::vector<std::optional<Value>> values;  ///< by specimen
};

/// The same specimens, animals and factors with the readings as parameters, so that estimate() and test_factor()
/// treat them alike, multiplicity included: ξ_ij is known with its own, stated variance. A standard error of zero
/// counts as 1e-6 of the spread of the values. Throws InputError where a reading has fewer than two values, or a
/// logarithm none.
Cohort cohort_of_readings(const Cohort& cohort, const std::vector<Reading>& readings);

}  // namespace tunica::population
