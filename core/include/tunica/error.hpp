// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace tunica {

/// Wrong input from a person: an option, a combination of options, the rows of a data file.
///
/// Factories throw it; evaluations never do, see Status. The message says what was found, where (file, line, JSON
/// pointer, row), what was expected and what to do. The host puts the place in the experiment file and the name of the
/// plugin before it, and ends with exit code 2.
///
///     throw InputError("bulge: found the height 0 mm in row 1, expected one above 0; leave the flat membrane out");
class __attribute__((visibility("default"))) InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tunica
