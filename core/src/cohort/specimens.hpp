// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cohort/specification.hpp"
#include "data/csv.hpp"

namespace tunica::cohort {

/// One row of the table of specimens.
struct Specimen {
  std::string id;
  std::string folder;              ///< name of its folder: the id, as a file name may be
  std::size_t line = 0;            ///< in the table
  std::vector<std::string> cells;  ///< by column of the table
  std::string animal;              ///< of the column `nested_in`; the id without one
  std::string problem;             ///< why it cannot be taken; empty = it can
};

/// A factor and what became of it.
struct Factor {
  std::string column;
  std::vector<std::string> levels;  ///< the reference first
  std::vector<std::size_t> of;      ///< level of each specimen; meaningless for one that has a problem
  std::string refusal;              ///< why no groups are compared by it; empty = they are
};

/// The table, checked. One bad row harms no other: it carries its problem.
struct SpecimenTable {
  std::filesystem::path file;
  std::vector<data::Csv::Column> columns;
  std::size_t id = 0;               ///< the column of the id
  std::vector<Specimen> specimens;  ///< in the order of the table
  std::vector<Factor> factors;

  /// Position of a column. Throws InputError that names `place` and the nearest name.
  [[nodiscard]] std::size_t column(const std::string& name, const std::string& place) const;
};

/// Throws InputError where the table cannot be read, or a named column is not in it.
SpecimenTable read_specimens(const Specification& cohort);

}  // namespace tunica::cohort
