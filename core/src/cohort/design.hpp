// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "cohort/collection.hpp"
#include "population/permutation.hpp"

namespace tunica::cohort {

/// One column of the design: the mean of the reference levels, or what a level of a factor adds to it.
struct DesignColumn {
  std::string factor, level;  ///< empty for the first
};

/// A factor that groups are compared by.
struct DesignFactor {
  std::string name, reference;
  std::vector<std::string> levels;    ///< the reference first
  population::FactorColumns columns;  ///< labels by specimen of the design
};

/// The specimens that take part in the population, those of one animal beside each other, and their design.
struct Design {
  std::vector<std::size_t> specimens;  ///< positions in the table
  std::vector<std::size_t> animals;    ///< number of the animal, by specimen of the design
  std::size_t animal_count = 0;
  std::vector<DesignColumn> columns;
  Eigen::MatrixXd rows;  ///< specimens × columns
  std::vector<DesignFactor> factors;
  std::vector<std::string> refusals;  ///< why a factor is left out

  [[nodiscard]] bool nested() const { return animal_count < specimens.size() && animal_count > 1; }
  /// Degrees of freedom of a column, by containment as in R's nlme (J. C. Pinheiro, D. M. Bates, Mixed-Effects Models
  /// in S and S-PLUS, 2000, section 2.4.2): a column that is constant within every animal is known from animals, the
  /// others from specimens within them.
  [[nodiscard]] double freedom(Eigen::Index column) const;
  /// The same specimens without the columns of a factor.
  [[nodiscard]] Design without(std::size_t factor) const;
  /// Different rows of the design, with a name: "control", "treated, belly"; "all" without factors.
  struct Group {
    std::string name;
    Eigen::VectorXd row;
    std::vector<std::size_t> specimens;  ///< of the design
  };
  [[nodiscard]] std::vector<Group> groups() const;

 private:
  [[nodiscard]] bool constant_in_animals(Eigen::Index column) const;
};

/// Of the specimens that are fitted. A factor that has one level left, or that goes together with those before it, is
/// left out and said.
Design design_of(const SpecimenTable& table, const Collection& found);

}  // namespace tunica::cohort
