// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cohort/diagnosis_study.hpp"
#include "cohort/extended_files.hpp"
#include "experiment/reader.hpp"

namespace tunica::cohort {

namespace {

using Json = nlohmann::ordered_json;

/// Errors of a channel are as large as its numbers, which no declared bound knows: room for every specimen.
void give_room(const cohort_diagnosis::CommonAmplitude& amplitude, Json& setting) {
  constexpr double room = 10;
  const double reach = room * (std::abs(amplitude.mean) + amplitude.spread);
  if (!(reach > 0)) return;
  setting["min"] = -reach;
  setting["max"] = reach;
}

/// One mechanism as an experiment has it.
Json mechanism_json(const std::string& id, const MechanismFactory& mechanism, const diagnosis::Place& place,
                    const std::vector<std::pair<std::string, double>>& setting,
                    const cohort_diagnosis::CommonAmplitude& amplitude) {
  Json json{{"type", id}}, parameters = Json::object();
  for (const Option& option : mechanism.options) {
    if (option.name == "channel") json["channel"] = place.channel;
    if (option.name == "rows" && place.row) json["rows"] = fmt::format("{}:{}:1", place.file_row, place.file_row + 1);
    for (const auto& [name, value] : setting)
      if (name == option.name) json[name] = value;
  }
  for (std::size_t k = 0; k < mechanism.parameters.size(); ++k) {
    const Parameter& parameter = mechanism.parameters[k];
    double start = parameter.initial;
    if (k == 0) start = amplitude.squared ? mechanism.null + std::sqrt(std::max(amplitude.mean, 0.0)) : amplitude.mean;
    for (const auto& [name, value] : setting)
      if (name == parameter.name) start = value;
    const bool of_channel =
        k == 0 && !place.tests.empty() && (mechanism.plausible_effect > 0 || json.contains("channel"));
    if (of_channel && !amplitude.squared)
      give_room(amplitude, parameters[parameter.name]);
    else
      start = std::clamp(start, parameter.min, parameter.max);
    if (std::isfinite(start)) parameters[parameter.name]["initial"] = start;
    // One amplitude in several tests: they share a parameter.
    if (place.tests.size() > 1) parameters[parameter.name]["share"] = id + "_" + parameter.name;
  }
  json["parameters"] = parameters;
  return json;
}

/// The models of the first run: a mechanism of the material acts in the first unless its place names one.
std::string first_model(const Specification& cohort, const plugins::Catalogue& catalogue) {
  const auto experiment = experiment::read_experiment(cohort.experiment, catalogue);
  if (!experiment.runs.empty())
    if (const auto models = experiment.models_of(experiment.runs.front()); !models.empty()) return models.front();
  return experiment.models.front().name;
}

void add(Json& owner, const Json& mechanism) {
  if (!owner.contains("mechanisms")) owner["mechanisms"] = Json::array();
  owner["mechanisms"].push_back(mechanism);
}

}  // namespace

void extend(const Specification& cohort, const plugins::Catalogue& catalogue, DiagnosisStudy& study) {
  const auto& verdict = study.verdict;
  const bool has_a_cause =
      verdict.verdict == diagnosis::Verdict::named || verdict.verdict == diagnosis::Verdict::indistinguishable;
  if (!has_a_cause || verdict.amplitudes.empty()) return;
  const auto& best = verdict.explanations.front();
  Json experiment = template_json(cohort);
  for (std::size_t k = 0; k < best.ids.size(); ++k) {
    const diagnosis::Place& place = best.places[k];
    const Json mechanism = mechanism_json(best.ids[k], catalogue.mechanisms().at(best.ids[k]).factory, place,
                                          best.settings[k], verdict.amplitudes[k]);
    if (place.tests.empty())
      add(experiment["models"][place.model.empty() ? first_model(cohort, catalogue) : place.model], mechanism);
    for (const std::string& test : place.tests) add(experiment["tests"][test], mechanism);
  }
  study.extended = experiment_text(cohort, std::move(experiment));
  study.extended_cohort = cohort_text(cohort);
}

}  // namespace tunica::cohort
