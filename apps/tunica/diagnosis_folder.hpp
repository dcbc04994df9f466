// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "diagnosis/diagnosis.hpp"

namespace tunica::app {

/// Everything that a diagnosis leaves behind beside its page: input.json, extended.json where there is an extension,
/// the tables, and the verdict last, result.json.
void write_diagnosis(const std::filesystem::path& directory, const diagnosis::Diagnosis& found,
                     const experiment::Experiment& experiment, const plugins::Catalogue& catalogue);

}  // namespace tunica::app
