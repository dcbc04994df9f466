// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/measured.hpp"
#include "discovery/discovery.hpp"

namespace tunica::trial {

/// Rubber in uniaxial and equibiaxial extension and pure shear, with a neo-Hookean base.
struct Rubber : Measured {
  Rubber();
  [[nodiscard]] discovery::Discovery discover(bool from_nothing = false, bool quick = true) const;
};

/// Hides a term in the model: options and parameters of `added_term`.
Measured::Hide hidden_term(const nlohmann::json& term);

}  // namespace tunica::trial
