// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "equilibrium.hpp"
#include "tunica/test.hpp"

namespace tunica::controlled_strip {

enum class Channel { stress, stretch, transverse_stretch, normal_stretch };

/// One step of the loading. The prescribed value is `fixed` + `of_start` × the value that the quantity had when the
/// segment began: a hold keeps it, and a ramp leaves it.
struct LoadStep {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  double time = 0;  ///< s
  Control control = Control::stretch;
  double fixed = 0, of_start = 0;
  bool begins = false;     ///< the segment begins after the step before
  std::size_t row = none;  ///< the row of the data that it is
};

/// The strip, its steps and the requested outputs.
struct Strip {
  std::size_t loaded = 0;
  Control measure = Control::cauchy;  ///< of the stress channel
  std::vector<Channel> channels;
  std::size_t rows = 0;
  bool timed = false;
  double time_factor = 1;  ///< of all times: 1/a_T
  bool has_set = false;    ///< the test's own parameter is that of the permanent set
  const char* type = "";   ///< begins messages
};

/// "row 3 (stress 12.5)" and the like, for messages.
std::string step_name(const LoadStep& step, double value);

/// Follows the steps and writes what the test was asked for. `abscissa_derivative` is that by the prescribed value of a
/// row, which has to be a step of its own.
Status follow(const Strip& strip, std::span<const LoadStep> steps, const TestInput& input, const TestOutput& output);

}  // namespace tunica::controlled_strip
