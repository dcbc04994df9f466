// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "term.hpp"
#include "tunica/model.hpp"

namespace tunica::composed {

/// The sum of the terms as a model. Parameters are those of the terms in their order, each behind the name of its term.
/// Throws InputError where there are too many.
std::unique_ptr<Model> energy_of(const std::vector<Term>& terms);

}  // namespace tunica::composed
