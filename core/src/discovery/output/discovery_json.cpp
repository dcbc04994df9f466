// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "discovery/output/outputs.hpp"
#include "discovery/output/parts.hpp"
#include "results/keys.hpp"

namespace tunica::discovery {

namespace key = results::key;
namespace {

using json = nlohmann::ordered_json;

json term_json(const FoundTerm& term) {
  json one = {{key::name, term.name}};
  one.update(kind_json(*term.kind));
  one[key::closed] = term.kind->law != "spline";
  one[key::probability] = term.probability;
  one[key::invariant_probability] = term.invariant_probability;
  for (const diagnosis::Amplitude& parameter : term.parameters)
    one[key::parameters][parameter.name] = {{key::value, parameter.value},
                                            {key::low, parameter.low},
                                            {key::high, parameter.high},
                                            {key::unit, parameter.unit},
                                            {key::at_bound, parameter.at_bound}};
  one[key::curve] = {{key::x, term.curve.x},     {key::slope, term.curve.slope},
                     {key::low, term.curve.low}, {key::high, term.curve.high},
                     {key::unit, "kPa"},         {key::reach, {term.kind->reach.low, term.kind->reach.high}}};
  return one;
}

}  // namespace

json discovery_json(const Discovery& d) {
  json result = answer_json(d.request, d.judgement);
  result[key::p_before] = d.request.from_nothing ? json(nullptr) : json(d.analysis.alarm.p());
  result[key::p_after] = d.p_after;
  result[key::chi2_before] = d.request.from_nothing ? json(nullptr) : json(d.chi2_before);
  result[key::chi2_after] = d.chi2_after;
  result[key::rows] = d.analysis.evidence.fit.residuals.size();
  result[key::sets_fitted] = d.sets_tried;
  result[key::terms] = json::array();
  for (const FoundTerm& term : d.terms) result[key::terms].push_back(term_json(term));
  result[key::path_dependence] = paths_json(d.paths);
  result[key::held_out] = json::array();
  for (const diagnosis::HeldOut& block : d.held_out)
    result[key::held_out].push_back({{key::block, block.block},
                                     {key::rows, block.rows},
                                     {key::before, block.before},
                                     {key::after, block.after},
                                     {key::p_value, block.p_value},
                                     {key::verdict, diagnosis::code_of(block.verdict)}});
  if (!d.next.empty()) result[key::next_experiment] = {{key::description, d.next}};
  return result;
}

std::string result_document(const Discovery& d, const experiment::Experiment& experiment,
                            const plugins::Catalogue& catalogue) {
  return document(experiment.name, d.warnings, discovery_json(d), experiment, d.analysis.evidence,
                  d.analysis.evidence.base->layout().data_hashes, catalogue);
}

}  // namespace tunica::discovery
