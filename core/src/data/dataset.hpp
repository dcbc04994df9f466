// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/finding.hpp"
#include "data/rig_request.hpp"
#include "text/codes.hpp"
#include "tunica/test.hpp"

namespace tunica::data {

/// σ² = absolute² + (relative·y)²; correlation between neighbouring rows.
struct Noise {
  double absolute = 0, relative = 0, correlation = 0;
  /// y of every row, where something is known of it that is better than the measured value; empty = that.
  std::vector<double> level = {};
  /// Rows whose values are gross errors: their σ is multiplied by a thousand, which removes their influence.
  std::vector<std::size_t> gross = {};
};

/// first:last:step over the rows left after `where`, last exclusive, negative numbers from the end, as in Python.
struct RowRange {
  std::ptrdiff_t first = 0;
  std::optional<std::ptrdiff_t> last;
  std::size_t step = 1;

  /// First and last (exclusive) of `count` rows; first may lie beyond them.
  [[nodiscard]] std::pair<std::size_t, std::size_t> among(std::size_t count) const;
};

/// The meaning of the order of the rows.
enum class Order {
  unknown,  ///< not stated
  loading   ///< rows stand as they were measured
};
inline constexpr text::Codes<Order, 2> order_names{{{Order::unknown, "unknown"}, {Order::loading, "loading"}}};

struct Dataset;

/// The "data" block of one test in the experiment file.
struct DataRequest {
  std::vector<std::filesystem::path> files;  ///< several: replicates
  /// Observable, or what it follows from (quantities.hpp) → column, in file order.
  std::vector<std::pair<std::string, std::string>> columns;
  std::string stress_measure = "cauchy";
  RowRange rows;
  /// Column → value; rows have to match every column, and one of the values that a column is given.
  std::vector<std::pair<std::string, std::string>> where;
  std::optional<double> time_rate;                   ///< abscissa per second, from `time_from`
  std::vector<std::pair<std::string, Noise>> noise;  ///< by channel; absent = estimated
  Order order = Order::unknown;                      ///< time says it too
  TableLayout layout;
  Specimen specimen;
  std::optional<CycleChoice> cycle;  ///< absent: not stated
  std::string cycles_from;           ///< column that counts cycles; empty: from the turning points
  BranchChoice branch = BranchChoice::both;
  std::optional<Preload> preload;
  CompressionPositive compression;
  std::optional<std::size_t> resample;  ///< points of each branch
  bool sorted = false;                  ///< rows by their values, whatever their order in the file; for a diagnosis
  /// Rows in memory, which are taken in place of those of the files; empty = those of the files. Their noise and their
  /// order are still those of the request.
  std::shared_ptr<const Dataset> given = {};
  /// Of data in several tables ("data": [ … ]): each of them. Their rows follow one another, and what a table does not
  /// map was not measured there. `files`, `columns` and `noise` are then those of all tables; a channel or a noise that
  /// is taken out or changed here counts.
  std::vector<DataRequest> tables = {};
  bool part = false;  ///< this is one of several tables
  /// Observable → its value in all rows, in base units: a prescribed quantity that the file does not repeat.
  std::vector<std::pair<std::string, double>> constants = {};
};

/// One fitted channel: the measured values and what is known of their noise.
struct Channel {
  std::string observable;
  std::string unit;                             ///< base unit
  std::vector<double> values;                   ///< mean over replicates where there are several; NaN = not measured
  std::vector<std::vector<double>> replicates;  ///< each as long as values; empty = none
  std::optional<Noise> noise;
};

/// The data of one test in base units, rows as in the file unless they were asked for sorted.
struct Dataset {
  std::size_t count = 0;
  std::vector<std::pair<std::string, std::vector<double>>> abscissae;  ///< observable → values
  std::vector<std::string> elongations;                                ///< abscissae from a displacement or a strain
  std::vector<double> time;                                            ///< empty = none
  std::vector<Channel> channels;
  bool ordered = false;            ///< the order of the rows is that of measurement: said so, or by time
  std::vector<std::size_t> lines;  ///< line of each row in the (first) file
  /// Row of the file, counted behind `where` and `rows`, that each row is; empty = in the order of the file.
  std::vector<std::size_t> file_rows;
  std::vector<std::string> warnings;
  std::vector<Finding> findings = {};        ///< what does not go together with physics
  std::vector<std::string> sha256;           ///< of each file, for the provenance
  std::vector<std::string> understood = {};  ///< lines on what every column was taken for, and which rows were taken
  /// Column names and units of the source, by observable, so that `simulate` writes what it read.
  std::vector<std::pair<std::string, std::pair<std::string, std::string>>> source_columns;

  /// Views for a TestSetup; valid while this object lives and is not changed.
  [[nodiscard]] TestRows rows() const;
};

/// The names that DataRequest::stress_measure may have.
const std::vector<std::string>& stress_measures();

/// Channels that a request without any is there to predict: the stresses whose stretches it has, else all.
std::vector<const Observable*> predicted_channels(const DataRequest& request,
                                                  const std::vector<Observable>& observables);

/// Reads and checks the data of one test; `observables` are those the test declares. Throws InputError whose message
/// names file, line and column.
Dataset read_dataset(const DataRequest& request, const std::vector<Observable>& observables);

}  // namespace tunica::data
