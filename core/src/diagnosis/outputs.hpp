// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// `diagnosis` of result.json.
nlohmann::ordered_json diagnosis_json(const Diagnosis& diagnosis);

/// The whole of result.json: no runs, the diagnosis, its warnings and provenance.
std::string result_document(const Diagnosis& diagnosis, const experiment::Experiment& experiment,
                            const plugins::Catalogue& catalogue);

/// What a person reads on the terminal: what is wrong and where, the cause and how sure, what else it could be, what
/// was gained, what to measure next.
std::string summary(const Diagnosis& diagnosis);

/// The experiment with the causes added, its parameters at their fitted values, one run of whitened least squares: the
/// text of extended.json. Empty without an extension.
std::string extended_experiment(const Diagnosis& diagnosis, const plugins::Catalogue& catalogue);

/// residuals.csv: one line a fitted row; measured, predicted by the base and by the extension, σ, whitened residuals of
/// both, and for the causes what their signatures would add to the prediction at their amplitude, in σ.
/// confusability.csv: largest absolute correlation of projected signatures, mechanism by mechanism.
void write_tables(const std::filesystem::path& directory, const Diagnosis& diagnosis);

}  // namespace tunica::diagnosis
