// SPDX-License-Identifier: Apache-2.0
#include "comparison/result_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "comparison/hold_out.hpp"
#include "comparison/ranking.hpp"
#include "comparison/stability_report.hpp"

namespace tunica::comparison {

namespace {

using json = nlohmann::ordered_json;

template <class Value>
json or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

json interval(const std::optional<Interval>& value) {
  return value ? json::array({value->first, value->second}) : json(nullptr);
}

json statistics(const SampleStatistics& sample) {
  if (sample.count == 0) return {{"count", 0}, {"mean", nullptr}, {"sd", nullptr}, {"ci95", nullptr}};
  return {{"count", sample.count},         {"mean", sample.mean},     {"sd", or_null(sample.sd)},
          {"ci95", interval(sample.ci95)}, {"min", sample.box->min},  {"q1", sample.box->lower},
          {"median", sample.box->median},  {"q3", sample.box->upper}, {"max", sample.box->max}};
}

/// What the bound is that a parameter lies at.
const char* bound_kind(const Estimate& estimate) {
  switch (estimate.at_bound == Estimate::Bound::upper ? estimate.upper_kind : estimate.lower_kind) {
    case assembly::FreeParameter::Bound::chosen:
      return "chosen";
    case assembly::FreeParameter::Bound::by_default:
      return "default";
    case assembly::FreeParameter::Bound::symmetry:
      return "symmetry";
    case assembly::FreeParameter::Bound::physical:
      return "physical";
  }
  return "";
}

const char* word(Estimate::Bound bound) { return bound == Estimate::Bound::lower ? "lower" : "upper"; }

json certificate(const Certificate& certificate) {
  json spread = json::object(), fresh = nullptr, neighbours = nullptr;
  for (const auto& parameter : certificate.spread)
    spread[parameter.name] = {
        {"min", parameter.min}, {"max", parameter.max}, {"unit", parameter.unit}, {"share_of_bounds", parameter.share}};
  if (certificate.fresh) {
    const auto& around = certificate.fresh->around;
    const bool evaluated = around.status.kind() != Status::Kind::failed;
    fresh = {{"status", name(around.status.kind())},
             {"objective", evaluated ? json(around.objective) : json(nullptr)},
             {"difference", evaluated ? json(certificate.fresh->difference) : json(nullptr)},
             {"identical", certificate.fresh->identical}};
    neighbours = {{"evaluated", around.evaluated},
                  {"infeasible", around.infeasible},
                  {"failed", around.failed},
                  {"better", around.better},
                  {"lowest", nullptr}};
    if (around.lowest)
      neighbours["lowest"] = {
          {"objective", around.lowest->objective}, {"along", around.lowest->along}, {"step", around.lowest->step}};
  }
  return {{"verdict", certificate.sentence},
          {"verdict_code", text::code_of(certificate_codes, certificate.verdict)},
          {"fresh_process", std::move(fresh)},
          {"neighbours", std::move(neighbours)},
          {"realisations",
           {{"agree", certificate.agreeing}, {"of", certificate.realisations}, {"spread", std::move(spread)}}},
          {"at_bounds", certificate.at_bounds},
          {"constraints",
           {{"count", certificate.fresh ? certificate.fresh->around.constraints : 0},
            {"active", certificate.fresh ? certificate.fresh->around.active_constraints : 0}}}};
}

json hold_out(const std::vector<Quality>& quality) {
  json all = json::array();
  for (const Transfer& transfer : transfers(quality))
    all.push_back({{"channel", transfer.channel},
                   {"unit", transfer.unit},
                   {"in_sample", transfer.in_sample},
                   {"held_out", transfer.held_out},
                   {"worst", transfer.worst->test},
                   {"verdict", text::code_of(hold_out_codes, transfer.verdict)}});
  return all;
}

const char* word(Information::Noise noise) {
  switch (noise) {
    case Information::Noise::stated:
      return "stated";
    case Information::Noise::estimated:
      return "estimated";
    case Information::Noise::mixed:
      return "mixed";
  }
  return "";
}

json misfit(const std::optional<assembly::Misfit>& found) { return found ? misfit_json(*found) : json(nullptr); }

json noise(const std::vector<NoiseOf>& channels) {
  json all = json::array();
  for (const NoiseOf& one : channels)
    all.push_back({{"test", one.test},
                   {"channel", one.channel},
                   {"sd", one.sd},
                   {"unit", one.unit},
                   {"origin", text::code_of(assembly::noise_origin_codes, one.origin)}});
  return all;
}

json matrix(const std::vector<double>& values, std::size_t size) {
  json rows = json::array();
  for (std::size_t row = 0; row < size; ++row) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * size);
    rows.push_back(std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(size)));
  }
  return rows;
}

json covariance(const ParameterCovariance& found) {
  const std::size_t n = found.parameters.size();
  if (n == 0) return nullptr;
  json names = json::array(), units = json::array(), scales = json::array();
  for (const auto& parameter : found.parameters) {
    names.push_back(parameter.name);
    units.push_back(parameter.unit);
    scales.push_back(parameter.scale == Scale::log ? "log" : "linear");
  }
  std::vector<double> correlation = found.search;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      correlation[i * n + j] =
          i == j ? 1 : found.search[i * n + j] / std::sqrt(found.search[i * n + i] * found.search[j * n + j]);
  return {{"parameters", std::move(names)},
          {"units", std::move(units)},
          {"values", matrix(found.values, n)},
          {"correlation", matrix(correlation, n)},
          {"search", {{"scales", std::move(scales)}, {"values", matrix(found.search, n)}}}};
}

/// Beyond noise: of all rows as a share of the range, and of each channel in its unit.
json misfit_size(const RunSummary& run) {
  if (!run.size) return nullptr;
  return {{"rms", run.size->rms},
          {"rms_upper", run.size->upper},
          {"tolerance", or_null(run.tolerance)},
          {"adequate", run.tolerance ? json(run.size->upper <= *run.tolerance) : json(nullptr)},
          {"channels", channel_sizes_json(run.sizes)}};
}

json posterior_of(const PosteriorMarginal& found) {
  const auto judged = [](double value) { return std::isfinite(value) ? json(value) : json(nullptr); };
  return {{"mean", found.mean},
          {"sd", found.sd},
          {"median", found.median},
          {"r_hat", judged(found.r_hat)},
          {"ess_bulk", judged(found.bulk)},
          {"ess_tail", judged(found.tail)}};
}

json posterior_of(const PosteriorSummary& found) {
  json made{{"file", found.file},
            {"chains", found.chains},
            {"draws", found.draws},
            {"warm_up", found.warm_up},
            {"simulations", found.evaluations},
            {"failed", found.failures},
            {"acceptance", found.acceptance},
            {"r_hat", found.r_hat},
            {"ess", found.effective_size},
            {"converged", found.converged},
            {"noise_known", found.factor_known},
            {"held_out", {{"rows", found.held_out_rows}, {"inside", found.held_out_inside}}}};
  if (const auto& misfit = found.discrepancy)
    made["discrepancy"] = {
        {"ci95", {misfit->lower, misfit->upper}}, {"median", misfit->median}, {"none", misfit->none}};
  return made;
}

json best(const RunSummary& run) {
  json parameters = json::object();
  for (const auto& parameter : run.parameters) {
    json& entry = parameters[parameter.name];
    entry = {{"value", parameter.value},
             {"unit", parameter.unit},
             {"ci95", interval(parameter.ci95)},
             {"ci95_reliable", parameter.ci95 ? json(parameter.straight) : json(nullptr)},
             {"at_bound", parameter.at_bound == Estimate::Bound::none ? json(nullptr) : json(word(parameter.at_bound))},
             {"bound_kind", parameter.at_bound == Estimate::Bound::none ? json(nullptr) : json(bound_kind(parameter))},
             {"min", parameter.min},
             {"max", parameter.max}};
    if (parameter.profile)
      entry["profile_ci95"] = {or_null(parameter.profile->lower), or_null(parameter.profile->upper)};
    if (parameter.mesh_bias) entry["mesh_bias"] = *parameter.mesh_bias;
    if (const auto& difference = parameter.difference)
      entry["difference"] = {{"state", difference->state},
                             {"from", difference->from},
                             {"value", difference->value},
                             {"ci95", interval(difference->ci95)}};
    if (run.bootstrap) entry["bootstrap_ci95"] = interval(parameter.bootstrap);
    if (parameter.posterior) {
      entry["posterior_ci95"] = {parameter.posterior->lower, parameter.posterior->upper};
      entry["posterior"] = posterior_of(*parameter.posterior);
    }
  }
  json per_test = json::object();
  for (std::size_t test = 0; test < run.tests.size(); ++test) {
    json channels = json::array();
    for (const auto& quality : run.quality)
      if (quality.test == run.tests[test])
        channels.push_back({{"channel", quality.channel},
                            {"over", quality.over},
                            {"held_out", quality.held_out},
                            {"rows", quality.agreement.rows},
                            {"unit", quality.unit},
                            {"rmse", quality.agreement.rmse},
                            {"r2", or_null(quality.agreement.r2)},
                            {"nmad", or_null(quality.agreement.nmad)}});
    per_test[run.tests[test]] = {{"cost", test < run.per_test.size() ? json(run.per_test[test]) : json(nullptr)},
                                 {"channels", std::move(channels)}};
  }
  json result = {{"parameters", std::move(parameters)},
                 {"objective", run.objective},
                 {"per_test", std::move(per_test)},
                 {"stable", run.stability ? or_null(run.stability->transversely_stable()) : json(nullptr)},
                 {"status", name(run.status.kind())},
                 {"reason", run.status.reason()},
                 {"stability", stability_json(run)},
                 {"realisation", run.best_realisation},
                 {"evaluation", run.best_id}};
  result["covariance"] = covariance(run.covariance);
  result["aicc"] = run.information ? or_null(run.information->aicc) : json(nullptr);
  result["bic"] = run.information ? json(run.information->bic) : json(nullptr);
  result["noise"] = run.information ? json(word(run.information->noise)) : json(nullptr);
  result["channel_noise"] = noise(run.noise);
  result["misfit"] = misfit(run.misfit);
  result["misfit_estimated"] = misfit(run.misfit_estimated);
  result["misfit_size"] = misfit_size(run);
  result["interval_factor"] = run.misfit && run.misfit->contradicts() ? run.misfit->times() : 1.0;
  result["intervals_withheld"] = run.withheld.empty() ? json(nullptr) : json(run.withheld);
  if (!run.notes.empty()) result["notes"] = run.notes;
  result["certificate"] = certificate(run.certificate);
  result["hold_out"] = hold_out(run.quality);
  if (!run.identifiability.empty()) result["identifiability"] = run.identifiability;
  if (!run.uncertainty.empty()) result["uncertainty"] = run.uncertainty;
  if (run.bootstrap) result["bootstrap"] = {{"draws", run.bootstrap->made}, {"failed", run.bootstrap->failed}};
  if (run.posterior) result["posterior"] = posterior_of(*run.posterior);
  return result;
}

json run_json(const RunSummary& run) {
  json fixed = json::object();
  for (const auto& parameter : run.fixed)
    fixed[parameter.name] = {{"value", parameter.value}, {"unit", parameter.unit}};
  json over_parameters = json::object();
  for (const auto& parameter : run.parameters)
    over_parameters[parameter.name] = statistics(parameter.over_realisations);
  json over_realisations = statistics(run.objectives);
  over_realisations["success_rate"] = run.success_rate;
  over_realisations["successes"] = run.successes;
  over_realisations["success_ci95"] = {run.success_ci95.first, run.success_ci95.second};
  over_realisations["success_threshold"] = run.has_result ? json(run.threshold) : json(nullptr);
  over_realisations["evaluations_to_target"] = statistics(run.evaluations_to_target);
  over_realisations["expected_running_time"] = or_null(run.expected_running_time);
  over_realisations["evaluations"] = statistics(run.evaluations_spent);
  over_realisations["seconds"] = statistics(run.seconds_spent);
  over_realisations["parameters"] = std::move(over_parameters);
  json counted = json::object();
  for (const auto& [test, efforts] : run.efforts)
    for (const Effort& effort : efforts) counted[test][effort.name] = effort.count;
  json document = {
      {"run", run.label},
      {"model", run.model},
      {"optimizer", run.optimizer},
      {"tests", run.tests},
      {"objective_type", run.objective_type},
      {"differs_by", run.differs},
      {"paired_with", run.paired_starts ? json(run.paired_with) : json(nullptr)},
      {"realisations", run.realisations},
      {"best", run.has_result ? best(run) : json(nullptr)},
      {"fixed", std::move(fixed)},
      {"statistics", std::move(over_realisations)},
      {"evaluations", run.evaluations},
      {"jacobians", run.jacobians},
      {"failures", run.failures},
      {"infeasible", run.infeasible},
      {"first_failure", run.first_failure.empty() ? json(nullptr) : json(run.first_failure)},
      {"converged", run.converged && succeeded(ending_of(run)) && ending_of(run) != Ending::misses &&
                        ending_of(run) != Ending::short_of_optimum},
      {"ending", words_on_ending(run)},
      {"ending_code", text::code_of(ending_codes, ending_of(run))},
      {"limit", run.limit ? json{{"key", run.limit->key}, {"value", run.limit->value}} : json(nullptr)},
      {"ended_by", run.stop_sentence.empty() ? run.reason : run.stop_sentence},
      {"stop_reason", run.stopped_by == search::StopReason::none ? json(nullptr) : json(search::code(run.stopped_by))},
      {"seconds", run.seconds}};
  if (run.has_costly_tests)
    document["full_simulations"] = {
        {"count", run.simulated}, {"ended_early", run.ended_early}, {"guide_evaluations", run.guide_evaluations}};
  if (!counted.empty()) document["efforts"] = std::move(counted);
  return document;
}

}  // namespace

nlohmann::ordered_json channel_sizes_json(const std::vector<assembly::ChannelSize>& sizes) {
  json all = json::array();
  for (const assembly::ChannelSize& one : sizes)
    all.push_back({{"test", one.test},
                   {"channel", one.channel},
                   {"unit", one.unit},
                   {"range", one.range},
                   {"rms", one.rms},
                   {"rms_upper", one.upper},
                   {"rows", one.rows}});
  return all;
}

json misfit_json(const assembly::Misfit& misfit) {
  return {{"chi_square", misfit.chi_square},           {"rows", misfit.rows},
          {"degrees_of_freedom", misfit.freedom},      {"reduced_chi_square", misfit.per_freedom()},
          {"times_the_noise", misfit.times()},         {"chance", misfit.chance},
          {"contradicts_noise", misfit.contradicts()}, {"small_but_real", misfit.small_but_real()}};
}

json warning_json(const execution::Warning& warning) {
  return {{"kind", execution::code(warning.kind)},
          {"run", warning.run.empty() ? json(nullptr) : json(warning.run)},
          {"subjects", warning.subjects},
          {"sentence", warning.sentence}};
}

std::string result_json(const Summary& summary, const Provenance& provenance) {
  json runs = json::array(), ranking = json::array();
  for (const auto& run : summary.runs) runs.push_back(run_json(run));
  for (const auto& entry : summary.ranking) {
    const auto& run = summary.runs[entry.run];
    ranking.push_back({{"rank", or_null(entry.rank)},
                       {"run", run.label},
                       {"group", run.group},
                       {"objective", run.has_result ? json(run.objective) : json(nullptr)},
                       {"delta_aicc", or_null(entry.delta_aicc)},
                       {"successes", run.successes},
                       {"expected_running_time", or_null(run.expected_running_time)},
                       {"cost", or_null(run.cost())},
                       {"failures", run.failures},
                       {"reason", reason_of_rank(run)}});
  }
  json warnings = json::array(), details = json::array();
  for (const auto& warning : summary.warnings) {
    warnings.push_back(warning.text());
    details.push_back(warning_json(warning));
  }
  const json document = {{"format", 1},
                         {"name", summary.name},
                         {"warnings", std::move(warnings)},
                         {"warning_details", std::move(details)},
                         {"ranking", std::move(ranking)},
                         {"identifiability", summary.identifiability},
                         {"runs", std::move(runs)},
                         {"provenance", provenance_json(provenance)}};
  return document.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace tunica::comparison
