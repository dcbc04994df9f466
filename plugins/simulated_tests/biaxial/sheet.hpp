// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tunica/test.hpp"

namespace tunica::biaxial {

/// `general`: both stretches are measured. `equibiaxial`: one stretch for both directions. `pure_shear`: one direction
/// is pulled, the other held at 1.
enum class Protocol { general, equibiaxial, pure_shear };

/// Value or derivative in the two in-plane directions: 0 = circumferential, 1 = axial.
using InPlane = std::array<double, 2>;

/// The sheet as it was bound.
struct Sheet {
  Protocol protocol = Protocol::general;
  std::size_t pulled = 0;                    ///< of pure shear
  double angle = 0;                          ///< from the material's axes to the sheet's, z towards t, radians
  int power = 0;                             ///< stress in the data's measure = Cauchy stress / λ^power
  std::vector<InPlane> channels;             ///< weight of the stress in each direction
  std::vector<std::vector<double>> columns;  ///< the mapped abscissae, in the order of the mapping
  std::vector<std::string> names;            ///< of the columns
  std::vector<double> time;                  ///< empty = equilibrium

  [[nodiscard]] std::size_t count() const { return columns.front().size(); }
  /// ∂(λt, λz)/∂(column k): every protocol is linear, (λt, λz) = Σ_k direction(k) column_k + held().
  [[nodiscard]] InPlane direction(std::size_t column) const;
  [[nodiscard]] InPlane held() const;
  /// "row 3 (stretch_circumferential 1.2, stretch_axial 1.1)"
  [[nodiscard]] std::string row_name(std::span<const std::span<const double>> columns, std::size_t row) const;
};

/// Binds options and rows. Throws InputError where a stretch that the protocol needs is not mapped or one that it has
/// no use for is, and for rows that cannot be simulated.
Sheet bind(const TestSetup& setup);

}  // namespace tunica::biaxial
