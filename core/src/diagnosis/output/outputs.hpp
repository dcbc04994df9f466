// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "diagnosis/diagnosis.hpp"
#include "text/styled.hpp"

namespace tunica::diagnosis {

/// `diagnosis` of result.json.
nlohmann::ordered_json diagnosis_json(const Diagnosis& diagnosis);

/// The `target` of a cause: null where it acts on the only model.
nlohmann::ordered_json place_json(const Place& place);

/// `warning_details` of result.json; a diagnosis has no runs.
nlohmann::ordered_json warning_details(const std::vector<Warning>& warnings);

/// The whole of result.json: no runs, the diagnosis, its warnings and provenance; and what followed the diagnosis, by
/// its key; `of_diagnosis` are further keys of `diagnosis`.
std::string result_document(const Diagnosis& diagnosis, const experiment::Experiment& experiment,
                            const plugins::Catalogue& catalogue, const nlohmann::ordered_json& more,
                            const nlohmann::ordered_json& of_diagnosis);

/// The ambiguity set in words: "a (or b, c, much the same here)", "d"; of what acts together "a with b", "a with c".
std::vector<std::string> explanations(const Claim& claim);

/// "INDISTINGUISHABLE: a, b explain the misfit about equally well", of explanations in words.
std::string rivalry(const std::vector<std::string>& all);

/// The text on the terminal: what is wrong and where, the cause and how certain it is, its rivals, the gain, and the
/// next measurement. `below_verdict`: lines directly below the verdict.
text::StyledText summary(const Diagnosis& diagnosis, const text::StyledText& below_verdict = {});

/// The experiment with the causes added, its parameters at their fitted values, one run of whitened least squares: the
/// text of extended.json. Empty without an extension.
std::string extended_experiment(const Diagnosis& diagnosis, const plugins::Catalogue& catalogue);

struct NamedText {
  std::string name, text;
};
/// If the file may contain a mistake: mended.json, which is the experiment with the likeliest mistake corrected, and
/// the tables of the affected tests in base units, in `directory`. Else empty.
std::vector<NamedText> mended_files(const Diagnosis& diagnosis, const std::filesystem::path& directory,
                                    const plugins::Catalogue& catalogue);

/// The text of residuals.csv, from a fit of an extension or without one (both null); signatures by the name of their
/// column.
std::string residual_table(const Evidence& evidence, const assembly::Assembly* extension, const Fit* fit,
                           const std::vector<std::pair<std::string, Eigen::VectorXd>>& signatures);

/// residuals.csv: one line a fitted row; measured, predicted by the base and by the extension, σ of the measured value
/// (of its mean over replicates), whitened residuals of both, and what each cause changes: how its refit differs from
/// the base fit, or for one of several its own share of their refit, whitened.
/// confusability.csv: how much every mechanism may look like that of the row as it explains these data best.
void write_tables(const std::filesystem::path& directory, const Diagnosis& diagnosis);

}  // namespace tunica::diagnosis
