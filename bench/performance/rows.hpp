// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "floors.hpp"
#include "measure.hpp"

/// The rows of the benchmark by what they are about. Making a row costs nothing: only its `make` loads and prepares.
namespace tunica::bench {

std::vector<Row> point_rows();      ///< material points, a model each
std::vector<Row> test_rows();       ///< strips, sheet, long tube
std::vector<Row> fe_rows();         ///< tube by finite elements
std::vector<Row> extension_rows();  ///< composed models, memory
std::vector<Row> search_rows();     ///< optimisers, threads, constraint
std::vector<Row> journal_rows();    ///< evaluations.csv

/// Whether floors and peers are left out: of a comparison of builds, and where memory is looked at.
inline bool bare = false;

/// Kernels for the levels that this machine has.
std::vector<const floors::Kernels*> levels();

/// A folder for data and results that is gone when the process ends.
const std::filesystem::path& scratch();

}  // namespace tunica::bench
