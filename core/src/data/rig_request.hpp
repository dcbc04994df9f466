// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/codes.hpp"

/// The keys of an experiment file, besides "file" and "columns", for data as a testing machine wrote them.
namespace tunica::data {

/// How the table stands in its file; whatever is absent is found in the file.
struct TableLayout {
  std::optional<std::size_t> skip_lines;                   ///< lines before the header of the table
  std::optional<char> delimiter, decimal;                  ///< ' ' = white space
  std::vector<std::pair<std::string, std::string>> units;  ///< column → unit, before what the header says
  bool by_position = false;                                ///< no column is named, so that no header is needed
  /// Column that names every row, "" = the first: names may look like units ("m1"), so the first line is the header,
  /// and a row of units leaves this column empty.
  std::optional<std::string> row_names;
};

/// Sizes of the unloaded specimen along one direction, mm. The force along it acts on the section width × thickness.
struct Sizes {
  std::optional<double> width, gauge_length;
  std::optional<double> grip_distance;  ///< length at displacement 0, where the gauge length is that at the preload
};

/// The unloaded specimen; a direction without sizes of its own has those of `all`.
struct Specimen {
  std::optional<double> thickness;  ///< mm
  std::optional<double> area;       ///< mm², in place of width × thickness
  std::optional<double> height;     ///< mm, of a sheared block: the distance of the plates
  bool gauge_at_preload = false;    ///< the gauge length is the length at the preload
  Sizes all;
  std::vector<std::pair<std::string, Sizes>> directions;  ///< "circumferential", "axial"
};

/// The cycles to use: all, the last one, or those of a list, counted from 1.
struct CycleChoice {
  bool last = false;
  std::vector<std::size_t> numbers;  ///< empty, and not the last: all
};

enum class BranchChoice { both, loading, unloading };
inline constexpr text::Codes<BranchChoice, 2> branch_names{
    {{BranchChoice::loading, "loading"}, {BranchChoice::unloading, "unloading"}}};

/// A load that marks the beginning of the test: a force in mN, or a stress in kPa.
struct Preload {
  double value = 0;
  bool is_force = true;
};

/// Columns that count compression positive: their values are read with the opposite sign.
struct CompressionPositive {
  bool all = false;                  ///< every mapped column that has a sign in tension and compression
  std::vector<std::string> columns;  ///< these; as in "columns"
  bool said = false;                 ///< the sign is stated, so no question is needed
};

/// 3 of "#3", the name of the third column where names are missing or do not matter.
std::optional<std::size_t> column_position(std::string_view name);

}  // namespace tunica::data
