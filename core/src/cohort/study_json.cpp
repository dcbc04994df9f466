// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <nlohmann/json.hpp>

#include "cohort/study_output.hpp"
#include "comparison/provenance.hpp"
#include "data/sha256.hpp"
#include "results/keys.hpp"

namespace tunica::cohort {

namespace key = results::key;

namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class Value>
Json optional(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json interval(const Estimated& one) {
  return {{key::value, finite(one.value)}, {key::ci95, {finite(one.lower), finite(one.upper)}}};
}

Json spread_json(const Coordinate& coordinate, const SpreadSummary& spread, bool nested) {
  Json json = {{key::scale, coordinate.scale == Scale::log ? "log" : "linear"},
               {key::sd, finite(spread.sd)},
               {key::ci95, {spread.lower, optional(spread.upper)}}};
  if (nested) json[key::of_animals] = spread.of_animals;
  return json;
}

Json planning_json(const Planning& planning, Scale scale) {
  Json json = {{key::detectable, planning.detectable}, {key::ratio, scale == Scale::log}};
  if (scale == Scale::log) {
    json[key::specimens_for_20_percent] = optional(planning.for_fifth);
    json[key::specimens_for_50_percent] = optional(planning.for_half);
  }
  return json;
}

Json analysis_json(const Analysis& analysis, bool nested) {
  Json of = Json::object(), effects = Json::array(), factors = Json::array();
  for (std::size_t j = 0; j < analysis.coordinates.size(); ++j) {
    const Coordinate& coordinate = analysis.coordinates[j];
    Json means = Json::object();
    for (std::size_t g = 0; g < analysis.groups.size(); ++g) means[analysis.groups[g]] = interval(analysis.means[j][g]);
    of[coordinate.name] = {{key::unit, coordinate.unit},
                           {key::means, means},
                           {key::spread, spread_json(coordinate, analysis.spreads[j], nested)}};
    if (j < analysis.planning.size())
      of[coordinate.name][key::planning] = planning_json(analysis.planning[j], coordinate.scale);
  }
  for (const Effect& one : analysis.effects)
    effects.push_back({{key::factor, one.factor},
                       {key::level, one.level},
                       {key::reference, one.reference},
                       {key::of, one.of},
                       {key::kind, one.ratio ? "ratio" : "difference"},
                       {key::value, finite(one.size.value)},
                       {key::ci95, {finite(one.size.lower), finite(one.size.upper)}},
                       {key::freedom, one.freedom},
                       {key::p, one.p},
                       {key::p_holm, one.p_holm},
                       {key::p_permutation, one.p_permutation},
                       {key::p_adjusted, one.p_adjusted}});
  for (const FactorSummary& one : analysis.factors)
    factors.push_back({{key::factor, one.factor},
                       {key::likelihood_ratio, one.likelihood_ratio.statistic},
                       {key::freedom, one.likelihood_ratio.freedom},
                       {key::p, one.likelihood_ratio.p_value},
                       {key::p_permutation, one.permutation.p_value},
                       {key::permutations, one.permutation.used},
                       {key::all_arrangements, one.permutation.exhaustive},
                       {key::exchanged, std::string(text::code_of(population::scheme_codes, one.permutation.scheme))},
                       {key::smallest_p, one.permutation.smallest}});
  return {{key::of, of}, {key::effects, effects}, {key::factors, factors}};
}

Json readings_json(const ReadingsStudy& study, const SpecimenTable& table, bool nested) {
  Json json = study.analysis ? analysis_json(*study.analysis, nested) : Json{{key::of, Json::object()}};
  if (!study.problem.empty()) json[key::problem] = study.problem;
  for (const ReadingStudy& reading : study.readings) {
    Json values = Json::object(), missing = Json::object();
    for (std::size_t k = 0; k < reading.specimens.size(); ++k)
      values[table.specimens[reading.specimens[k]].id] = interval(reading.values[k]);
    for (const auto& [specimen, reason] : reading.missing) missing[table.specimens[specimen].id] = reason;
    Json& of = json[key::of][reading.entry.name];
    of[key::test] = reading.entry.test;
    of[key::channel] = reading.entry.channel;
    of[key::kind] = std::string(text::code_of(reading_codes, reading.entry.kind));
    of[key::at] = reading.entry.at;
    of[key::specimens] = values;
    of[key::missing] = missing;
  }
  return json;
}

Json population_json(const PopulationStudy& one, const SpecimenTable& table) {
  Json json = {{key::run, one.run}, {key::model, one.model}, {key::specimens, one.members.specimens.size()}};
  json[key::readings] = readings_json(one.readings, table, !one.members.animals.empty());
  if (!one.problem.empty()) {
    json[key::problem] = one.problem;
    return json;
  }
  json[key::animals] = one.members.animals.empty() ? one.members.specimens.size() : one.members.animals.size();
  json[key::spread_structure] = one.full ? "full" : "diagonal";
  json[key::nested] = one.nested;
  json[key::converged] = one.converged;
  json[key::rounds] = one.rounds;
  json[key::neg2_log_likelihood] = finite(one.neg2_likelihood);
  json[key::aic] = finite(one.aic);
  json[key::bic] = finite(one.bic);
  json[key::parameters] = analysis_json(one.parameters, one.nested);
  json[key::outlying] = Json::array();
  for (const Outlier& outlier : one.outliers)
    json[key::outlying].push_back({{key::specimen, table.specimens[outlier.specimen].id},
                                   {key::p, outlier.p},
                                   {key::farthest_in, outlier.farthest}});
  if (!one.noise.empty())
    for (const auto& [channel, factor] : one.noise) json[key::noise_factor][channel] = factor;
  return json;
}

}  // namespace

std::string study_json(const Specification& cohort, const SpecimenTable& table, const Collection& found,
                       const Study& study) {
  Json json = {{key::format, 1}, {key::name, cohort.name}};
  Json warnings = Json::array(), details = Json::array(), specimens = Json::array(), populations = Json::array();
  for (const Remark& remark : study.remarks) {
    warnings.push_back(remark.sentence);
    details.push_back({{key::kind, std::string(text::code_of(remark_codes, remark.kind))},
                       {key::sentence, remark.sentence},
                       {key::specimens, remark.specimens}});
  }
  for (std::size_t k = 0; k < table.specimens.size(); ++k) {
    const Record& record = found.records[k];
    Json codes = Json::array();
    for (const Record::Warning& warning : record.warnings) codes.push_back(warning.kind);
    specimens.push_back({{key::id, record.id},
                         {key::folder, "specimens/" + table.specimens[k].folder},
                         {key::outcome, std::string(text::code_of(outcome_codes, record.outcome))},
                         {key::reason, record.reason},
                         {key::warnings, codes}});
  }
  for (const PopulationStudy& one : study.populations) populations.push_back(population_json(one, table));
  json[key::warnings] = warnings;
  json[key::warning_details] = details;
  json[key::cohort] = {{key::specimens, specimens}, {key::populations, populations}};
  if (study.diagnosis) json[key::diagnosis] = diagnosis_json(table, *study.diagnosis);
  std::string inputs;
  for (const Record& record : found.records) inputs += record.inputs + "\n";
  json[key::provenance] = {{key::version, comparison::version()},
                           {key::seed, cohort.seed},
                           {key::cohort_sha256, data::sha256(cohort.text)},
                           {key::inputs_sha256, data::sha256(inputs)}};
  return json.dump(2, ' ', false, decltype(json)::error_handler_t::replace) + "\n";
}

}  // namespace tunica::cohort
