// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

namespace tunica::numerics {

/// A⁻¹ b of a symmetric, positive semi-definite A by LDLᵀ.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// H⁻¹ L with M = L Lᵀ: the half of the sandwich H⁻¹ M H⁻¹. None where H or M is not positive definite.
std::optional<Eigen::MatrixXd> half_sandwich(const Eigen::MatrixXd& H, const Eigen::MatrixXd& M);

}  // namespace tunica::numerics
