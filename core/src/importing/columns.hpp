// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data/csv.hpp"
#include "tunica/plugin.hpp"
#include "tunica/test.hpp"

/// Guesses of the columns in a machine's file, from their names, units and values.
namespace tunica::importing {

/// The kind of a column that holds the force on the closed end of a tube, pressure on the lumen included.
inline constexpr const char* total_force = "total force";
/// The kind of a column that holds how far a tip is pressed into a surface.
inline constexpr const char* indentation = "an indentation";
/// The kind of a column of a rotational rheometer, whose stresses and strains are of shear.
inline constexpr const char* shearing = "of a rheometer";
/// The kind of a column of a beam that is bent.
inline constexpr const char* bending = "bending";

struct ColumnGuess {
  std::string name;                 ///< as "columns" takes it: the name, or "#3"
  std::string title;                ///< as the file has it, in UTF-8
  std::string quantity;             ///< "force", "displacement", "pressure", …; empty = nothing that is known
  std::string kind;                 ///< in words, also of what no test takes: "change of diameter"; empty = not known
  std::string direction;            ///< "circumferential", "axial" or empty
  std::string measure;              ///< of a strain or a stress, where the name says it: "true", "green", "cauchy", …
  std::string unit;                 ///< as the file has it; empty = none
  bool unit_from_name = false;      ///< "Force_N": the file does not say it in a way that the data block reads
  bool per_metre = false;           ///< a force on one metre of an edge; `unit` is that of the force
  bool indexed = false;             ///< "E11", "exx": a component of a tensor, and no word says of which
  bool compression = false;         ///< the name speaks of compression
  bool set_point = false;           ///< what the machine was told, not what it measured
  bool numeric = false;             ///< nearly every cell is a number
  int rank = 0;                     ///< among columns of one quantity the least is taken
  double largest = 0;               ///< of the numbers, without sign
  std::vector<double> begins;       ///< the first two numbers
  std::size_t filled = 0;           ///< cells that are not empty
  std::size_t different = 0;        ///< values, counted to 50
  std::vector<std::string> values;  ///< of a column that is not numeric: the different ones, at most 50
};

/// One guess a column of the table.
std::vector<ColumnGuess> guess_columns(const data::Csv& csv);

/// The channel or required abscissa that a title names: "Storage modulus", or "E'"; empty = none.
std::string observable_titled(const std::string& title, const std::vector<Observable>& observables);

/// A column whose name says cycle, and whose cells hold numbers: "2", or "2-Stretch".
bool counts_cycles(const ColumnGuess& column);

/// Whether a column of text parts the rows: each of its values stands in three rows or more.
bool parts_rows(const ColumnGuess& column, std::size_t rows);

/// What was tested, by its quantities: a tube, a sheet, else a strip.
Specimen likely_specimen(const std::vector<ColumnGuess>& columns);

/// Whether a unit measures what the base unit does; grams count as a force.
bool measures(std::string_view unit, std::string_view base);

}  // namespace tunica::importing
