// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cohort/collection.hpp"
#include "cohort_diagnosis/specimen_evidence.hpp"

/// The part of a shard in the diagnosis of a cohort: a file for each specimen, beside its record.
namespace tunica::cohort {

/// Diagnoses one specimen and writes specimens/<folder>/evidence.json, or why that could not be done. Nothing happens
/// where the file is there, undamaged and from the same inputs, or where the specimen cannot be read. Throws
/// execution::WriteFailure.
void gather_evidence(const Specification& cohort, const Template& pattern, const Specimen& specimen,
                     const Record& record, const plugins::Catalogue& catalogue, const FitSettings& settings);

/// Whether the specimen of this record still has to be diagnosed.
bool lacks_evidence(const Specification& cohort, const Specimen& specimen, const Record& record,
                    const std::filesystem::path& results);

/// A specimen without evidence.
struct NotDiagnosed {
  std::size_t position = 0;  ///< in the table
  std::string reason;
  bool unreadable = false;  ///< it could not be fitted either, which is said elsewhere
};

/// The evidence of a cohort, and the specimens that have none.
struct CollectedEvidence {
  std::vector<cohort_diagnosis::SpecimenEvidence> specimens;
  std::vector<std::size_t> positions;  ///< of each in the table
  std::vector<NotDiagnosed> problems;
};

/// Throws InputError where a file of evidence is damaged.
CollectedEvidence collect_evidence(const SpecimenTable& table, const Collection& found,
                                   const std::filesystem::path& results);

}  // namespace tunica::cohort
