// SPDX-License-Identifier: Apache-2.0
#include <set>

#include <nlohmann/json.hpp>

#include "comparison/result_json.hpp"
#include "discovery/output/outputs.hpp"

namespace tunica::discovery {
namespace {

using json = nlohmann::ordered_json;

json kind_json(const Kind& kind) {
  json one = {{"invariant", kind.invariant}};
  if (!kind.family.empty()) one["family"] = kind.family;
  one["law"] = kind.law;
  if (!kind.knots.empty()) one["knots"] = kind.knots;
  return one;
}

json term_json(const FoundTerm& term) {
  json one = {{"name", term.name}};
  one.update(kind_json(*term.kind));
  one["closed"] = term.kind->law != "spline";
  one["probability"] = term.probability;
  one["invariant_probability"] = term.invariant_probability;
  for (const diagnosis::Amplitude& parameter : term.parameters)
    one["parameters"][parameter.name] = {{"value", parameter.value},
                                         {"low", parameter.low},
                                         {"high", parameter.high},
                                         {"unit", parameter.unit},
                                         {"at_bound", parameter.at_bound}};
  one["curve"] = {{"x", term.curve.x},     {"slope", term.curve.slope},
                  {"low", term.curve.low}, {"high", term.curve.high},
                  {"unit", "kPa"},         {"reach", {term.kind->reach.low, term.kind->reach.high}}};
  return one;
}

json alternative_json(const Alternative& alternative) {
  json one = json::object();
  if (alternative.mechanism.empty()) {
    one["terms"] = json::array();
    for (const KindPointer& kind : alternative.kinds) one["terms"].push_back(kind_json(*kind));
  } else {
    one[alternative.remembers ? "memory" : "rig"] = json::array({alternative.mechanism});
  }
  one["probability"] = alternative.probability;
  one["chi2"] = alternative.chi2;
  return one;
}

}  // namespace

json discovery_json(const Discovery& d) {
  json result = {{"verdict", diagnosis::code_of(d.verdict)}};
  result["reasons"] = json::array();
  for (const Reason& reason : d.reasons)
    result["reasons"].push_back({{"code", code_of(reason.kind)}, {"text", reason.text}});
  result["base"] = d.request.from_nothing ? json(nullptr) : json(d.request.model);
  result["model"] = d.request.model;
  result["alpha"] = d.request.alpha;
  result["p_before"] = d.request.from_nothing ? json(nullptr) : json(d.analysis.alarm.p());
  result["p_after"] = d.p_after;
  result["chi2_before"] = d.request.from_nothing ? json(nullptr) : json(d.chi2_before);
  result["chi2_after"] = d.chi2_after;
  result["rows"] = d.analysis.evidence.fit.residuals.size();
  result["sets_fitted"] = d.sets_tried;
  result["terms"] = json::array();
  for (const FoundTerm& term : d.terms) result["terms"].push_back(term_json(term));
  result["ambiguity_set"] = json::array();
  for (const Alternative& alternative : d.ambiguity) result["ambiguity_set"].push_back(alternative_json(alternative));
  if (d.name) result["name_of_the_catalogue"] = {{"id", d.name->id}, {"chi2", d.name->chi2}};
  result["path_dependence"] = {{"p_value", d.paths.p_value}, {"share", d.paths.share}, {"where", d.paths.where}};
  result["held_out"] = json::array();
  for (const diagnosis::HeldOut& block : d.held_out)
    result["held_out"].push_back({{"block", block.block},
                                  {"rows", block.rows},
                                  {"before", block.before},
                                  {"after", block.after},
                                  {"p_value", block.p_value},
                                  {"verdict", diagnosis::code_of(block.verdict)}});
  if (!d.next.empty()) result["next_experiment"] = {{"description", d.next}};
  return result;
}

std::string result_document(const Discovery& d, const experiment::Experiment& experiment,
                            const plugins::Catalogue& catalogue) {
  const diagnosis::Evidence& evidence = d.analysis.evidence;
  std::set<std::string> plugins{catalogue.models().find("composed")->second.plugin};
  for (const std::string& name : experiment.models_of(evidence.run))
    plugins.insert(catalogue.models().find(experiment.model(name).type)->second.plugin);
  for (const std::string& name : evidence.run.tests)
    plugins.insert(catalogue.tests().find(experiment.test(name).type)->second.plugin);
  json texts = json::array(), details = json::array();
  for (const diagnosis::Warning& warning : d.warnings) {
    texts.push_back(warning.text);
    details.push_back({{"code", diagnosis::code_of(warning.kind)}, {"text", warning.text}});
  }
  const json document = {
      {"format", 1},
      {"name", experiment.name},
      {"warnings", texts},
      {"warning_details", details},
      {"ranking", json::array()},
      {"identifiability", json::array()},
      {"runs", json::array()},
      {"discovery", discovery_json(d)},
      {"provenance", comparison::provenance_json(comparison::provenance_of(experiment, {plugins.begin(), plugins.end()},
                                                                           evidence.base->layout().data_hashes))}};
  return document.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace tunica::discovery
