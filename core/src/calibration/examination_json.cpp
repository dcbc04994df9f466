// SPDX-License-Identifier: Apache-2.0
#include "calibration/examination_json.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "comparison/result_json.hpp"

namespace tunica::calibration {

namespace {

using json = nlohmann::ordered_json;

/// "ok", or the problem.
json status_json(const Status& status) {
  switch (status.kind()) {
    case Status::Kind::ok:
      return "ok";
    case Status::Kind::infeasible:
      return "infeasible: " + status.reason();
    case Status::Kind::failed:
      break;
  }
  return "failed: " + status.reason();
}

json channel_json(const assembly::MeasuredChannel& channel) {
  json one = {{"test", channel.test},  {"observable", channel.observable},    {"unit", channel.unit},
              {"rows", channel.count}, {"held_out", channel.held_out_rows()}, {"weight", channel.weight}};
  std::vector<double> values = channel.measured;
  std::erase_if(values, [](double value) { return std::isnan(value); });
  one["measured"] = values.size();
  if (channel.count > 0) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const auto [first, last] = std::minmax_element(channel.abscissa.begin(), channel.abscissa.end());
    one["range"] = values.empty() ? json(nullptr) : json{*low, *high};
    one["over"] = {{"name", channel.abscissa_name}, {"unit", channel.abscissa_unit}, {"range", {*first, *last}}};
  }
  one["noise"] = nullptr;
  if (channel.noise) one["noise"] = {{"absolute", channel.noise->absolute}, {"relative", channel.noise->relative}};
  return one;
}

json parameters_json(const assembly::Assembly& assembly) {
  json all = json::object();
  for (const auto& parameter : assembly.layout().parameters) {
    auto& one = all[parameter.name] = {{"unit", parameter.unit},
                                       {"initial", parameter.initial},
                                       {"min", parameter.min},
                                       {"max", parameter.max},
                                       {"scale", parameter.scale == Scale::log ? "log" : "linear"}};
    if (parameter.prior) one["prior"] = {{"mean", parameter.prior->mean}, {"sd", parameter.prior->sd}};
  }
  for (const auto& parameter : assembly.layout().fixed_parameters)
    all[parameter.name] = {{"unit", parameter.unit}, {"fixed", parameter.value}};
  return all;
}

json initial_json(const calibration::PosedProblem& problem) {
  const auto& initial = problem.initial;
  if (!initial.not_run.empty()) return {{"status", nullptr}, {"not_run", initial.not_run}};
  json one = {{"status", status_json(initial.status)}};
  if (initial.status.kind() == Status::Kind::failed) return one;
  one["objective"] = initial.objective;
  one["per_test"] = json::object();
  for (std::size_t test = 0; test < initial.per_test.size(); ++test)
    one["per_test"][problem.run->entry->tests[test]] = initial.per_test[test];
  one["seconds"] = initial.seconds;
  one["agreement"] = json::array();
  for (const auto& [test, found, status] : initial.other_means) {
    for (const auto& agreement : found)
      one["agreement"].push_back({{"test", test},
                                  {"with", agreement.with},
                                  {"unit", agreement.unit},
                                  {"difference", agreement.difference},
                                  {"expected", agreement.expected}});
    if (!status.ok()) one["agreement"].push_back({{"test", test}, {"status", status_json(status)}});
  }
  one["identifiability"] = initial.analysed ? json(initial.sentences) : json(nullptr);
  return one;
}

}  // namespace

json examination_json(const Examination& checked) {
  json document = {{"name", checked.experiment.name},  {"in_order", checked.good()},
                   {"seed", checked.experiment.seed},  {"warnings", json::array()},
                   {"warning_details", json::array()}, {"runs", json::array()},
                   {"notes", checked.notes},           {"problems", json::array()},
                   {"paths", json::array()},           {"understood", json::object()}};
  for (const auto& [test, lines] : checked.understood) document["understood"][test] = lines;
  for (const auto& path : checked.paths)
    document["paths"].push_back({{"test", path.test},
                                 {"ordered", path.ordered},
                                 {"past_known", path.past == data::Past::known},
                                 {"words", path.words}});
  for (const auto& warning : checked.warnings) {
    document["warnings"].push_back(warning.text());
    document["warning_details"].push_back(comparison::warning_json(warning));
  }
  for (const auto& run : checked.plan.runs)
    document["runs"].push_back({{"label", run.label},
                                {"realisations", run.entry->realisations},
                                {"max_evaluations", run.entry->stop.max_evaluations}});
  for (const auto& problem : checked.problems) {
    const auto& assembly = *problem.run->assembly;
    json one = {{"title", problem.title},
                {"model", checked.experiment.model_name(*problem.run->entry)},
                {"tests", problem.run->entry->tests},
                {"constraints", assembly.constraints().count()},
                {"exact_derivatives", assembly.layout().jacobian_is_exact},
                {"channels", json::array()}};
    for (const auto& channel : assembly.layout().channels) one["channels"].push_back(channel_json(channel));
    one["parameters"] = parameters_json(assembly);
    one["initial"] = initial_json(problem);
    document["problems"].push_back(std::move(one));
  }
  return document;
}

}  // namespace tunica::calibration
