// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "population/cohort.hpp"

namespace tunica::population {

/// A column of the design: ones for the mean of the reference, or 1 if a specimen has a level of a factor.
struct Column {
  std::optional<std::size_t> factor;  ///< none: the mean of the reference
  std::size_t level = 0;
  bool within = false;  ///< it varies within animals
};

/// X of the model ξ_i = B x_i + …, x_i row i: treatment coding, the same for each parameter. The coefficients B, p × q,
/// are stacked column by column of the design: β = (B_·1, B_·2, …).
struct Design {
  Eigen::MatrixXd rows;  ///< specimens × q
  std::vector<Column> columns;

  std::size_t size() const { return columns.size(); }
};

/// Of the factors named by number. Throws InputError where the columns do not differ, for example two factors that sort
/// the specimens alike.
Design design(const Cohort& cohort, const std::vector<std::size_t>& factors);

/// Degrees of freedom of every column by containment (J. C. Pinheiro, D. M. Bates, Mixed-Effects Models in S and S-PLUS
/// (2000), section 2.4.2). Not nested: specimens − q. Nested: animals − columns that are constant in every animal, and
/// specimens − animals − columns that vary. Never below 1.
std::vector<double> containment(const Design& design, std::size_t specimens, std::size_t animals);

}  // namespace tunica::population
