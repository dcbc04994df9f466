// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

#include "comparison/result_json.hpp"
#include "diagnosis/hypotheses/places.hpp"
#include "diagnosis/naming/credible.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "diagnosis/output/outputs.hpp"

namespace tunica::diagnosis {
namespace {

using json = nlohmann::ordered_json;

json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

template <class Value>
json or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

json amplitude_json(const Amplitude& amplitude) {
  const bool interval = std::isfinite(amplitude.low) && std::isfinite(amplitude.high);
  return {{"name", amplitude.name},
          {"value", amplitude.value},
          {"unit", amplitude.unit},
          {"ci95", interval ? json::array({amplitude.low, amplitude.high}) : json(nullptr)},
          {"plausible", amplitude.plausible}};
}

json cause_json(const Cause& cause, const Explanation& explanation) {
  json nuisance = json::array(), shifts = json::array();
  for (const Amplitude& one : cause.nuisance) nuisance.push_back(amplitude_json(one));
  for (const Cause::Shift& shift : cause.shifts)
    shifts.push_back(
        {{"parameter", shift.name}, {"unit", shift.unit}, {"without", shift.before}, {"with", shift.after}});
  return {{"id", cause.id},
          {"group", code_of(cause.group)},
          {"target", place_json(cause.place)},
          {"p_value", cause.p_value},
          {"probability", cause.probability},
          {"standing", code_of(standing_of(cause, explanation))},
          {"amplitude", amplitude_json(cause.amplitude)},
          {"nuisance", std::move(nuisance)},
          {"retained_fraction", std::min(1.0, cause.retained)},
          {"gain", cause.gain},
          {"parameter_shifts", std::move(shifts)},
          {"claim", "consistent_with"},
          {"explanation", cause.explanation}};
}

json gain_json(const Gain& gain) {
  json held_out = json::array();
  for (const HeldOut& block : gain.held_out)
    held_out.push_back({{"block", block.block},
                        {"rows", block.rows},
                        {"before", block.before},
                        {"after", block.after},
                        {"p_value", block.p_value},
                        {"verdict", code_of(block.verdict)}});
  json best_rejected = nullptr;
  if (gain.best_rejected)
    best_rejected = {{"id", gain.best_rejected->id}, {"in_sample", gain.before - gain.best_rejected->after}};
  return {{"in_sample", gain.before - gain.after},
          {"before", gain.before},
          {"after", gain.after},
          {"expected_under_nothing", gain.expected_under_nothing},
          {"held_out", std::move(held_out)},
          {"best_wrong", std::move(best_rejected)}};
}

const char* code_of(NoiseSource::Kind kind) {
  return kind == NoiseSource::Kind::stated         ? "stated"
         : kind == NoiseSource::Kind::replicates   ? "replicates"
         : kind == NoiseSource::Kind::encompassing ? "encompassing"
                                                   : "differences";
}

/// Those that make up the best explanation, the gross rows beside them, then rivals.
std::vector<Cause> all_causes(const Explanation& explanation) {
  std::vector<Cause> all = explanation.claim.causes;
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(explanation.claim.named, all.size()));
  all.insert(end, explanation.left_out.begin(), explanation.left_out.end());
  return all;
}

json misfit_json(const std::vector<Misfit>& misfits) {
  json all = json::array();
  for (const Misfit& one : misfits)
    all.push_back({{"test", one.test},
                   {"channel", one.channel},
                   {"where", one.where},
                   {"from", one.from},
                   {"to", one.to},
                   {"p_value", one.p_value}});
  return all;
}

json detectable_json(const std::vector<Detectable>& detectable) {
  json all = json::array();
  for (const Detectable& one : detectable)
    all.push_back({{"id", one.id},
                   {"detectable", finite(one.detectable)},
                   {"identifiable", finite(one.identifiable)},
                   {"null", one.null},
                   {"reach", finite(one.reach)},
                   {"unit", one.unit},
                   {"target", place_json(one.place)},
                   {"retained_fraction", std::min(1.0, one.retained)},
                   {"closest", one.closest.empty() ? json(nullptr) : json(one.closest)},
                   {"correlation", one.correlation},
                   {"absent", one.absent.empty() ? json(nullptr) : json(one.absent)},
                   {"absence", code_of(one.absence)}});
  return all;
}

json ranking_json(const std::vector<RankedMechanism>& ranking) {
  json all = json::array();
  for (const RankedMechanism& one : ranking)
    all.push_back({{"id", one.id},
                   {"group", code_of(one.group)},
                   {"target", place_json(one.place)},
                   {"probability", one.probability},
                   {"score", one.score},
                   {"gain", or_null(one.gain)}});
  return all;
}

/// The best score of every mechanism that leaves a trace.
json scores_json(const Analysis& analysis) {
  const Hypotheses& hypotheses = analysis.hypotheses;
  const Detection& detection = analysis.alarm.detection;
  json all = json::array();
  for (std::size_t c = 0; c < hypotheses.candidates.size(); ++c) {
    if (detection.direction[c] >= hypotheses.directions.size()) continue;
    const Direction& direction = hypotheses.directions[detection.direction[c]];
    all.push_back({{"id", hypotheses.candidates[c].id},
                   {"group", code_of(group_of(*hypotheses.candidates[c].mechanism))},
                   {"p_value", detection.by_candidate[c]},
                   {"target", place_json(hypotheses.hypothesis(direction).addition.place)},
                   {"score", score(direction, -analysis.evidence.fit.residuals).T}});
  }
  return all;
}

json confusable_json(const std::vector<Candidate>& candidates, const Eigen::MatrixXd& alike) {
  json all = json::array();
  for (std::size_t a = 0; a < candidates.size(); ++a)
    for (std::size_t b = a + 1; b < candidates.size(); ++b) {
      const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
      if (const double c = std::max(alike(i, j), alike(j, i)); c > look_alike)
        all.push_back({{"id", candidates[a].id}, {"with", candidates[b].id}, {"correlation", c}});
    }
  return all;
}

json noise_json(const std::vector<NoiseSource>& sources) {
  json all = json::array();
  for (const NoiseSource& source : sources)
    all.push_back({{"test", source.test},
                   {"channel", source.channel},
                   {"unit", source.unit},
                   {"source", code_of(source.kind)},
                   {"absolute", source.noise.absolute},
                   {"relative", source.noise.relative},
                   {"correlation", source.noise.correlation},
                   {"freedom", source.freedom > 0 ? json(source.freedom) : json(nullptr)},
                   {"neighbours", source.neighbours > 0 ? json(source.neighbours) : json(nullptr)}});
  return all;
}

json base_json(const Evidence& evidence) {
  json parameters = json::object();
  for (std::size_t j = 0; j < evidence.base->layout().parameters.size(); ++j) {
    const auto& parameter = evidence.base->layout().parameters[j];
    parameters[parameter.name] = {{"value", evidence.fit.free[j]}, {"unit", parameter.unit}};
  }
  const assembly::Misfit misfit = stated_misfit(evidence);
  return {{"model", evidence.base->models().name(0)},
          {"misfit", misfit.judged() ? comparison::misfit_json(misfit) : json(nullptr)},
          {"parameters", std::move(parameters)},
          {"squares", evidence.fit.chi2},
          {"rows", evidence.fit.residuals.size()}};
}

json extension_json(const Explanation& explanation) {
  json mechanisms = json::array();
  for (const Addition& addition : explanation.claim.best->additions)
    mechanisms.push_back({{"type", addition.id}, {"as", addition.name()}, {"target", place_json(addition.place)}});
  for (const Cause& row : explanation.left_out)
    mechanisms.push_back({{"type", row.id}, {"target", place_json(row.place)}});
  return {{"mechanisms", std::move(mechanisms)}, {"experiment", "extended.json"}};
}

json admissibility_json(const Admissibility& admissibility) {
  return {{"stable", or_null(admissibility.stable)},
          {"where", admissibility.where.empty() ? json(nullptr) : json(admissibility.where)},
          {"remedy", admissibility.remedy.empty() ? json(nullptr) : json(admissibility.remedy)}};
}

json file_json(const FileFindings& file) {
  json causes = json::array();
  for (const FileCause& cause : file.causes) {
    causes.push_back({{"kind", code_of(cause.kind)},
                      {"tests", cause.tests},
                      {"sentence", cause.sentence},
                      {"mend", cause.mend},
                      {"squares", cause.squares},
                      {"p_after", cause.p_after},
                      {"probability", cause.probability},
                      {"near", cause.near}});
    for (const Change& change : cause.changes)
      causes.back()["changes"].push_back({{"op", "add"}, {"path", change.path}, {"value", json::parse(change.value)}});
    if (cause.mechanism.empty()) continue;
    causes.back()["mechanism"] = cause.mechanism;
    for (const Amplitude& amplitude : cause.amplitudes) causes.back()["amplitudes"].push_back(amplitude.value);
  }
  json suspect = json::array();
  for (const Suspect& one : file.suspect) suspect.push_back({{"code", one.code}, {"text", one.text}});
  return {{"suspect", std::move(suspect)}, {"standing", code_of(file.standing)}, {"wrong_files", file.wrong_files},
          {"tried", file.tried},           {"lead", or_null(file.lead)},         {"causes", std::move(causes)},
          {"untellable", file.untellable}};
}

json gross_json(const std::vector<GrossRow>& gross) {
  json rows = json::array();
  for (const GrossRow& row : gross)
    rows.push_back({{"test", row.test}, {"channel", row.channel}, {"row", row.file_row}, {"residual", row.residual}});
  return rows;
}

/// The sentences of reasons or warnings.
template <class Statement>
json texts(const std::vector<Statement>& statements) {
  json all = json::array();
  for (const Statement& one : statements) all.push_back(one.text);
  return all;
}

json codes(const std::vector<Reason>& reasons) {
  json all = json::array();
  for (const Reason& one : reasons) all.push_back(code_of(one.kind));
  return all;
}

}  // namespace

json place_json(const Place& place) {
  if (place.tests.empty() && place.model.empty()) return nullptr;
  json result = {{"test", place.tests.size() == 1 ? json(place.tests.front()) : json(nullptr)},
                 {"channel", place.channel.empty() ? json(nullptr) : json(place.channel)}};
  if (place.tests.size() > 1) result["tests"] = place.tests;
  if (place.row) result["row"] = place.file_row;
  if (!place.model.empty()) result["model"] = place.model;
  return result;
}

json warning_details(const std::vector<Warning>& warnings) {
  json all = json::array();
  for (const Warning& warning : warnings)
    all.push_back(
        {{"kind", code_of(warning.kind)}, {"run", nullptr}, {"subjects", json::array()}, {"sentence", warning.text}});
  return all;
}

json diagnosis_json(const Diagnosis& d) {
  const Analysis& analysis = d.analysis;
  const Evidence& evidence = analysis.evidence;
  const Alarm& alarm = analysis.alarm;
  const Explanation& explanation = d.explanation;
  const Claim& claim = explanation.claim;
  json causes = json::array(), alternatives = json::array();
  for (const Cause& cause : all_causes(explanation)) causes.push_back(cause_json(cause, explanation));
  for (const auto& ids : claim.alternatives)
    if (ids.size() == 2) alternatives.push_back(ids);
  json result = {{"verdict", code_of(explanation.verdict)},
                 {"reasons", texts(explanation.reasons)},
                 {"reason_codes", codes(explanation.reasons)},
                 {"alpha", d.request.alpha},
                 {"p_value", alarm.p()},
                 {"p_smooth", alarm.detection.smooth},
                 {"p_mechanisms", alarm.detection.mechanisms},
                 {"misfit", misfit_json(explanation.misfit)},
                 {"causes", std::move(causes)},
                 {"ambiguity_set", claim.ambiguity_set},
                 {"alternatives", std::move(alternatives)},
                 {"admissibility", admissibility_json(explanation.admissibility)},
                 {"detectable", detectable_json(d.prospects.detectable)},
                 {"base", base_json(evidence)},
                 {"noise", noise_json(evidence.noise)},
                 {"scores", scores_json(analysis)},
                 {"ranking", ranking_json(explanation.ranking)},
                 {"confusable", confusable_json(analysis.hypotheses.candidates,
                                                likeness(analysis.hypotheses, explanation.best_direction))}};
  if (alarm.p_is_bound()) result["p_value_is_bound"] = true;
  if (explanation.file.wrong_files > 0) result["file"] = file_json(explanation.file);
  if (claim.best) result["extension"] = extension_json(explanation);
  if (d.prospects.gain) result["gain"] = gain_json(*d.prospects.gain);
  if (!evidence.gross.empty()) result["left_out"] = gross_json(evidence.gross);
  if (!claim.look_alikes.empty()) result["look_alikes"] = claim.look_alikes;
  if (!claim.causes.empty()) result["explanations"] = explanations(claim);
  if (explanation.unlisted) result["unlisted"] = true;
  if (claim.best) {
    result["p_after"] = explanation.p_after;
    result["remainder"] = is_clean(explanation.p_after) ? "clean" : "not_clean";
  }
  if (alarm.factor) result["alarm_factor"] = *alarm.factor;
  if (explanation.noise_factor) result["noise_factor"] = *explanation.noise_factor;
  if (const auto& next = d.prospects.next)
    result["next_experiment"] = {
        {"description", next->description}, {"separates", next->separates}, {"repeats", or_null(next->repeats)}};
  return result;
}

std::string result_document(const Diagnosis& d, const experiment::Experiment& experiment,
                            const plugins::Catalogue& catalogue, const nlohmann::ordered_json& more,
                            const nlohmann::ordered_json& of_diagnosis) {
  const Evidence& evidence = d.analysis.evidence;
  std::set<std::string> plugins;
  for (const std::string& name : experiment.models_of(evidence.run))
    plugins.insert(catalogue.models().find(experiment.model(name).type)->second.plugin);
  for (const std::string& name : evidence.run.tests)
    plugins.insert(catalogue.tests().find(experiment.test(name).type)->second.plugin);
  for (const Candidate& candidate : d.analysis.hypotheses.candidates)
    plugins.insert(catalogue.mechanisms().at(candidate.id).plugin);
  const std::vector<Warning> warnings = d.warnings();
  json document = {
      {"format", 1},
      {"name", experiment.name},
      {"warnings", texts(warnings)},
      {"warning_details", warning_details(warnings)},
      {"ranking", json::array()},
      {"identifiability", json::array()},
      {"runs", json::array()},
      {"diagnosis", diagnosis_json(d)},
      {"provenance", comparison::provenance_json(comparison::provenance_of(experiment, {plugins.begin(), plugins.end()},
                                                                           evidence.base->layout().data_hashes))}};
  document.update(more);
  document["diagnosis"].update(of_diagnosis);
  return document.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace tunica::diagnosis
