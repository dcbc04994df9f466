// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cohort/specimens.hpp"

namespace tunica::cohort {

/// The experiment of a cohort, with the values that differ between specimens. The text around them stays as it is, so
/// that messages about a specimen's experiment name the lines of the template.
class Template {
 public:
  /// Throws InputError where a pointer leads nowhere in the experiment, or a pattern names no column.
  Template(const Specification& cohort, const SpecimenTable& table);

  /// The text of the experiment of a specimen. Throws InputError where a cell that is needed is empty.
  [[nodiscard]] std::string of(const Specimen& specimen) const;

 private:
  struct Piece {
    std::string literal;                ///< what stands before the cell
    std::optional<std::size_t> column;  ///< none: the end of the pattern
  };
  struct Hole {
    std::size_t begin, end;  ///< bytes of the value
    bool number;             ///< the template has a number there
    std::vector<Piece> pieces;
    std::string place;
  };
  std::string text_;
  std::vector<Hole> holes_;  ///< in the order of the text
  std::filesystem::path table_;
  std::vector<data::Csv::Column> columns_;
};

}  // namespace tunica::cohort
