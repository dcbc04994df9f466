// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "data/written_file.hpp"
#include "support/loaded.hpp"

namespace tunica::testing {

/// The model of a list of terms.
inline std::unique_ptr<Model> composed(const std::string& terms) {
  Options options;
  options.set("terms", terms);
  return make_model("composed", options);
}

/// The message that refuses a list of terms; empty if the list is accepted.
inline std::string refusal(const std::string& terms) {
  return message_of<InputError>([&] { (void)composed(terms); });
}

}  // namespace tunica::testing
