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
#include "results/keys.hpp"

namespace tunica::diagnosis {

namespace key = results::key;
namespace {

using json = nlohmann::ordered_json;

json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

template <class Value>
json or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

json amplitude_json(const Amplitude& amplitude) {
  const bool interval = std::isfinite(amplitude.low) && std::isfinite(amplitude.high);
  return {{key::name, amplitude.name},
          {key::value, amplitude.value},
          {key::unit, amplitude.unit},
          {key::ci95, interval ? json::array({amplitude.low, amplitude.high}) : json(nullptr)},
          {key::plausible, amplitude.plausible}};
}

json cause_json(const Cause& cause, const Explanation& explanation) {
  json nuisance = json::array(), shifts = json::array();
  for (const Amplitude& one : cause.nuisance) nuisance.push_back(amplitude_json(one));
  for (const Cause::Shift& shift : cause.shifts)
    shifts.push_back({{key::parameter, shift.name},
                      {key::unit, shift.unit},
                      {key::without, shift.before},
                      {key::with, shift.after}});
  return {{key::id, cause.id},
          {key::group, code_of(cause.group)},
          {key::target, place_json(cause.place)},
          {key::p_value, cause.p_value},
          {key::probability, cause.probability},
          {key::standing, code_of(standing_of(cause, explanation))},
          {key::amplitude, amplitude_json(cause.amplitude)},
          {key::nuisance, std::move(nuisance)},
          {key::retained_fraction, std::min(1.0, cause.retained)},
          {key::gain, cause.gain},
          {key::parameter_shifts, std::move(shifts)},
          {key::claim, "consistent_with"},
          {key::explanation, cause.explanation}};
}

json gain_json(const Gain& gain) {
  json held_out = json::array();
  for (const HeldOut& block : gain.held_out)
    held_out.push_back({{key::block, block.block},
                        {key::rows, block.rows},
                        {key::before, block.before},
                        {key::after, block.after},
                        {key::p_value, block.p_value},
                        {key::verdict, code_of(block.verdict)}});
  json best_rejected = nullptr;
  if (gain.best_rejected)
    best_rejected = {{key::id, gain.best_rejected->id}, {key::in_sample, gain.before - gain.best_rejected->after}};
  return {{key::in_sample, gain.before - gain.after},
          {key::before, gain.before},
          {key::after, gain.after},
          {key::expected_under_nothing, gain.expected_under_nothing},
          {key::held_out, std::move(held_out)},
          {key::best_wrong, std::move(best_rejected)}};
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
    all.push_back({{key::test, one.test},
                   {key::channel, one.channel},
                   {key::where, one.where},
                   {key::from, one.from},
                   {key::to, one.to},
                   {key::p_value, one.p_value}});
  return all;
}

json detectable_json(const std::vector<Detectable>& detectable) {
  json all = json::array();
  for (const Detectable& one : detectable)
    all.push_back({{key::id, one.id},
                   {key::detectable, finite(one.detectable)},
                   {key::identifiable, finite(one.identifiable)},
                   {key::null, one.null},
                   {key::reach, finite(one.reach)},
                   {key::unit, one.unit},
                   {key::target, place_json(one.place)},
                   {key::retained_fraction, std::min(1.0, one.retained)},
                   {key::closest, one.closest.empty() ? json(nullptr) : json(one.closest)},
                   {key::correlation, one.correlation},
                   {key::absent, one.absent.empty() ? json(nullptr) : json(one.absent)},
                   {key::absence, code_of(one.absence)}});
  return all;
}

json ranking_json(const std::vector<RankedMechanism>& ranking) {
  json all = json::array();
  for (const RankedMechanism& one : ranking)
    all.push_back({{key::id, one.id},
                   {key::group, code_of(one.group)},
                   {key::target, place_json(one.place)},
                   {key::probability, one.probability},
                   {key::score, one.score},
                   {key::gain, or_null(one.gain)}});
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
    all.push_back({{key::id, hypotheses.candidates[c].id},
                   {key::group, code_of(group_of(*hypotheses.candidates[c].mechanism))},
                   {key::p_value, detection.by_candidate[c]},
                   {key::target, place_json(hypotheses.hypothesis(direction).addition.place)},
                   {key::score, score(direction, -analysis.evidence.fit.residuals).T}});
  }
  return all;
}

json confusable_json(const std::vector<Candidate>& candidates, const Eigen::MatrixXd& alike) {
  json all = json::array();
  for (std::size_t a = 0; a < candidates.size(); ++a)
    for (std::size_t b = a + 1; b < candidates.size(); ++b) {
      const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
      if (const double c = std::max(alike(i, j), alike(j, i)); c > look_alike)
        all.push_back({{key::id, candidates[a].id}, {key::with, candidates[b].id}, {key::correlation, c}});
    }
  return all;
}

json noise_json(const std::vector<NoiseSource>& sources) {
  json all = json::array();
  for (const NoiseSource& source : sources)
    all.push_back({{key::test, source.test},
                   {key::channel, source.channel},
                   {key::unit, source.unit},
                   {key::source, code_of(source.kind)},
                   {key::absolute, source.noise.absolute},
                   {key::relative, source.noise.relative},
                   {key::correlation, source.noise.correlation},
                   {key::freedom, source.freedom > 0 ? json(source.freedom) : json(nullptr)},
                   {key::neighbours, source.neighbours > 0 ? json(source.neighbours) : json(nullptr)}});
  return all;
}

json base_json(const Evidence& evidence) {
  json parameters = json::object();
  for (std::size_t j = 0; j < evidence.base->layout().parameters.size(); ++j) {
    const auto& parameter = evidence.base->layout().parameters[j];
    parameters[parameter.name] = {{key::value, evidence.fit.free[j]}, {key::unit, parameter.unit}};
  }
  const assembly::Misfit misfit = stated_misfit(evidence);
  return {{key::model, evidence.base->models().name(0)},
          {key::misfit, misfit.judged() ? comparison::misfit_json(misfit) : json(nullptr)},
          {key::parameters, std::move(parameters)},
          {key::squares, evidence.fit.chi2},
          {key::rows, evidence.fit.residuals.size()}};
}

json extension_json(const Explanation& explanation) {
  json mechanisms = json::array();
  for (const Addition& addition : explanation.claim.best->additions)
    mechanisms.push_back(
        {{key::type, addition.id}, {key::as, addition.name()}, {key::target, place_json(addition.place)}});
  for (const Cause& row : explanation.left_out)
    mechanisms.push_back({{key::type, row.id}, {key::target, place_json(row.place)}});
  return {{key::mechanisms, std::move(mechanisms)}, {key::experiment, "extended.json"}};
}

json admissibility_json(const Admissibility& admissibility) {
  return {{key::stable, or_null(admissibility.stable)},
          {key::where, admissibility.where.empty() ? json(nullptr) : json(admissibility.where)},
          {key::remedy, admissibility.remedy.empty() ? json(nullptr) : json(admissibility.remedy)}};
}

json file_json(const FileFindings& file) {
  json causes = json::array();
  for (const FileCause& cause : file.causes) {
    causes.push_back({{key::kind, code_of(cause.kind)},
                      {key::tests, cause.tests},
                      {key::sentence, cause.sentence},
                      {key::mend, cause.mend},
                      {key::squares, cause.squares},
                      {key::p_after, cause.p_after},
                      {key::probability, cause.probability},
                      {key::near, cause.near}});
    for (const Change& change : cause.changes)
      causes.back()[key::changes].push_back(
          {{key::op, "add"}, {key::path, change.path}, {key::value, json::parse(change.value)}});
    if (cause.mechanism.empty()) continue;
    causes.back()[key::mechanism] = cause.mechanism;
    for (const Amplitude& amplitude : cause.amplitudes) causes.back()[key::amplitudes].push_back(amplitude.value);
  }
  json suspect = json::array();
  for (const Suspect& one : file.suspect) suspect.push_back({{key::code, one.code}, {key::text, one.text}});
  return {{key::suspect, std::move(suspect)},   {key::standing, code_of(file.standing)},
          {key::wrong_files, file.wrong_files}, {key::tried, file.tried},
          {key::lead, or_null(file.lead)},      {key::causes, std::move(causes)},
          {key::untellable, file.untellable}};
}

json gross_json(const std::vector<GrossRow>& gross) {
  json rows = json::array();
  for (const GrossRow& row : gross)
    rows.push_back(
        {{key::test, row.test}, {key::channel, row.channel}, {key::row, row.file_row}, {key::residual, row.residual}});
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
  json result = {{key::test, place.tests.size() == 1 ? json(place.tests.front()) : json(nullptr)},
                 {key::channel, place.channel.empty() ? json(nullptr) : json(place.channel)}};
  if (place.tests.size() > 1) result[key::tests] = place.tests;
  if (place.row) result[key::row] = place.file_row;
  if (!place.model.empty()) result[key::model] = place.model;
  return result;
}

json warning_details(const std::vector<Warning>& warnings) {
  json all = json::array();
  for (const Warning& warning : warnings)
    all.push_back({{key::kind, code_of(warning.kind)},
                   {key::run, nullptr},
                   {key::subjects, json::array()},
                   {key::sentence, warning.text}});
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
  json result = {{key::verdict, code_of(explanation.verdict)},
                 {key::reasons, texts(explanation.reasons)},
                 {key::reason_codes, codes(explanation.reasons)},
                 {key::alpha, d.request.alpha},
                 {key::p_value, alarm.p()},
                 {key::p_smooth, alarm.detection.smooth},
                 {key::p_mechanisms, alarm.detection.mechanisms},
                 {key::misfit, misfit_json(explanation.misfit)},
                 {key::causes, std::move(causes)},
                 {key::ambiguity_set, claim.ambiguity_set},
                 {key::alternatives, std::move(alternatives)},
                 {key::admissibility, admissibility_json(explanation.admissibility)},
                 {key::detectable, detectable_json(d.prospects.detectable)},
                 {key::base, base_json(evidence)},
                 {key::noise, noise_json(evidence.noise)},
                 {key::scores, scores_json(analysis)},
                 {key::ranking, ranking_json(explanation.ranking)},
                 {key::confusable, confusable_json(analysis.hypotheses.candidates,
                                                   likeness(analysis.hypotheses, explanation.best_direction))}};
  if (alarm.p_is_bound()) result[key::p_value_is_bound] = true;
  if (explanation.file.wrong_files > 0) result[key::file] = file_json(explanation.file);
  if (claim.best) result[key::extension] = extension_json(explanation);
  if (d.prospects.gain) result[key::gain] = gain_json(*d.prospects.gain);
  if (!evidence.gross.empty()) result[key::left_out] = gross_json(evidence.gross);
  if (!claim.look_alikes.empty()) result[key::look_alikes] = claim.look_alikes;
  if (!claim.causes.empty() || !claim.in_words.empty()) result[key::explanations] = explanations(claim);
  if (explanation.unlisted) result[key::unlisted] = true;
  if (claim.best) {
    result[key::p_after] = explanation.p_after;
    result[key::remainder] = is_clean(explanation.p_after) ? "clean" : "not_clean";
  }
  if (alarm.factor) result[key::alarm_factor] = *alarm.factor;
  if (explanation.noise_factor) result[key::noise_factor] = *explanation.noise_factor;
  if (const auto& next = d.prospects.next)
    result[key::next_experiment] = {{key::description, next->description},
                                    {key::separates, next->separates},
                                    {key::repeats, or_null(next->repeats)}};
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
      {key::format, 1},
      {key::name, experiment.name},
      {key::warnings, texts(warnings)},
      {key::warning_details, warning_details(warnings)},
      {key::ranking, json::array()},
      {key::identifiability, json::array()},
      {key::runs, json::array()},
      {key::diagnosis, diagnosis_json(d)},
      {key::provenance, comparison::provenance_json(comparison::provenance_of(
                            experiment, {plugins.begin(), plugins.end()}, evidence.base->layout().data_hashes))}};
  document.update(more);
  document[key::diagnosis].update(of_diagnosis);
  return document.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace tunica::diagnosis
