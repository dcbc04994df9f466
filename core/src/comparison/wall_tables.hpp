// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// For every test that can show its fields, of the best-ranked run that used it, at the rows with the least, the median
/// and the largest of what is prescribed first (pressure):
///
///   wall_<test>.csv        run, row (from 1), the section through the wall, see docs/results.md
///   wall_<test>_<row>.vtu  the whole mesh, where there is one
///
/// Three simulations a test. Tests that cannot say, or not at this point, are left out.
void write_wall_tables(const std::filesystem::path& directory, const execution::Plan& plan, const Summary& summary);

}  // namespace tunica::comparison
