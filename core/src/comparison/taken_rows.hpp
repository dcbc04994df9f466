// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "comparison/simulation.hpp"

/// The rows that a fit takes: what is left of the files after units, cycles, branches and chosen rows. A
/// stress stays in the measure of its file, to which predictions are brought. With "hold_out", a column `held_out` is 1
/// in rows that the fit leaves out.
namespace tunica::comparison {

/// One test. The table has a column for each prescribed quantity, time and channel, in base units.
struct TakenRows {
  SimulatedTable table;
  std::vector<std::size_t> lines;       ///< of the first file, one a row; empty where no file has them
  std::vector<std::string> understood;  ///< what each column was taken for, and which rows were taken
  std::vector<std::string> warnings;
};

/// Every test of the experiment that has data, in its order. Throws InputError on data that cannot be read.
std::vector<TakenRows> taken_rows(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue);

/// What `tunica data --json` prints.
nlohmann::ordered_json taken_rows_json(const std::vector<TakenRows>& tests);

}  // namespace tunica::comparison
