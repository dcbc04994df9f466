// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "budget/budget.hpp"
#include "diagnosis/diagnosis.hpp"
#include "discovery/after_diagnosis.hpp"

namespace tunica::budget {

/// A diagnosis, the search for terms that followed it, and what takes how much of the misfit.
struct DiagnosisAndSearch {
  diagnosis::Diagnosis diagnosis;
  std::optional<discovery::Discovery> search;
  std::optional<Budget> budget = {};

  [[nodiscard]] bool discovered() const { return diagnosis.explanation.verdict == diagnosis::Verdict::discovered; }
  [[nodiscard]] bool leads() const { return diagnosis.explanation.verdict == diagnosis::Verdict::leading; }
};

/// The whole of `tunica diagnose`; `discovers` decides whether terms are searched where the cause is unknown.
DiagnosisAndSearch diagnosed(const experiment::Experiment& experiment, const diagnosis::Request& request,
                             const plugins::Catalogue& catalogue, bool discovers,
                             const diagnosis::Progress& progress = {});

/// All files of a diagnosis except its page: input.json, extended.json if there is an extension, the tables, and the
/// verdict last, result.json.
void write_diagnosis(const std::filesystem::path& directory, const DiagnosisAndSearch& found,
                     const experiment::Experiment& experiment, const plugins::Catalogue& catalogue);

}  // namespace tunica::budget
