// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "tunica/test.hpp"

namespace tunica::channel_errors {

/// measured = gain · true + shift · (the row's share), and its derivatives by the amplitude.
struct Reading {
  double gain = 1, shift = 0;
  double gain_slope = 0, shift_slope = 0;
};
using Error = Reading (*)(double amplitude);

/// Which predictions are misread: channels by number; of the shift each row has a share, empty = the whole.
struct Where {
  std::vector<std::size_t> channels;
  std::vector<double> share;
};

/// The base test with another reading of some channels; the amplitude stands behind the base's own parameters, and has
/// the null 0.
std::unique_ptr<Test> misread(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where);

}  // namespace tunica::channel_errors
