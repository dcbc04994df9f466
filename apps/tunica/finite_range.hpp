// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace tunica::app {

/// A real number of the command line within bounds, both allowed. CLI::Range compares only, and takes "nan".
class FiniteRange : public CLI::Range {
 public:
  FiniteRange(double least, double largest) : CLI::Range(least, largest) {
    func_ = [least, largest](std::string& text) {
      double value = 0;
      const bool number = CLI::detail::lexical_cast(text, value);
      if (number && std::isfinite(value) && value >= least && value <= largest) return std::string();
      return fmt::format("Value {} not in range {:g} to {:g}", text, least, largest);
    };
  }
};

}  // namespace tunica::app
