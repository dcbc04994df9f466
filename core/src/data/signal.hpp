// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "data/dataset.hpp"

namespace tunica::data {

/// What a file has in the columns that a test maps, as it stands there, and which rows the test uses.
struct Signal {
  struct Column {
    std::string title;           ///< "Load [N]"
    std::vector<double> values;  ///< one a row; NaN where the cell is no number
  };
  std::filesystem::path file;
  Column clock;                 ///< the time column, else the lines of the file
  std::vector<Column> columns;  ///< the mapped columns but for time
  std::vector<bool> used;       ///< one a row
};

/// One signal a file of the request. Throws InputError as read_dataset does.
std::vector<Signal> read_signals(const DataRequest& request, const std::vector<Observable>& observables);

}  // namespace tunica::data
