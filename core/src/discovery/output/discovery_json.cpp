// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "discovery/output/outputs.hpp"
#include "discovery/output/parts.hpp"

namespace tunica::discovery {
namespace {

using json = nlohmann::ordered_json;

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

}  // namespace

json discovery_json(const Discovery& d) {
  json result = answer_json(d.request, d.judgement);
  result["p_before"] = d.request.from_nothing ? json(nullptr) : json(d.analysis.alarm.p());
  result["p_after"] = d.p_after;
  result["chi2_before"] = d.request.from_nothing ? json(nullptr) : json(d.chi2_before);
  result["chi2_after"] = d.chi2_after;
  result["rows"] = d.analysis.evidence.fit.residuals.size();
  result["sets_fitted"] = d.sets_tried;
  result["terms"] = json::array();
  for (const FoundTerm& term : d.terms) result["terms"].push_back(term_json(term));
  result["path_dependence"] = paths_json(d.paths);
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
  return document(experiment.name, d.warnings, discovery_json(d), experiment, d.analysis.evidence,
                  d.analysis.evidence.base->layout().data_hashes, catalogue);
}

}  // namespace tunica::discovery
