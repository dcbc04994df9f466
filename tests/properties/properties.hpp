// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

/// Generators. A property that fails says its smallest counter-example and the seed that finds it again.
namespace tunica::properties {

/// A number as experiments have it: of either sign, from 1e-6 to 1e6, or 0.
inline rc::Gen<double> number() {
  return rc::gen::map(rc::gen::pair(rc::gen::inRange(-999'999'999, 1'000'000'000), rc::gen::inRange(0, 13)),
                      [](const std::pair<int, int>& drawn) {
                        double value = drawn.first / 1e9;
                        for (int k = 6; k < drawn.second; ++k) value *= 10;
                        for (int k = drawn.second; k < 6; ++k) value /= 10;
                        return value;
                      });
}

/// Rows of `columns` numbers.
inline rc::Gen<std::vector<std::vector<double>>> table(std::size_t columns) {
  return rc::gen::nonEmpty(
      rc::gen::container<std::vector<std::vector<double>>>(rc::gen::container<std::vector<double>>(columns, number())));
}

}  // namespace tunica::properties
