// SPDX-License-Identifier: Apache-2.0
#include "discovery/preparation.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "diagnosis/evidence/gross_rows.hpp"
#include "diagnosis/hypotheses/isotropy.hpp"
#include "diagnosis/hypotheses/volume.hpp"
#include "plugins/guarded.hpp"
#include "tunica/error.hpp"

namespace tunica::discovery {

void check(const Request& request, const plugins::Catalogue& catalogue) {
  if (request.model.empty())
    throw InputError(
        "discovery: every test names the models of its layers, so that it is open which of them gets the terms. Name "
        "one in \"discovery\": {\"model\": …}");
  if (!catalogue.term_model() || !catalogue.term_mechanism())
    throw InputError(
        "discovery: no loaded plugin provides the model that terms are written in, or the mechanism that adds them. "
        "Give --plugin-path a folder that holds 'composed'");
}

void check_states(const Request& request, const experiment::Experiment& experiment) {
  if (!request.from_nothing) return;
  const experiment::RunEntry* const run = diagnosis::run_of_model(experiment, request.model);
  for (const experiment::TestEntry& test : experiment.tests) {
    if (test.state.empty()) continue;
    if (run != nullptr && std::find(run->tests.begin(), run->tests.end(), test.name) == run->tests.end()) continue;
    throw InputError(
        fmt::format("discovery: the test '{}' is in the state '{}', whose parameters are of the model '{}'; from "
                    "nothing, terms are "
                    "of a specimen in one state. Leave \"from_nothing\" out, so that terms are looked for beside the "
                    "model, or take "
                    "the tests of other states out of the run",
                    test.name, test.state, request.model));
  }
}

std::vector<KindPointer> scaled_kinds(const Fitter& fitter, std::vector<Kind> kinds) {
  tbb::parallel_for(std::size_t{0}, kinds.size(),
                    [&](std::size_t k) { kinds[k].largest = fitter.largest_amplitude(kinds[k]); });
  std::vector<KindPointer> shared;
  for (Kind& kind : kinds)
    if (kind.largest != 0) shared.push_back(std::make_shared<const Kind>(std::move(kind)));
  return shared;
}

diagnosis::Analysis screened(const diagnosis::Inquiry& inquiry) {
  diagnosis::Analysis whole = diagnosis::analyse(inquiry, {});
  if (!whole.alarm.raised) return whole;
  const auto gross = diagnosis::gross_rows(whole.evidence);
  return gross.empty() ? std::move(whole) : diagnosis::analyse(inquiry, gross);
}

bool has_directions(const experiment::Experiment& experiment, const std::string& name,
                    const plugins::Catalogue& catalogue) {
  const experiment::ModelEntry& entry = experiment.model(name);
  return !diagnosis::is_isotropic(*plugins::create(catalogue.models().at(entry.type), entry.options));
}

namespace {

bool changes_volume_by_itself(const experiment::Experiment& experiment, const std::string& name,
                              const plugins::Catalogue& catalogue) {
  const experiment::ModelEntry& entry = experiment.model(name);
  return plugins::create(catalogue.models().at(entry.type), entry.options)->describe().compressible;
}

}  // namespace

bool changes_volume(const experiment::Experiment& experiment, const std::string& name,
                    const plugins::Catalogue& catalogue) {
  const experiment::RunEntry* const run = diagnosis::run_of_model(experiment, name);
  return run != nullptr && diagnosis::changes_volume(assembly::Assembly(experiment, *run, catalogue));
}

void check_volume(const Request& request, const experiment::Experiment& experiment,
                  const plugins::Catalogue& catalogue) {
  if (request.from_nothing && changes_volume(experiment, request.model, catalogue))
    throw InputError(fmt::format(
        "discovery: from nothing, terms that several specimens have in common are of materials that keep their volume, "
        "and the model '{}' changes it. Leave \"from_nothing\" out: terms are then looked for beside the model",
        request.model));
}

bool sees_volume(const Subject& subject, const diagnosis::Evidence& evidence) {
  return changes_volume_by_itself(subject.experiment, subject.model, subject.catalogue) &&
         diagnosis::sees_volume(*evidence.base, evidence.experiment, subject.catalogue);
}

}  // namespace tunica::discovery
