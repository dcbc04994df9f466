// SPDX-License-Identifier: Apache-2.0
#include "comparison/result_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "comparison/hold_out.hpp"
#include "comparison/ranking.hpp"
#include "comparison/stability_report.hpp"
#include "results/keys.hpp"

namespace tunica::comparison {

namespace key = results::key;

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
  if (sample.count == 0) return {{key::count, 0}, {key::mean, nullptr}, {key::sd, nullptr}, {key::ci95, nullptr}};
  return {{key::count, sample.count},         {key::mean, sample.mean},     {key::sd, or_null(sample.sd)},
          {key::ci95, interval(sample.ci95)}, {key::min, sample.box->min},  {key::q1, sample.box->lower},
          {key::median, sample.box->median},  {key::q3, sample.box->upper}, {key::max, sample.box->max}};
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
    spread[parameter.name] = {{key::min, parameter.min},
                              {key::max, parameter.max},
                              {key::unit, parameter.unit},
                              {key::share_of_bounds, parameter.share}};
  if (certificate.fresh) {
    const auto& around = certificate.fresh->around;
    const bool evaluated = around.status.kind() != Status::Kind::failed;
    fresh = {{key::status, name(around.status.kind())},
             {key::objective, evaluated ? json(around.objective) : json(nullptr)},
             {key::difference, evaluated ? json(certificate.fresh->difference) : json(nullptr)},
             {key::identical, certificate.fresh->identical}};
    neighbours = {{key::evaluated, around.evaluated},
                  {key::infeasible, around.infeasible},
                  {key::failed, around.failed},
                  {key::better, around.better},
                  {key::lowest, nullptr}};
    if (around.lowest)
      neighbours[key::lowest] = {{key::objective, around.lowest->objective},
                                 {key::along, around.lowest->along},
                                 {key::step, around.lowest->step}};
  }
  return {{key::verdict, certificate.sentence},
          {key::verdict_code, text::code_of(certificate_codes, certificate.verdict)},
          {key::fresh_process, std::move(fresh)},
          {key::neighbours, std::move(neighbours)},
          {key::realisations,
           {{key::agree, certificate.agreeing}, {key::of, certificate.realisations}, {key::spread, std::move(spread)}}},
          {key::at_bounds, certificate.at_bounds},
          {key::constraints,
           {{key::count, certificate.fresh ? certificate.fresh->around.constraints : 0},
            {key::active, certificate.fresh ? certificate.fresh->around.active_constraints : 0}}}};
}

json hold_out(const std::vector<Quality>& quality) {
  json all = json::array();
  for (const Transfer& transfer : transfers(quality))
    all.push_back({{key::channel, transfer.channel},
                   {key::unit, transfer.unit},
                   {key::in_sample, transfer.in_sample},
                   {key::held_out, transfer.held_out},
                   {key::worst, transfer.worst->test},
                   {key::verdict, text::code_of(hold_out_codes, transfer.verdict)}});
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
    all.push_back({{key::test, one.test},
                   {key::channel, one.channel},
                   {key::sd, one.sd},
                   {key::unit, one.unit},
                   {key::origin, text::code_of(assembly::noise_origin_codes, one.origin)}});
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
  return {{key::parameters, std::move(names)},
          {key::units, std::move(units)},
          {key::values, matrix(found.values, n)},
          {key::correlation, matrix(correlation, n)},
          {key::search, {{key::scales, std::move(scales)}, {key::values, matrix(found.search, n)}}}};
}

/// Beyond noise: of all rows as a share of the range, and of each channel in its unit.
json misfit_size(const RunSummary& run) {
  if (!run.size) return nullptr;
  return {{key::rms, run.size->rms},
          {key::rms_upper, run.size->upper},
          {key::tolerance, or_null(run.tolerance)},
          {key::adequate, run.tolerance ? json(run.size->upper <= *run.tolerance) : json(nullptr)},
          {key::channels, channel_sizes_json(run.sizes)}};
}

json posterior_of(const PosteriorMarginal& found) {
  const auto judged = [](double value) { return std::isfinite(value) ? json(value) : json(nullptr); };
  return {{key::mean, found.mean},
          {key::sd, found.sd},
          {key::median, found.median},
          {key::r_hat, judged(found.r_hat)},
          {key::ess_bulk, judged(found.bulk)},
          {key::ess_tail, judged(found.tail)}};
}

json posterior_of(const PosteriorSummary& found) {
  json made{{key::file, found.file},
            {key::chains, found.chains},
            {key::draws, found.draws},
            {key::warm_up, found.warm_up},
            {key::simulations, found.evaluations},
            {key::failed, found.failures},
            {key::acceptance, found.acceptance},
            {key::r_hat, found.r_hat},
            {key::ess, found.effective_size},
            {key::converged, found.converged},
            {key::noise_known, found.factor_known},
            {key::held_out, {{key::rows, found.held_out_rows}, {key::inside, found.held_out_inside}}}};
  if (const auto& misfit = found.discrepancy)
    made[key::discrepancy] = {
        {key::ci95, {misfit->lower, misfit->upper}}, {key::median, misfit->median}, {key::none, misfit->none}};
  return made;
}

json best(const RunSummary& run) {
  json parameters = json::object();
  for (const auto& parameter : run.parameters) {
    json& entry = parameters[parameter.name];
    entry = {
        {key::value, parameter.value},
        {key::unit, parameter.unit},
        {key::ci95, interval(parameter.ci95)},
        {key::ci95_reliable, parameter.ci95 ? json(parameter.straight) : json(nullptr)},
        {key::at_bound, parameter.at_bound == Estimate::Bound::none ? json(nullptr) : json(word(parameter.at_bound))},
        {key::bound_kind, parameter.at_bound == Estimate::Bound::none ? json(nullptr) : json(bound_kind(parameter))},
        {key::min, parameter.min},
        {key::max, parameter.max}};
    if (parameter.profile)
      entry[key::profile_ci95] = {or_null(parameter.profile->lower), or_null(parameter.profile->upper)};
    if (parameter.mesh_bias) entry[key::mesh_bias] = *parameter.mesh_bias;
    if (const auto& difference = parameter.difference)
      entry[key::difference] = {{key::state, difference->state},
                                {key::from, difference->from},
                                {key::value, difference->value},
                                {key::ci95, interval(difference->ci95)}};
    if (run.bootstrap) entry[key::bootstrap_ci95] = interval(parameter.bootstrap);
    if (parameter.posterior) {
      entry[key::posterior_ci95] = {parameter.posterior->lower, parameter.posterior->upper};
      entry[key::posterior] = posterior_of(*parameter.posterior);
    }
  }
  json per_test = json::object();
  for (std::size_t test = 0; test < run.tests.size(); ++test) {
    json channels = json::array();
    for (const auto& quality : run.quality)
      if (quality.test == run.tests[test])
        channels.push_back({{key::channel, quality.channel},
                            {key::over, quality.over},
                            {key::held_out, quality.held_out},
                            {key::rows, quality.agreement.rows},
                            {key::unit, quality.unit},
                            {key::rmse, quality.agreement.rmse},
                            {key::r2, or_null(quality.agreement.r2)},
                            {key::nmad, or_null(quality.agreement.nmad)}});
    per_test[run.tests[test]] = {{key::cost, test < run.per_test.size() ? json(run.per_test[test]) : json(nullptr)},
                                 {key::channels, std::move(channels)}};
  }
  json result = {{key::parameters, std::move(parameters)},
                 {key::objective, run.objective},
                 {key::per_test, std::move(per_test)},
                 {key::stable, run.stability ? or_null(run.stability->transversely_stable()) : json(nullptr)},
                 {key::status, name(run.status.kind())},
                 {key::reason, run.status.reason()},
                 {key::stability, stability_json(run)},
                 {key::realisation, run.best_realisation},
                 {key::evaluation, run.best_id}};
  result[key::covariance] = covariance(run.covariance);
  result[key::aicc] = run.information ? or_null(run.information->aicc) : json(nullptr);
  result[key::bic] = run.information ? json(run.information->bic) : json(nullptr);
  result[key::noise] = run.information ? json(word(run.information->noise)) : json(nullptr);
  result[key::channel_noise] = noise(run.noise);
  result[key::misfit] = misfit(run.misfit);
  result[key::misfit_estimated] = misfit(run.misfit_estimated);
  result[key::misfit_size] = misfit_size(run);
  result[key::interval_factor] = run.misfit && run.misfit->contradicts() ? run.misfit->times() : 1.0;
  result[key::intervals_withheld] = run.withheld.empty() ? json(nullptr) : json(run.withheld);
  if (!run.notes.empty()) result[key::notes] = run.notes;
  result[key::certificate] = certificate(run.certificate);
  result[key::hold_out] = hold_out(run.quality);
  if (!run.identifiability.empty()) result[key::identifiability] = run.identifiability;
  if (!run.uncertainty.empty()) result[key::uncertainty] = run.uncertainty;
  if (run.bootstrap) result[key::bootstrap] = {{key::draws, run.bootstrap->made}, {key::failed, run.bootstrap->failed}};
  if (run.posterior) result[key::posterior] = posterior_of(*run.posterior);
  return result;
}

json run_json(const RunSummary& run) {
  json fixed = json::object();
  for (const auto& parameter : run.fixed)
    fixed[parameter.name] = {{key::value, parameter.value}, {key::unit, parameter.unit}};
  json over_parameters = json::object();
  for (const auto& parameter : run.parameters)
    over_parameters[parameter.name] = statistics(parameter.over_realisations);
  json over_realisations = statistics(run.objectives);
  over_realisations[key::success_rate] = run.success_rate;
  over_realisations[key::successes] = run.successes;
  over_realisations[key::success_ci95] = {run.success_ci95.first, run.success_ci95.second};
  over_realisations[key::success_threshold] = run.has_result ? json(run.threshold) : json(nullptr);
  over_realisations[key::evaluations_to_target] = statistics(run.evaluations_to_target);
  over_realisations[key::expected_running_time] = or_null(run.expected_running_time);
  over_realisations[key::evaluations] = statistics(run.evaluations_spent);
  over_realisations[key::seconds] = statistics(run.seconds_spent);
  over_realisations[key::parameters] = std::move(over_parameters);
  json counted = json::object();
  for (const auto& [test, efforts] : run.efforts)
    for (const Effort& effort : efforts) counted[test][effort.name] = effort.count;
  json document = {
      {key::run, run.label},
      {key::model, run.model},
      {key::optimizer, run.optimizer},
      {key::tests, run.tests},
      {key::objective_type, run.objective_type},
      {key::differs_by, run.differs},
      {key::paired_with, run.paired_starts ? json(run.paired_with) : json(nullptr)},
      {key::realisations, run.realisations},
      {key::best, run.has_result ? best(run) : json(nullptr)},
      {key::fixed, std::move(fixed)},
      {key::statistics, std::move(over_realisations)},
      {key::evaluations, run.evaluations},
      {key::jacobians, run.jacobians},
      {key::failures, run.failures},
      {key::infeasible, run.infeasible},
      {key::first_failure, run.first_failure.empty() ? json(nullptr) : json(run.first_failure)},
      {key::converged, run.converged && succeeded(ending_of(run)) && ending_of(run) != Ending::misses &&
                           ending_of(run) != Ending::short_of_optimum},
      {key::ending, words_on_ending(run)},
      {key::ending_code, text::code_of(ending_codes, ending_of(run))},
      {key::limit, run.limit ? json{{key::key, run.limit->key}, {key::value, run.limit->value}} : json(nullptr)},
      {key::ended_by, run.stop_sentence.empty() ? run.reason : run.stop_sentence},
      {key::stop_reason,
       run.stopped_by == search::StopReason::none ? json(nullptr) : json(search::code(run.stopped_by))},
      {key::seconds, run.seconds}};
  if (run.has_costly_tests)
    document[key::full_simulations] = {{key::count, run.simulated},
                                       {key::ended_early, run.ended_early},
                                       {key::guide_evaluations, run.guide_evaluations}};
  if (!counted.empty()) document[key::efforts] = std::move(counted);
  return document;
}

}  // namespace

nlohmann::ordered_json channel_sizes_json(const std::vector<assembly::ChannelSize>& sizes) {
  json all = json::array();
  for (const assembly::ChannelSize& one : sizes)
    all.push_back({{key::test, one.test},
                   {key::channel, one.channel},
                   {key::unit, one.unit},
                   {key::range, one.range},
                   {key::rms, one.rms},
                   {key::rms_upper, one.upper},
                   {key::rows, one.rows}});
  return all;
}

json misfit_json(const assembly::Misfit& misfit) {
  return {{key::chi_square, misfit.chi_square},           {key::rows, misfit.rows},
          {key::degrees_of_freedom, misfit.freedom},      {key::reduced_chi_square, misfit.per_freedom()},
          {key::times_the_noise, misfit.times()},         {key::chance, misfit.chance},
          {key::contradicts_noise, misfit.contradicts()}, {key::small_but_real, misfit.small_but_real()}};
}

json warning_json(const execution::Warning& warning) {
  return {{key::kind, execution::code(warning.kind)},
          {key::run, warning.run.empty() ? json(nullptr) : json(warning.run)},
          {key::subjects, warning.subjects},
          {key::sentence, warning.sentence}};
}

std::string result_json(const Summary& summary, const Provenance& provenance) {
  json runs = json::array(), ranking = json::array();
  for (const auto& run : summary.runs) runs.push_back(run_json(run));
  for (const auto& entry : summary.ranking) {
    const auto& run = summary.runs[entry.run];
    ranking.push_back({{key::rank, or_null(entry.rank)},
                       {key::run, run.label},
                       {key::group, run.group},
                       {key::objective, run.has_result ? json(run.objective) : json(nullptr)},
                       {key::delta_aicc, or_null(entry.delta_aicc)},
                       {key::successes, run.successes},
                       {key::expected_running_time, or_null(run.expected_running_time)},
                       {key::cost, or_null(run.cost())},
                       {key::failures, run.failures},
                       {key::reason, reason_of_rank(run)}});
  }
  json warnings = json::array(), details = json::array();
  for (const auto& warning : summary.warnings) {
    warnings.push_back(warning.text());
    details.push_back(warning_json(warning));
  }
  const json document = {{key::format, 1},
                         {key::name, summary.name},
                         {key::warnings, std::move(warnings)},
                         {key::warning_details, std::move(details)},
                         {key::ranking, std::move(ranking)},
                         {key::identifiability, summary.identifiability},
                         {key::runs, std::move(runs)},
                         {key::provenance, provenance_json(provenance)}};
  return document.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace tunica::comparison
