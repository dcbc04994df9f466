// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "data/dataset.hpp"

namespace tunica::data {

/// One dataset of the rows of several tables, one table after the other: for example the points of a measured field and
/// the forces of its steps. What a table does not map is NaN in its rows. Throws InputError where only some have time.
Dataset stacked(const std::vector<Dataset>& tables);

}  // namespace tunica::data
