// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "term.hpp"

namespace tunica::composed {

/// The energy as people write it, with the names of the parameters:
///
///     "W = matrix_mu/2 (I1 - 3) + sum over +-fibres_theta of fibres_k1/(2 fibres_k2) (exp(fibres_k2 (I4 - 1)^2) - 1)"
std::string formula_of(const std::vector<Term>& terms);

}  // namespace tunica::composed
