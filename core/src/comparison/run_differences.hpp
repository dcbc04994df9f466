// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "execution/plan.hpp"

namespace tunica::comparison {

/// "h = 0.7, admissible": the constraints of a run; empty for none.
std::string constraints_in_words(const experiment::RunEntry& run);

/// For each run what it has that other runs of the same model and optimizer have not: {"h = 0.7", "20 realisations"}.
/// One that repeats an earlier run says "other seed"; one that is alone with its pair says nothing.
std::vector<std::vector<std::string>> run_differences(const execution::Plan& plan);

/// For each run the labels of the others that begin their searches at the same points.
std::vector<std::vector<std::string>> paired_runs(const execution::Plan& plan);

}  // namespace tunica::comparison
