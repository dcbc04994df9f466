// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tunica::assembly {

/// A parameter with a separate value in a state of the specimen.
struct Differing {
  std::string state, name;  ///< as results name it in the state of the models: "mu"
  std::string own;          ///< as results name it in this state: "relaxed.mu"
};

}  // namespace tunica::assembly
