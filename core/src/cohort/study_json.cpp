// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <nlohmann/json.hpp>

#include "cohort/study_output.hpp"
#include "comparison/provenance.hpp"
#include "data/sha256.hpp"

namespace tunica::cohort {

namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class Value>
Json optional(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json interval(const Estimated& one) {
  return {{"value", finite(one.value)}, {"ci95", {finite(one.lower), finite(one.upper)}}};
}

Json spread_json(const Coordinate& coordinate, const SpreadSummary& spread, bool nested) {
  Json json = {{"scale", coordinate.scale == Scale::log ? "log" : "linear"},
               {"sd", finite(spread.sd)},
               {"ci95", {spread.lower, optional(spread.upper)}}};
  if (nested) json["of_animals"] = spread.of_animals;
  return json;
}

Json planning_json(const Planning& planning, Scale scale) {
  Json json = {{"detectable", planning.detectable}, {"ratio", scale == Scale::log}};
  if (scale == Scale::log) {
    json["specimens_for_20_percent"] = optional(planning.for_fifth);
    json["specimens_for_50_percent"] = optional(planning.for_half);
  }
  return json;
}

Json analysis_json(const Analysis& analysis, bool nested) {
  Json of = Json::object(), effects = Json::array(), factors = Json::array();
  for (std::size_t j = 0; j < analysis.coordinates.size(); ++j) {
    const Coordinate& coordinate = analysis.coordinates[j];
    Json means = Json::object();
    for (std::size_t g = 0; g < analysis.groups.size(); ++g) means[analysis.groups[g]] = interval(analysis.means[j][g]);
    of[coordinate.name] = {
        {"unit", coordinate.unit}, {"means", means}, {"spread", spread_json(coordinate, analysis.spreads[j], nested)}};
    if (j < analysis.planning.size())
      of[coordinate.name]["planning"] = planning_json(analysis.planning[j], coordinate.scale);
  }
  for (const Effect& one : analysis.effects)
    effects.push_back({{"factor", one.factor},
                       {"level", one.level},
                       {"reference", one.reference},
                       {"of", one.of},
                       {"kind", one.ratio ? "ratio" : "difference"},
                       {"value", finite(one.size.value)},
                       {"ci95", {finite(one.size.lower), finite(one.size.upper)}},
                       {"freedom", one.freedom},
                       {"p", one.p},
                       {"p_holm", one.p_holm},
                       {"p_permutation", one.p_permutation},
                       {"p_adjusted", one.p_adjusted}});
  for (const FactorSummary& one : analysis.factors)
    factors.push_back({{"factor", one.factor},
                       {"likelihood_ratio", one.likelihood_ratio.statistic},
                       {"freedom", one.likelihood_ratio.freedom},
                       {"p", one.likelihood_ratio.p_value},
                       {"p_permutation", one.permutation.p_value},
                       {"permutations", one.permutation.used},
                       {"all_arrangements", one.permutation.exhaustive},
                       {"exchanged", std::string(text::code_of(population::scheme_codes, one.permutation.scheme))},
                       {"smallest_p", one.permutation.smallest}});
  return {{"of", of}, {"effects", effects}, {"factors", factors}};
}

Json readings_json(const ReadingsStudy& study, const SpecimenTable& table, bool nested) {
  Json json = study.analysis ? analysis_json(*study.analysis, nested) : Json{{"of", Json::object()}};
  if (!study.problem.empty()) json["problem"] = study.problem;
  for (const ReadingStudy& reading : study.readings) {
    Json values = Json::object(), missing = Json::object();
    for (std::size_t k = 0; k < reading.specimens.size(); ++k)
      values[table.specimens[reading.specimens[k]].id] = interval(reading.values[k]);
    for (const auto& [specimen, reason] : reading.missing) missing[table.specimens[specimen].id] = reason;
    Json& of = json["of"][reading.entry.name];
    of["test"] = reading.entry.test;
    of["channel"] = reading.entry.channel;
    of["kind"] = std::string(text::code_of(reading_codes, reading.entry.kind));
    of["at"] = reading.entry.at;
    of["specimens"] = values;
    of["missing"] = missing;
  }
  return json;
}

Json population_json(const PopulationStudy& one, const SpecimenTable& table) {
  Json json = {{"run", one.run}, {"model", one.model}, {"specimens", one.members.specimens.size()}};
  json["readings"] = readings_json(one.readings, table, !one.members.animals.empty());
  if (!one.problem.empty()) {
    json["problem"] = one.problem;
    return json;
  }
  json["animals"] = one.members.animals.empty() ? one.members.specimens.size() : one.members.animals.size();
  json["spread_structure"] = one.full ? "full" : "diagonal";
  json["nested"] = one.nested;
  json["converged"] = one.converged;
  json["rounds"] = one.rounds;
  json["neg2_log_likelihood"] = finite(one.neg2_likelihood);
  json["aic"] = finite(one.aic);
  json["bic"] = finite(one.bic);
  json["parameters"] = analysis_json(one.parameters, one.nested);
  json["outlying"] = Json::array();
  for (const Outlier& outlier : one.outliers)
    json["outlying"].push_back(
        {{"specimen", table.specimens[outlier.specimen].id}, {"p", outlier.p}, {"farthest_in", outlier.farthest}});
  if (!one.noise.empty())
    for (const auto& [channel, factor] : one.noise) json["noise_factor"][channel] = factor;
  return json;
}

}  // namespace

std::string study_json(const Specification& cohort, const SpecimenTable& table, const Collection& found,
                       const Study& study) {
  Json json = {{"format", 1}, {"name", cohort.name}};
  Json warnings = Json::array(), details = Json::array(), specimens = Json::array(), populations = Json::array();
  for (const Remark& remark : study.remarks) {
    warnings.push_back(remark.sentence);
    details.push_back({{"kind", std::string(text::code_of(remark_codes, remark.kind))},
                       {"sentence", remark.sentence},
                       {"specimens", remark.specimens}});
  }
  for (std::size_t k = 0; k < table.specimens.size(); ++k) {
    const Record& record = found.records[k];
    Json codes = Json::array();
    for (const Record::Warning& warning : record.warnings) codes.push_back(warning.kind);
    specimens.push_back({{"id", record.id},
                         {"folder", "specimens/" + table.specimens[k].folder},
                         {"outcome", std::string(text::code_of(outcome_codes, record.outcome))},
                         {"reason", record.reason},
                         {"warnings", codes}});
  }
  for (const PopulationStudy& one : study.populations) populations.push_back(population_json(one, table));
  json["warnings"] = warnings;
  json["warning_details"] = details;
  json["cohort"] = {{"specimens", specimens}, {"populations", populations}};
  if (study.diagnosis) json["diagnosis"] = diagnosis_json(table, *study.diagnosis);
  std::string inputs;
  for (const Record& record : found.records) inputs += record.inputs + "\n";
  json["provenance"] = {{"version", comparison::version()},
                        {"seed", cohort.seed},
                        {"cohort_sha256", data::sha256(cohort.text)},
                        {"inputs_sha256", data::sha256(inputs)}};
  return json.dump(2, ' ', false, decltype(json)::error_handler_t::replace) + "\n";
}

}  // namespace tunica::cohort
