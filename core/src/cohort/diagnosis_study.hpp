// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "cohort/evidence.hpp"
#include "cohort_diagnosis/cohort_verdict.hpp"

namespace tunica::cohort {

/// Errors of the simulation in all specimens, or in one group of them: docs/cohort_diagnosis.md.
struct DiagnosisStudy {
  cohort_diagnosis::CohortVerdict verdict;
  double alpha = 0.05;
  std::vector<std::size_t> positions;  ///< in the table, of the specimens of the matrix
  std::vector<NotDiagnosed> problems;
  std::string none;  ///< why there is no verdict; empty = there is
  /// Texts of extended.json and extended_cohort.json; empty = no cause is named.
  std::string extended, extended_cohort;
};

/// From the evidence in a results folder. Deterministic, for any number of threads and shards.
DiagnosisStudy study_diagnosis(const Specification& cohort, const SpecimenTable& table, const Collection& found,
                               const plugins::Catalogue& catalogue, const std::filesystem::path& results);

/// The experiment with the causes of the likeliest explanation, their amplitudes beginning at the cohort's mean, and
/// the cohort file that fits it. Every other key of the experiment stays as it is, so that the bindings hold; files of
/// data are named from the root.
void extend(const Specification& cohort, const plugins::Catalogue& catalogue, DiagnosisStudy& study);

/// `diagnosis` of result.json.
nlohmann::ordered_json diagnosis_json(const SpecimenTable& table, const DiagnosisStudy& study);

/// mechanisms.csv in long form: how much each specimen speaks for each mechanism where it acts best,
///
///   specimen, <column of the table> …, p_value, mechanism, place, log_evidence
///
/// the last in natural logarithms, over nothing.
std::string mechanism_table(const SpecimenTable& table, const DiagnosisStudy& study);

/// Its text for terminal and report: the verdict first, a clause or a sentence each.
std::vector<std::string> diagnosis_sentences(const DiagnosisStudy& study);
std::string diagnosis_words(const SpecimenTable& table, const DiagnosisStudy& study);

}  // namespace tunica::cohort
