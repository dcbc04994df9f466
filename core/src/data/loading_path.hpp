// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.hpp"

/// What is known of the loading before each row of a test.
namespace tunica::data {

/// Whether the past of every row is known. Models and mechanisms with memory need it.
enum class Past {
  known,            ///< rows stand as they were measured, and begin near rest or go on loading
  order_unknown,    ///< the order of measurement is not stated
  starts_unloading  ///< the first row lies far from rest, and the load falls from there: what came before is unknown
};

/// Far from rest is more than half of the largest distance; the rest of a stretch is 1, of a pressure 0. Unloading is
/// a return by more than a tenth of that distance before any rise by as much.
Past past_of(const Dataset& dataset, const std::vector<Observable>& observables);

/// A path that is under load in its first row, at a time that is not that of the unloaded state.
struct LoadedStart {
  std::string abscissa;  ///< "stretch"
  double value, time;    ///< of the first row, in base units
};

/// Where every stretch and stress that is prescribed begins farther from rest than half of its largest distance, and
/// the clock has run for more than a step between rows. Models with memory take a straight ramp from rest at time 0 for
/// what came before, and nothing in the rows tells.
std::optional<LoadedStart> loaded_start_of(const Dataset& dataset, const std::vector<Observable>& observables);

/// Rows in an order that is theirs whatever the order in the file: by their abscissae, those with few different values
/// first, then by what was measured. `file_rows` says which row of the file each is. Not without an abscissa, and not
/// where the rows run to and fro: those stand as they were measured.
void sort_rows(Dataset& dataset);

/// First, turning and last values of a path; a turn is one by more than a twentieth of the range.
std::vector<double> turning_points(std::span<const double> path);

/// "stretch 1 → 1.5 → 1.02, 1 cycle, 204 rows; starts at rest"; of the first abscissa. Empty without an abscissa.
std::string path_words(const Dataset& dataset, const std::vector<Observable>& observables);

/// The path as one line of block characters, the lowest value as the lowest block.
std::string path_drawing(std::span<const double> path, std::size_t columns);

}  // namespace tunica::data
