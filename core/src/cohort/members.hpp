// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cohort/collection.hpp"
#include "population/cohort.hpp"

namespace tunica::cohort {

/// Specimens with the same levels of all factors.
struct Group {
  std::string name;                    ///< "control", "treated, belly"; "all" without factors
  std::vector<std::size_t> levels;     ///< of each factor
  std::vector<std::size_t> specimens;  ///< among the members
};

/// The specimens that take part in the population, and what sorts them.
struct Members {
  std::vector<std::size_t> specimens;  ///< positions in the table
  std::vector<population::Factor> factors;
  std::vector<population::Specimen> rows;  ///< by member
  std::vector<std::string> animals;        ///< empty: not nested
  std::vector<Group> groups;
  std::vector<std::string> refusals;  ///< why a factor is left out

  /// Numbers of all factors, for a design.
  [[nodiscard]] std::vector<std::size_t> all_factors() const;
  /// A cohort of these, without parameters.
  [[nodiscard]] population::Cohort cohort() const;
};

/// Of the specimens that are fitted. A factor that has one level left, or that goes together with those before it, is
/// left out and said.
Members members_of(const SpecimenTable& table, const Collection& found);

}  // namespace tunica::cohort
