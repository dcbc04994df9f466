// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

#include "comparison/result_json.hpp"
#include "diagnosis/credible.hpp"
#include "diagnosis/outputs.hpp"

namespace tunica::diagnosis {
namespace {

using json = nlohmann::ordered_json;

json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

template <class Value>
json or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

json target_json(const Target& target) {
  if (target.tests.empty() && target.model.empty()) return nullptr;
  json result = {{"test", target.tests.size() == 1 ? json(target.tests.front()) : json(nullptr)},
                 {"channel", target.channel.empty() ? json(nullptr) : json(target.channel)}};
  if (target.tests.size() > 1) result["tests"] = target.tests;
  if (target.row) result["row"] = *target.row;
  if (!target.model.empty()) result["model"] = target.model;
  return result;
}

json amplitude_json(const Amplitude& amplitude) {
  const bool interval = std::isfinite(amplitude.low) && std::isfinite(amplitude.high);
  return {{"name", amplitude.name},
          {"value", amplitude.value},
          {"unit", amplitude.unit},
          {"ci95", interval ? json::array({amplitude.low, amplitude.high}) : json(nullptr)},
          {"plausible", amplitude.plausible}};
}

json cause_json(const Cause& cause) {
  json nuisance = json::array(), shifts = json::array();
  for (const Amplitude& one : cause.nuisance) nuisance.push_back(amplitude_json(one));
  for (const Cause::Shift& shift : cause.shifts)
    shifts.push_back(
        {{"parameter", shift.name}, {"unit", shift.unit}, {"without", shift.before}, {"with", shift.after}});
  return {{"id", cause.id},
          {"target", target_json(cause.target)},
          {"p_value", cause.p_value},
          {"probability", cause.probability},
          {"amplitude", amplitude_json(cause.amplitude)},
          {"nuisance", std::move(nuisance)},
          {"retained_fraction", std::min(1.0, cause.retained)},
          {"gain", cause.gain},
          {"parameter_shifts", std::move(shifts)},
          {"explanation", cause.explanation}};
}

json gain_json(const Gain& gain) {
  json held_out = json::array();
  for (const HeldOut& block : gain.held_out)
    held_out.push_back({{"block", block.block},
                        {"rows", block.rows},
                        {"before", block.before},
                        {"after", block.after},
                        {"p_value", block.p_value}});
  return {{"in_sample", gain.before - gain.after},
          {"before", gain.before},
          {"after", gain.after},
          {"expected_under_nothing", gain.expected_under_nothing},
          {"held_out", std::move(held_out)},
          {"best_wrong", gain.best_wrong.empty()
                             ? json(nullptr)
                             : json{{"id", gain.best_wrong}, {"in_sample", gain.before - gain.best_wrong_after}}}};
}

const char* word(NoiseSource::Kind kind) {
  return kind == NoiseSource::Kind::stated       ? "stated"
         : kind == NoiseSource::Kind::replicates ? "replicates"
                                                 : "differences";
}

/// Those that make up the best explanation, the gross rows beside them, then rivals.
std::vector<Cause> all_causes(const Diagnosis& d) {
  std::vector<Cause> all = d.causes;
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(d.named, all.size()));
  all.insert(end, d.left_out.begin(), d.left_out.end());
  return all;
}

}  // namespace

json diagnosis_json(const Diagnosis& d) {
  json misfit = json::array(), causes = json::array(), alternatives = json::array(), detectable = json::array(),
       confusable = json::array(), noise = json::array(), parameters = json::object(), scores = json::array();
  for (const Misfit& one : d.misfit)
    misfit.push_back({{"test", one.test},
                      {"channel", one.channel},
                      {"where", one.where},
                      {"from", one.from},
                      {"to", one.to},
                      {"p_value", one.p_value}});
  for (const Cause& cause : all_causes(d)) causes.push_back(cause_json(cause));
  for (const auto& ids : d.alternatives)
    if (ids.size() == 2) alternatives.push_back(ids);
  for (const Detectable& one : d.detectable)
    detectable.push_back({{"id", one.id},
                          {"detectable", finite(one.detectable)},
                          {"identifiable", finite(one.identifiable)},
                          {"null", one.null},
                          {"reach", finite(one.reach)},
                          {"unit", one.unit},
                          {"target", target_json(one.target)},
                          {"retained_fraction", std::min(1.0, one.retained)},
                          {"closest", one.closest.empty() ? json(nullptr) : json(one.closest)},
                          {"correlation", one.correlation},
                          {"absent", one.absent.empty() ? json(nullptr) : json(one.absent)}});
  json ranking = json::array();
  const Eigen::MatrixXd alike = likeness(d);
  for (const Ranked& one : d.ranking)
    ranking.push_back({{"id", one.id},
                       {"target", target_json(one.target)},
                       {"probability", one.probability},
                       {"score", one.score},
                       {"gain", or_null(one.gain)}});
  for (std::size_t a = 0; a < d.candidates.size(); ++a) {
    if (d.detection.direction[a] < d.directions.size())
      scores.push_back(
          {{"id", d.candidates[a].id},
           {"p_value", d.detection.by_candidate[a]},
           {"target",
            target_json(d.candidates[a].hypotheses[d.directions[d.detection.direction[a]].hypothesis].addition.target)},
           {"score", score(d.directions[d.detection.direction[a]], -d.fit.residuals).T}});
    for (std::size_t b = a + 1; b < d.candidates.size(); ++b)
      if (const double c = std::max(alike(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)),
                                    alike(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(a)));
          c > look_alike)
        confusable.push_back({{"id", d.candidates[a].id}, {"with", d.candidates[b].id}, {"correlation", c}});
  }
  for (const NoiseSource& source : d.noise)
    noise.push_back({{"test", source.test},
                     {"channel", source.channel},
                     {"unit", source.unit},
                     {"source", word(source.kind)},
                     {"absolute", source.noise.absolute},
                     {"relative", source.noise.relative},
                     {"correlation", source.noise.correlation}});
  for (std::size_t j = 0; j < d.base->layout().parameters.size(); ++j)
    parameters[d.base->layout().parameters[j].name] = {{"value", d.fit.free[j]},
                                                       {"unit", d.base->layout().parameters[j].unit}};
  json extension = nullptr;
  if (d.extension) {
    json mechanisms = json::array();
    for (const Addition& addition : d.extension->additions)
      mechanisms.push_back({{"type", addition.id}, {"target", target_json(addition.target)}});
    for (const Cause& row : d.left_out) mechanisms.push_back({{"type", row.id}, {"target", target_json(row.target)}});
    extension = {{"mechanisms", std::move(mechanisms)}, {"experiment", "extended.json"}};
  }
  json result = {{"verdict", name_of(d.verdict)},
                 {"reasons", d.reasons},
                 {"alpha", d.settings.alpha},
                 {"p_value", d.p_refits ? *d.p_refits : d.detection.p},
                 {"p_smooth", d.detection.smooth},
                 {"p_mechanisms", d.detection.mechanisms},
                 {"misfit", std::move(misfit)},
                 {"causes", std::move(causes)},
                 {"ambiguity_set", d.ambiguity_set},
                 {"alternatives", std::move(alternatives)},
                 {"admissibility",
                  {{"stable", or_null(d.admissibility.stable)},
                   {"where", d.admissibility.where.empty() ? json(nullptr) : json(d.admissibility.where)},
                   {"remedy", d.admissibility.remedy.empty() ? json(nullptr) : json(d.admissibility.remedy)}}},
                 {"detectable", std::move(detectable)},
                 {"base",
                  {{"model", d.base->models().name(0)},
                   {"parameters", std::move(parameters)},
                   {"squares", d.fit.chi2},
                   {"rows", d.fit.residuals.size()}}},
                 {"noise", std::move(noise)},
                 {"scores", std::move(scores)},
                 {"ranking", std::move(ranking)},
                 {"confusable", std::move(confusable)}};
  if (d.extension) result["extension"] = std::move(extension);
  if (d.extension && d.gain) result["gain"] = gain_json(*d.gain);
  if (!d.gross.empty()) {
    json rows = json::array();
    for (const GrossRow& row : d.gross)
      rows.push_back({{"test", row.test}, {"channel", row.channel}, {"row", row.row}, {"residual", row.residual}});
    result["left_out"] = std::move(rows);
  }
  if (!d.look_alikes.empty()) result["look_alikes"] = d.look_alikes;
  if (!d.causes.empty()) result["explanations"] = explanations(d);
  if (d.unlisted) result["unlisted"] = true;
  if (d.extension) result["p_after"] = d.p_after;
  if (d.alarm_factor) result["alarm_factor"] = *d.alarm_factor;
  if (d.noise_factor) result["noise_factor"] = *d.noise_factor;
  if (d.next)
    result["next_experiment"] = {
        {"description", d.next->description}, {"separates", d.next->separates}, {"repeats", or_null(d.next->repeats)}};
  return result;
}

std::string result_document(const Diagnosis& d, const experiment::Experiment& experiment,
                            const plugins::Catalogue& catalogue) {
  std::set<std::string> plugins;
  for (const std::string& name : experiment.models_of(d.run))
    plugins.insert(catalogue.models().find(experiment.model(name).type)->second.plugin);
  for (const std::string& name : d.run.tests)
    plugins.insert(catalogue.tests().find(experiment.test(name).type)->second.plugin);
  for (const Candidate& candidate : d.candidates) plugins.insert(catalogue.mechanisms().at(candidate.id).plugin);
  const json document = {
      {"format", 1},
      {"name", experiment.name},
      {"warnings", d.warnings},
      {"ranking", json::array()},
      {"identifiability", json::array()},
      {"runs", json::array()},
      {"diagnosis", diagnosis_json(d)},
      {"provenance", comparison::provenance_json(comparison::provenance_of(experiment, {plugins.begin(), plugins.end()},
                                                                           d.base->layout().data_hashes))}};
  return document.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace tunica::diagnosis
