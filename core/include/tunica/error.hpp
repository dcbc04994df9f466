// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace tunica {

/// Wrong input, from a person: the message says what was found, where (file, line, JSON pointer), what was
/// expected and what to do. Plugins throw it from their factories; the host adds the place. Exit code 2.
class __attribute__((visibility("default"))) InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tunica
