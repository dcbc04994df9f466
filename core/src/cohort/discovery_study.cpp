// SPDX-License-Identifier: Apache-2.0
#include "cohort/discovery_study.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cohort/extended_files.hpp"
#include "discovery/output/outputs.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {

namespace {

using Json = nlohmann::ordered_json;

/// One parameter over the extended experiments of the specimens: the widest bounds and the median value.
void merge(const std::vector<Json>& settings, Json& merged) {
  std::vector<double> values;
  for (const Json& one : settings) {
    if (one.contains("initial") && one["initial"].is_number()) values.push_back(one["initial"].get<double>());
    for (const char* bound : {"min", "max"}) {
      if (!one.contains(bound) || !merged.contains(bound)) continue;
      const double here = one[bound].get<double>(), there = merged[bound].get<double>();
      merged[bound] = std::string(bound) == "min" ? std::min(here, there) : std::max(here, there);
    }
  }
  if (values.empty()) return;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  merged["initial"] = *middle;
}

void merge_parameters(const std::vector<const Json*>& owners, Json& merged) {
  for (auto& [name, setting] : merged["parameters"].items()) {
    std::vector<Json> settings;
    for (const Json* owner : owners)
      if (owner->contains("parameters") && (*owner)["parameters"].contains(name))
        settings.push_back((*owner)["parameters"][name]);
    merge(settings, setting);
  }
}

/// The entry of the model with the terms, as each specimen has it.
std::vector<Json> extended_models(const discovery::CommonDiscovery& found, const plugins::Catalogue& catalogue) {
  std::vector<Json> models;
  for (std::size_t s = 0; s < found.specimens.size(); ++s) {
    const discovery::SetFit& fit = found.best->specimens[s];
    if (!fit.set || fit.kinds.empty()) continue;
    const Json experiment = Json::parse(discovery::extended_experiment(fit, found.specimens[s].analysis, catalogue));
    models.push_back(experiment["models"][found.request.model]);
  }
  return models;
}

/// Beside a base: the mechanisms that are its terms.
Json with_terms(Json model, const discovery::CommonDiscovery& found, const std::vector<Json>& of_specimens) {
  if (!model.contains("mechanisms")) model["mechanisms"] = Json::array();
  for (const discovery::CommonTerm& term : found.terms) {
    std::vector<const Json*> entries;
    for (const Json& one : of_specimens)
      for (const Json& mechanism : one["mechanisms"])
        if (mechanism.value("as", "") == term.name) entries.push_back(&mechanism);
    if (entries.empty()) continue;
    Json merged = *entries.front();
    merge_parameters(entries, merged);
    model["mechanisms"].push_back(std::move(merged));
  }
  return model;
}

/// From nothing: the model of the specimen that shows the most terms.
Json made_of_terms(const std::vector<Json>& of_specimens) {
  const auto most = std::max_element(of_specimens.begin(), of_specimens.end(), [](const Json& a, const Json& b) {
    return a["terms"].size() < b["terms"].size();
  });
  Json merged = *most;
  std::vector<const Json*> owners;
  for (const Json& one : of_specimens) owners.push_back(&one);
  merge_parameters(owners, merged);
  return merged;
}

void extend(const Specification& cohort, const plugins::Catalogue& catalogue, DiscoveryStudy& study) {
  const discovery::CommonDiscovery& found = study.found;
  if (found.terms.empty()) return;
  const std::string& name = found.request.model;
  if (found.request.from_nothing)
    for (const Binding& binding : cohort.bindings)
      if (binding.pointer.starts_with("/models/" + name + "/")) {
        study.not_extended =
            fmt::format("{} binds {}, which the terms take the place of", binding.place, binding.pointer);
        return;
      }
  const std::vector<Json> models = extended_models(found, catalogue);
  if (models.empty()) return;
  Json experiment = template_json(cohort);
  Json& model = experiment["models"][name];
  model = found.request.from_nothing ? made_of_terms(models) : with_terms(std::move(model), found, models);
  experiment.erase("discovery");  // what was asked has been answered
  study.extended = experiment_text(cohort, std::move(experiment));
  study.extended_cohort = cohort_text(cohort);
}

}  // namespace

DiscoveryStudy study_discovery(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                               const plugins::Catalogue& catalogue, const DiscoveryRequestOf& request_of,
                               const diagnosis::Progress& progress) {
  std::vector<discovery::Member> members;
  std::vector<discovery::LeftOut> unreadable;
  for (const Specimen& specimen : table.specimens) {
    if (!specimen.problem.empty()) {
      unreadable.push_back({specimen.id, specimen.problem});
      continue;
    }
    try {
      members.push_back({specimen.id, bind(cohort, pattern, specimen, catalogue).experiment});
    } catch (const InputError& problem) {
      unreadable.push_back({specimen.id, problem.what()});
    }
  }
  if (members.empty())
    throw InputError(fmt::format(
        "{}: none of {} specimens can be read{}. Look at the table and at the files that it names",
        cohort.file.string(), table.specimens.size(),
        unreadable.empty() ? ""
                           : fmt::format("; the first, '{}': {}", unreadable.front().id, unreadable.front().reason)));
  DiscoveryStudy study{
      discovery::discover_together(members, request_of(members.front().experiment), catalogue, progress),
      members.front().experiment};
  study.found.left_out.insert(study.found.left_out.begin(), unreadable.begin(), unreadable.end());
  std::map<std::string, std::size_t> position;
  for (std::size_t k = 0; k < table.specimens.size(); ++k) position[table.specimens[k].id] = k;
  for (const discovery::SpecimenOutcome& one : study.found.specimens) study.positions.push_back(position.at(one.id));
  extend(cohort, catalogue, study);
  return study;
}

}  // namespace tunica::cohort
