// SPDX-License-Identifier: Apache-2.0
#include "budget/diagnosed.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "budget/output/outputs.hpp"
#include "diagnosis/output/outputs.hpp"
#include "discovery/output/outputs.hpp"
#include "execution/files.hpp"
#include "results/keys.hpp"

namespace tunica::budget {

namespace key = results::key;

DiagnosisAndSearch diagnosed(const experiment::Experiment& experiment, const diagnosis::Request& request,
                             const plugins::Catalogue& catalogue, bool discovers, const diagnosis::Progress& progress) {
  // What follows the diagnosis has the last twentieth of the way.
  constexpr double before_search = 0.95;
  const diagnosis::Progress first = [&](const std::string& stage, double share) {
    if (progress && (!discovers || share < 1)) progress(stage, discovers ? std::min(share, before_search) : share);
  };
  const diagnosis::Progress last = [&](const std::string& stage, double share) {
    if (progress && share < 1) progress(stage, before_search + (1 - before_search) * share);
  };
  diagnosis::Request own = request;
  own.discovers = discovers;
  DiagnosisAndSearch found{diagnosis::diagnose(experiment, own, catalogue, first), {}};
  if (discovers) found.search = discovery::after(found.diagnosis, experiment, catalogue, last);
  if (found.search) found.diagnosis = discovery::with_verdict_of(*found.search, std::move(found.diagnosis));
  found.budget = budget_of(found.diagnosis, found.search ? &*found.search : nullptr, experiment, catalogue, last);
  found.diagnosis = with_verdict_of(*found.budget, experiment, catalogue, std::move(found.diagnosis));
  if (progress) progress("done", 1);
  return found;
}

void write_diagnosis(const std::filesystem::path& directory, const DiagnosisAndSearch& found,
                     const experiment::Experiment& experiment, const plugins::Catalogue& catalogue) {
  execution::write_atomically(directory / "input.json", experiment.input_json);
  nlohmann::ordered_json more = nlohmann::ordered_json::object();
  std::string extended;
  if (found.search) more[key::discovery] = discovery::discovery_json(*found.search);
  // The terms take the place of a mechanism that leaves more than noise.
  if (found.discovered()) extended = discovery::extended_experiment(*found.search, catalogue);
  if (extended.empty() && found.leads()) extended = extended_experiment(*found.budget, found.diagnosis, catalogue);
  if (extended.empty()) extended = diagnosis::extended_experiment(found.diagnosis, catalogue);
  if (!extended.empty()) execution::write_atomically(directory / "extended.json", extended);
  for (const auto& [name, text] : diagnosis::mended_files(found.diagnosis, directory, catalogue))
    execution::write_atomically(directory / name, text);
  diagnosis::write_tables(directory, found.diagnosis);
  if (found.discovered())
    execution::write_atomically(directory / "residuals.csv", discovery::residual_table(*found.search));
  if (found.leads() && found.budget->fitted && !found.diagnosis.explanation.claim.best)
    execution::write_atomically(
        directory / "residuals.csv",
        diagnosis::residual_table(found.diagnosis.analysis.evidence, &found.budget->fitted->extension->assembly(),
                                  &found.budget->fitted->fit, {}));
  nlohmann::ordered_json of_diagnosis = nlohmann::ordered_json::object();
  if (found.budget) of_diagnosis[key::budget] = budget_json(*found.budget);
  execution::write_atomically(directory / "result.json",
                              diagnosis::result_document(found.diagnosis, experiment, catalogue, more, of_diagnosis));
}

}  // namespace tunica::budget
