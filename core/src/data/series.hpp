// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"

namespace tunica::data {

/// Values in fixed steps: the resolution of a device, or the rounding of an export.
struct Grid {
  double step = 0, range = 0;  ///< step 0 = there is none
  std::size_t values = 0;      ///< how many different ones there are
  std::string unit = {};
};

/// The mapped columns of one data file in base units, the selected rows in loading order.
struct Series {
  struct Column {
    const Observable* observable;
    std::size_t index;           ///< of the column in the file, from 0
    std::string name, unit;      ///< as the header has them; unit "" where it has none
    std::vector<double> values;  ///< one per row
    bool derived = false;        ///< from another quantity in the column, with the sizes of the specimen
    bool elongation = false;     ///< a stretch from a displacement or a strain
    bool turned = false;         ///< counts compression positive; values have the opposite sign
    double gauge_length = 0;     ///< mm, of a stretch from a length or a displacement; 0 = none
    Grid grid = {};              ///< of a channel, as the file has it
  };
  std::filesystem::path file;
  std::string sha256;
  std::size_t header_line = 0;
  std::vector<Column> columns;                              ///< in the order of the request
  std::vector<std::size_t> lines;                           ///< one per row
  std::vector<double> time;                                 ///< from `time_from`; empty = none
  std::vector<std::size_t> used_lines = {};                 ///< of the rows that were read
  std::size_t file_rows = 0;                                ///< of the table, whatever was chosen
  std::vector<std::pair<std::string, Noise>> scatter = {};  ///< by channel, where it was resampled

  /// "circ.csv, line 7, column 2 ('stress')".
  [[nodiscard]] std::string place(std::size_t row, const Column& column) const;
  [[nodiscard]] std::string header_place(const Column& column) const;
};

Series read_series(const std::filesystem::path& file, const DataRequest& request,
                   const std::vector<Observable>& observables, std::vector<std::string>& warnings);

/// Refuses what cannot be a measurement of the observable (a stretch of zero or less, strain for stretch, percent for
/// a fraction, time that runs backwards) and warns of what probably is none. Throws InputError.
void check_series(const Series& series, std::vector<std::string>& warnings);

/// What every column was taken for, with the measure of a stress and the definition of a strain, in lines such as
/// "stretch = 1 + displacement / 17.48 mm, from 'Way' in mm"; and which rows were taken, where some were not.
std::vector<std::string> understood(const Series& series, const DataRequest& request,
                                    const std::vector<Observable>& observables);

/// Puts `points` rows in place of each branch of the path, evenly along it, by local regression. What the measured rows
/// scatter about the curve becomes the noise of the new ones. Throws InputError where a branch has fewer rows.
void resample(Series& series, std::size_t points);

/// Brings replicates to one set of abscissae, those of the first file: series with the same ones are taken as they
/// are, others interpolated linearly with a warning; rows that some replicate does not reach are left out. After it
/// all series have the same rows. Throws InputError.
void align(std::vector<Series>& replicates, std::vector<std::string>& warnings);

}  // namespace tunica::data
