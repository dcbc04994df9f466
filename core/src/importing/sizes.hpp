// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/csv.hpp"
#include "experiment/json_document.hpp"

/// Sizes of specimens: from a table with one row a specimen, and from the lengths in the file itself; its path.
namespace tunica::importing {

/// Sizes as quantities with a unit, "26.902 mm"; empty = not known.
struct KnownSizes {
  std::string width, thickness, gauge_length, area;
  std::string direction;             ///< "circumferential", "axial" or empty
  std::vector<std::string> sources;  ///< sentences: where each was found
};

/// "axial" or "circumferential" of a name that says it, such as "Longitudinal_2"; else empty.
std::string direction_named(std::string_view name);

/// The row of the table that has `specimen` in one of its cells; sizes without a unit are in mm. Throws InputError
/// where the table has no such row, or a size in it is no number.
KnownSizes sizes_in_table(const std::filesystem::path& table, const std::string& specimen);

/// Length less displacement, where most rows agree on it to the last digit that they have: the length at displacement
/// 0.
std::optional<double> length_at_rest(const data::Csv& csv, const std::string& length, const std::string& displacement,
                                     const std::vector<const data::Csv::Row*>& rows);

/// Whether a column returns towards `rest` at least once by more than half its way; none where it keeps its value.
std::optional<bool> goes_to_and_fro(const data::Csv& csv, const std::string& column,
                                    const std::vector<const data::Csv::Row*>& rows, double rest);

/// The cycles of a column, whole or begun, from its turning points.
std::size_t cycles(const data::Csv& csv, const std::string& column, const std::vector<const data::Csv::Row*>& rows,
                   double rest);

/// The numbers of a column, without cells that hold none.
std::vector<double> numbers_of(const data::Csv& csv, const std::string& column,
                               const std::vector<const data::Csv::Row*>& rows);

/// The area of a circle as a quantity: "153.938 mm2" of "14 mm".
std::string circle(const std::string& diameter);

}  // namespace tunica::importing
