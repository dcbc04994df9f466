// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/verdict_json.hpp"

#include <nlohmann/json.hpp>

namespace tunica::cohort_diagnosis {
namespace {

using Json = nlohmann::ordered_json;

Json of(const diagnosis::Place& place) {
  Json json{{"tests", place.tests}};
  if (!place.channel.empty()) json["channel"] = place.channel;
  if (place.row) json["row"] = place.file_row;
  if (!place.model.empty()) json["model"] = place.model;
  json["words"] = place.words();
  return json;
}

Json of(const CommonAmplitude& one) {
  return {{"name", one.name}, {"unit", one.unit},     {"mean", one.mean},      {"low", one.low},
          {"high", one.high}, {"spread", one.spread}, {"squared", one.squared}};
}

Json of(const Explanation& one) {
  Json json{{"mechanisms", one.ids},        {"log_evidence", one.log_evidence},
            {"log_weight", one.log_weight}, {"probability", one.probability},
            {"in_set", one.in_set},         {"places", Json::array()}};
  for (const diagnosis::Place& place : one.places) json["places"].push_back(of(place));
  for (const auto& setting : one.settings) {
    Json values = Json::object();
    for (const auto& [name, value] : setting) values[name] = value;
    json["settings"].push_back(std::move(values));
  }
  return json;
}

Json of(const FactorEvidence& one) {
  Json json{{"factor", one.factor}, {"only_in", nullptr}, {"probability_only", one.probability_only}};
  if (one.only_in) json["only_in"] = *one.only_in;
  for (const LevelEvidence& level : one.levels) {
    Json entry{
        {"level", level.level}, {"specimens", level.specimens}, {"with", level.with}, {"without", level.without}};
    if (level.amplitude) entry["amplitude"] = of(*level.amplitude);
    json["levels"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace

Json to_json(const CohortVerdict& verdict) {
  Json json{{"verdict", diagnosis::code_of(verdict.verdict)},
            {"reasons", Json::array()},
            {"p_value", verdict.p_value},
            {"alarm", verdict.alarm},
            {"named", verdict.named},
            {"ambiguity_set", verdict.ambiguity_set},
            {"look_alikes", verdict.look_alikes},
            {"size",
             {{"rms", verdict.size.rms},
              {"tolerance", verdict.size.tolerance.share},
              {"tolerance_origin", diagnosis::code_of(verdict.size.tolerance.origin)},
              {"within", verdict.size.within}}},
            {"p_rest", verdict.p_rest},
            {"explanations", Json::array()},
            {"amplitudes", Json::array()},
            {"factors", Json::array()},
            {"contradictions", Json::array()},
            {"left_out", Json::array()},
            {"specimens", verdict.specimens},
            {"p_values", verdict.p_values},
            {"likeness", verdict.likeness},
            {"matrix", Json::array()}};
  for (const CohortReason& one : verdict.reasons)
    json["reasons"].push_back({{"code", code_of(one.kind)}, {"text", one.text}});
  for (const Explanation& one : verdict.explanations) json["explanations"].push_back(of(one));
  for (const CommonAmplitude& one : verdict.amplitudes) json["amplitudes"].push_back(of(one));
  for (const FactorEvidence& one : verdict.factors) json["factors"].push_back(of(one));
  for (const Contradiction& one : verdict.contradictions)
    json["contradictions"].push_back({{"specimen", one.specimen}, {"code", code_of(one.kind)}, {"text", one.text}});
  for (const LeftOut& one : verdict.left_out)
    json["left_out"].push_back({{"specimen", one.specimen},
                                {"rows", one.rows},
                                {"without", one.without},
                                {"own", one.own},
                                {"foretold", one.foretold}});
  for (const MatrixRow& one : verdict.matrix)
    json["matrix"].push_back({{"mechanism", one.id}, {"place", of(one.place)}, {"log_evidence", one.log_evidence}});
  return json;
}

}  // namespace tunica::cohort_diagnosis
