// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "tunica/error.hpp"

namespace tunica::experiment {

/// Wrong input at a place of the experiment file; the message says the place too.
class PlacedError : public InputError {
 public:
  PlacedError(const std::string& message, std::size_t at_line, std::size_t at_column)
      : InputError(message), line(at_line), column(at_column) {}
  std::size_t line, column;  ///< from 1; columns are characters
};

}  // namespace tunica::experiment
