// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/verdict_json.hpp"

#include <nlohmann/json.hpp>

#include "results/keys.hpp"

namespace tunica::cohort_diagnosis {

namespace key = results::key;
namespace {

using Json = nlohmann::ordered_json;

Json of(const diagnosis::Place& place) {
  Json json{{key::tests, place.tests}};
  if (!place.channel.empty()) json[key::channel] = place.channel;
  if (place.row) json[key::row] = place.file_row;
  if (!place.model.empty()) json[key::model] = place.model;
  json[key::words] = place.words();
  return json;
}

Json of(const CommonAmplitude& one) {
  return {{key::name, one.name}, {key::unit, one.unit},     {key::mean, one.mean},      {key::low, one.low},
          {key::high, one.high}, {key::spread, one.spread}, {key::squared, one.squared}};
}

Json of(const Explanation& one) {
  Json json{{key::mechanisms, one.ids},        {key::log_evidence, one.log_evidence},
            {key::log_weight, one.log_weight}, {key::probability, one.probability},
            {key::in_set, one.in_set},         {key::places, Json::array()}};
  for (const diagnosis::Place& place : one.places) json[key::places].push_back(of(place));
  for (const auto& setting : one.settings) {
    Json values = Json::object();
    for (const auto& [name, value] : setting) values[name] = value;
    json[key::settings].push_back(std::move(values));
  }
  return json;
}

Json of(const FactorEvidence& one) {
  Json json{{key::factor, one.factor}, {key::only_in, nullptr}, {key::probability_only, one.probability_only}};
  if (one.only_in) json[key::only_in] = *one.only_in;
  for (const LevelEvidence& level : one.levels) {
    Json entry{{key::level, level.level},
               {key::specimens, level.specimens},
               {key::with, level.with},
               {key::without, level.without}};
    if (level.amplitude) entry[key::amplitude] = of(*level.amplitude);
    json[key::levels].push_back(std::move(entry));
  }
  return json;
}

}  // namespace

Json to_json(const CohortVerdict& verdict) {
  Json json{{key::verdict, diagnosis::code_of(verdict.verdict)},
            {key::reasons, Json::array()},
            {key::p_value, verdict.p_value},
            {key::alarm, verdict.alarm},
            {key::named, verdict.named},
            {key::ambiguity_set, verdict.ambiguity_set},
            {key::look_alikes, verdict.look_alikes},
            {key::size,
             {{key::rms, verdict.size.rms},
              {key::tolerance, verdict.size.tolerance.share},
              {key::tolerance_origin, diagnosis::code_of(verdict.size.tolerance.origin)},
              {key::within, verdict.size.within}}},
            {key::p_rest, verdict.p_rest},
            {key::explanations, Json::array()},
            {key::amplitudes, Json::array()},
            {key::factors, Json::array()},
            {key::contradictions, Json::array()},
            {key::left_out, Json::array()},
            {key::specimens, verdict.specimens},
            {key::p_values, verdict.p_values},
            {key::likeness, verdict.likeness},
            {key::matrix, Json::array()}};
  for (const CohortReason& one : verdict.reasons)
    json[key::reasons].push_back({{key::code, code_of(one.kind)}, {key::text, one.text}});
  for (const Explanation& one : verdict.explanations) json[key::explanations].push_back(of(one));
  for (const CommonAmplitude& one : verdict.amplitudes) json[key::amplitudes].push_back(of(one));
  for (const FactorEvidence& one : verdict.factors) json[key::factors].push_back(of(one));
  for (const Contradiction& one : verdict.contradictions)
    json[key::contradictions].push_back(
        {{key::specimen, one.specimen}, {key::code, code_of(one.kind)}, {key::text, one.text}});
  for (const LeftOut& one : verdict.left_out)
    json[key::left_out].push_back({{key::specimen, one.specimen},
                                   {key::rows, one.rows},
                                   {key::without, one.without},
                                   {key::own, one.own},
                                   {key::foretold, one.foretold}});
  for (const MatrixRow& one : verdict.matrix)
    json[key::matrix].push_back(
        {{key::mechanism, one.id}, {key::place, of(one.place)}, {key::log_evidence, one.log_evidence}});
  return json;
}

}  // namespace tunica::cohort_diagnosis
