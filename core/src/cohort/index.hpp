// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace tunica::cohort {

/// Eigen counts with signed numbers.
inline Eigen::Index index(std::size_t k) { return static_cast<Eigen::Index>(k); }

}  // namespace tunica::cohort
