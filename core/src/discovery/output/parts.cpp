// SPDX-License-Identifier: Apache-2.0
#include "discovery/output/parts.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "comparison/result_json.hpp"
#include "diagnosis/output/outputs.hpp"
#include "results/keys.hpp"
#include "text/wrapping.hpp"

namespace tunica::discovery {

namespace key = results::key;
namespace {

using json = nlohmann::ordered_json;

json alternative_json(const Alternative& alternative) {
  json one = json::object();
  if (alternative.mechanism.empty()) {
    one[key::terms] = json::array();
    for (const KindPointer& kind : alternative.kinds) one[key::terms].push_back(kind_json(*kind));
  } else {
    one[alternative.remembers ? "memory" : "rig"] = json::array({alternative.mechanism});
  }
  one[key::probability] = alternative.probability;
  one[key::chi2] = alternative.chi2;
  return one;
}

std::string capitals(diagnosis::Verdict verdict) {
  std::string words = diagnosis::code_of(verdict);
  std::replace(words.begin(), words.end(), '_', ' ');
  std::transform(words.begin(), words.end(), words.begin(), [](unsigned char c) { return std::toupper(c); });
  return words;
}

}  // namespace

json kind_json(const Kind& kind) {
  json one = {{key::invariant, kind.invariant}};
  if (!kind.family.empty()) one[key::family] = kind.family;
  one[key::law] = kind.law;
  if (!kind.knots.empty()) one[key::knots] = kind.knots;
  return one;
}

json answer_json(const Request& request, const Judgement& judgement) {
  json result = {{key::verdict, diagnosis::code_of(judgement.verdict)}};
  result[key::reasons] = json::array();
  for (const Reason& reason : judgement.reasons)
    result[key::reasons].push_back({{key::code, code_of(reason.kind)}, {key::text, reason.text}});
  result[key::base] = request.from_nothing ? json(nullptr) : json(request.model);
  result[key::model] = request.model;
  result[key::alpha] = request.alpha;
  result[key::ambiguity_set] = json::array();
  for (const Alternative& alternative : judgement.ambiguity)
    result[key::ambiguity_set].push_back(alternative_json(alternative));
  if (judgement.name)
    result[key::name_of_the_catalogue] = {{key::id, judgement.name->id}, {key::chi2, judgement.name->chi2}};
  return result;
}

json paths_json(const PathDependence& paths) {
  return {{key::p_value, paths.p_value}, {key::share, paths.share}, {key::where, paths.where}};
}

std::string document(const std::string& name, const std::vector<diagnosis::Warning>& warnings, json discovery,
                     const experiment::Experiment& experiment, const diagnosis::Evidence& evidence,
                     const std::vector<std::string>& data_hashes, const plugins::Catalogue& catalogue) {
  std::set<std::string> plugins{catalogue.term_model()->plugin};
  for (const std::string& model : experiment.models_of(evidence.run))
    plugins.insert(catalogue.models().find(experiment.model(model).type)->second.plugin);
  for (const std::string& test : evidence.run.tests)
    plugins.insert(catalogue.tests().find(experiment.test(test).type)->second.plugin);
  json texts = json::array();
  for (const diagnosis::Warning& warning : warnings) texts.push_back(warning.text);
  const json whole = {{key::format, 1},
                      {key::name, name},
                      {key::warnings, texts},
                      {key::warning_details, diagnosis::warning_details(warnings)},
                      {key::ranking, json::array()},
                      {key::identifiability, json::array()},
                      {key::runs, json::array()},
                      {key::discovery, std::move(discovery)},
                      {key::provenance, comparison::provenance_json(comparison::provenance_of(
                                            experiment, {plugins.begin(), plugins.end()}, data_hashes))}};
  return whole.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

text::StyledText verdict_words(const Judgement& judgement) {
  std::vector<std::string> reasons;
  for (const Reason& reason : judgement.reasons) reasons.push_back(reason.text);
  text::StyledText page;
  page.add(text::hanging(fmt::format("{:<10}", "Verdict:"),
                         fmt::format("{}: {}", capitals(judgement.verdict), fmt::join(reasons, " "))),
           text::Emphasis::heading);
  page += "\n";
  return page;
}

std::string p_words(double p) { return p < 1e-4 ? "p < 0.0001" : fmt::format("p = {:.2g}", p); }

}  // namespace tunica::discovery
