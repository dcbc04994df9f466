// SPDX-License-Identifier: Apache-2.0
#include "cohort/diagnosis_study.hpp"

#include <map>

#include "cohort_diagnosis/combination.hpp"

namespace tunica::cohort {

namespace {

/// Columns that sort specimens into groups, as far as they do.
std::vector<cohort_diagnosis::Factor> factors_of(const SpecimenTable& table, const CollectedEvidence& evidence) {
  std::vector<cohort_diagnosis::Factor> factors;
  for (const Factor& factor : table.factors) {
    if (!factor.refusal.empty()) continue;
    cohort_diagnosis::Factor& one = factors.emplace_back();
    one.name = factor.column;
    for (const std::size_t k : evidence.positions) one.level[table.specimens[k].id] = factor.levels[factor.of[k]];
  }
  return factors;
}

}  // namespace

DiagnosisStudy study_diagnosis(const Specification& cohort, const SpecimenTable& table, const Collection& found,
                               const plugins::Catalogue& catalogue, const std::filesystem::path& results) {
  CollectedEvidence evidence = collect_evidence(table, found, results);
  DiagnosisStudy study;
  study.alpha = cohort.diagnosis->alpha;
  study.problems = std::move(evidence.problems);
  if (evidence.specimens.empty()) {
    study.none = "no specimen could be diagnosed";
    return study;
  }
  study.verdict = cohort_diagnosis::combine(evidence.specimens, factors_of(table, evidence), {study.alpha});
  // The verdict lists its specimens in another order.
  std::map<std::string, std::size_t> position;
  for (const std::size_t k : evidence.positions) position[table.specimens[k].id] = k;
  for (const std::string& id : study.verdict.specimens) study.positions.push_back(position.at(id));
  extend(cohort, catalogue, study);
  return study;
}

}  // namespace tunica::cohort
