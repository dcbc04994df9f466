// SPDX-License-Identifier: Apache-2.0
#include "cohort/record.hpp"

#include <nlohmann/json.hpp>

#include "execution/checksum.hpp"
#include "tunica/detail/bounded_json.hpp"

namespace tunica::cohort {

namespace {

using Json = nlohmann::ordered_json;

constexpr int record_format = 2;

template <class Value>
Json json_of(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <class Value>
std::optional<Value> optional_of(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<Value>(json.get<Value>());
}

Json json_of(const Record::Parameter& parameter) {
  return {{"name", parameter.name},
          {"unit", parameter.unit},
          {"scale", parameter.scale == Scale::log ? "log" : "linear"},
          {"value", parameter.value},
          {"min", parameter.min},
          {"max", parameter.max},
          {"lower", json_of(parameter.lower)},
          {"upper", json_of(parameter.upper)},
          {"at_bound", parameter.at_bound},
          {"identified", parameter.identified}};
}

Record::Parameter parameter_of(const Json& json) {
  return {json.at("name"),
          json.at("unit"),
          json.at("scale") == "log" ? Scale::log : Scale::linear,
          json.at("value"),
          json.at("min"),
          json.at("max"),
          optional_of<double>(json.at("lower")),
          optional_of<double>(json.at("upper")),
          json.at("at_bound"),
          json.at("identified")};
}

Json json_of(const Record::Quality& quality) {
  return {{"test", quality.test},         {"channel", quality.channel}, {"unit", quality.unit},
          {"held_out", quality.held_out}, {"r2", json_of(quality.r2)},  {"rmse", quality.rmse},
          {"largest", quality.largest}};
}

Record::Quality quality_of(const Json& json) {
  return {json.at("test"), json.at("channel"), json.at("unit"), json.at("held_out"), optional_of<double>(json.at("r2")),
          json.at("rmse"), json.at("largest")};
}

Json json_of(const Record::Run& run) {
  Json parameters = Json::array(), quality = Json::array();
  for (const auto& one : run.parameters) parameters.push_back(json_of(one));
  for (const auto& one : run.quality) quality.push_back(json_of(one));
  return {{"label", run.label},
          {"model", run.model},
          {"has_result", run.has_result},
          {"reason", run.reason},
          {"objective", run.objective},
          {"parameters", parameters},
          {"quality", quality},
          {"stable", json_of(run.stable)},
          {"misfit", json_of(run.misfit)},
          {"evaluations", run.evaluations}};
}

Record::Run run_of(const Json& json) {
  Record::Run run;
  run.label = json.at("label");
  run.model = json.at("model");
  run.has_result = json.at("has_result");
  run.reason = json.at("reason");
  run.objective = json.at("objective");
  for (const Json& one : json.at("parameters")) run.parameters.push_back(parameter_of(one));
  for (const Json& one : json.at("quality")) run.quality.push_back(quality_of(one));
  run.stable = optional_of<bool>(json.at("stable"));
  run.misfit = optional_of<double>(json.at("misfit"));
  run.evaluations = json.at("evaluations");
  return run;
}

}  // namespace

std::string to_json(const Record& record) {
  Json warnings = Json::array(), runs = Json::array();
  for (const auto& one : record.warnings) warnings.push_back({{"kind", one.kind}, {"text", one.text}});
  for (const auto& one : record.runs) runs.push_back(json_of(one));
  const Json json = {{"format", record_format},
                     {"id", record.id},
                     {"inputs", record.inputs},
                     {"data", record.data},
                     {"outcome", std::string(text::code_of(outcome_codes, record.outcome))},
                     {"reason", record.reason},
                     {"warnings", warnings},
                     {"runs", runs},
                     {"seconds", record.seconds}};
  const auto whole = execution::sealed(json);
  return whole.dump(1, ' ', false, decltype(whole)::error_handler_t::replace) + "\n";
}

std::optional<Record> record_of(const std::string& text) {
  const Json json = detail::parse_json<Json>(text, false);
  try {
    if (!execution::intact(json) || json.at("format") != record_format) return {};
    const auto outcome = text::value_of(outcome_codes, json.at("outcome").get<std::string>());
    if (!outcome) return {};
    Record record;
    record.id = json.at("id");
    record.inputs = json.at("inputs");
    record.data = json.at("data");
    record.outcome = *outcome;
    record.reason = json.at("reason");
    for (const Json& one : json.at("warnings")) record.warnings.push_back({one.at("kind"), one.at("text")});
    for (const Json& one : json.at("runs")) record.runs.push_back(run_of(one));
    record.seconds = json.at("seconds");
    return record;
  } catch (const nlohmann::json::exception&) {
    return {};  // a member is missing or of another type: no record of this version
  }
}

}  // namespace tunica::cohort
