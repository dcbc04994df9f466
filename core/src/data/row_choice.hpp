// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "data/csv.hpp"
#include "data/dataset.hpp"

/// Which rows of a table are read.
namespace tunica::data {

/// The rows that match every condition of "where"; a column named several times may have any of its values.
/// Throws InputError where none is left.
std::vector<const Csv::Row*> rows_where(const Csv& csv, const DataRequest& request);

/// Positions among `count` rows, warning where the range goes beyond them. Throws InputError where none is left.
std::vector<std::size_t> rows_in_range(const Csv& csv, const RowRange& range, std::size_t count,
                                       std::vector<std::string>& warnings);

/// A column of the rows left after "where", in its base unit.
struct RawColumn {
  std::string place;           ///< "strip.csv, line 7, column 2 ('force')", of the header
  std::vector<double> values;  ///< one a row
};

/// What cycles are told apart by.
struct RawPath {
  RawColumn path;                      ///< what is prescribed
  double rest = 0;                     ///< its value at rest
  const RawColumn* load = nullptr;     ///< what the preload is compared with; null: no preload
  std::vector<std::size_t> of_column;  ///< number of the cycle of each row, from "cycles_from"; empty = turning points
};

/// A point of the path at or before a row.
struct PathPoint {
  std::size_t row = 0;
  double back = 0;  ///< by which part of the way to the row before

  [[nodiscard]] double of(const std::vector<double>& values) const {
    return back == 0 ? values[row] : values[row] + back * (values[row - 1] - values[row]);
  }
};

struct ChosenRows {
  std::vector<std::size_t> rows;             ///< positions, rising
  std::optional<PathPoint> at_preload = {};  ///< where the first loading that is chosen comes to the preload
};

/// The rows of the cycles and branches that the request names, from the preload on. A row without a load does not bear
/// it. Throws InputError where no row is left.
ChosenRows choose_rows(const RawPath& path, const DataRequest& request);

/// The number that stands first in a cell: 3 of "3-Stretch", "cycle 3" and "3".
std::optional<std::size_t> first_number(std::string_view cell);

}  // namespace tunica::data
