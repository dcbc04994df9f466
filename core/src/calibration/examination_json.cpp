// SPDX-License-Identifier: Apache-2.0
#include "calibration/examination_json.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "comparison/result_json.hpp"
#include "results/keys.hpp"

namespace tunica::calibration {

namespace key = results::key;

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
  json one = {{key::test, channel.test},  {key::observable, channel.observable},    {key::unit, channel.unit},
              {key::rows, channel.count}, {key::held_out, channel.held_out_rows()}, {key::weight, channel.weight}};
  std::vector<double> values = channel.measured;
  std::erase_if(values, [](double value) { return std::isnan(value); });
  one[key::measured] = values.size();
  if (channel.count > 0) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const auto [first, last] = std::minmax_element(channel.abscissa.begin(), channel.abscissa.end());
    one[key::range] = values.empty() ? json(nullptr) : json{*low, *high};
    one[key::over] = {
        {key::name, channel.abscissa_name}, {key::unit, channel.abscissa_unit}, {key::range, {*first, *last}}};
  }
  one[key::noise] = nullptr;
  if (channel.noise)
    one[key::noise] = {{key::absolute, channel.noise->absolute}, {key::relative, channel.noise->relative}};
  return one;
}

json parameters_json(const assembly::Assembly& assembly) {
  json all = json::object();
  for (const auto& parameter : assembly.layout().parameters) {
    auto& one = all[parameter.name] = {{key::unit, parameter.unit},
                                       {key::initial, parameter.initial},
                                       {key::min, parameter.min},
                                       {key::max, parameter.max},
                                       {key::scale, parameter.scale == Scale::log ? "log" : "linear"}};
    if (parameter.prior) one[key::prior] = {{key::mean, parameter.prior->mean}, {key::sd, parameter.prior->sd}};
  }
  for (const auto& parameter : assembly.layout().fixed_parameters)
    all[parameter.name] = {{key::unit, parameter.unit}, {key::fixed, parameter.value}};
  return all;
}

json initial_json(const calibration::PosedProblem& problem) {
  const auto& initial = problem.initial;
  if (!initial.not_run.empty()) return {{key::status, nullptr}, {key::not_run, initial.not_run}};
  json one = {{key::status, status_json(initial.status)}};
  if (initial.status.kind() == Status::Kind::failed) return one;
  one[key::objective] = initial.objective;
  one[key::per_test] = json::object();
  for (std::size_t test = 0; test < initial.per_test.size(); ++test)
    one[key::per_test][problem.run->entry->tests[test]] = initial.per_test[test];
  one[key::seconds] = initial.seconds;
  one[key::agreement] = json::array();
  for (const auto& [test, found, status] : initial.other_means) {
    for (const auto& agreement : found)
      one[key::agreement].push_back({{key::test, test},
                                     {key::with, agreement.with},
                                     {key::unit, agreement.unit},
                                     {key::difference, agreement.difference},
                                     {key::expected, agreement.expected}});
    if (!status.ok()) one[key::agreement].push_back({{key::test, test}, {key::status, status_json(status)}});
  }
  one[key::identifiability] = initial.analysed ? json(initial.sentences) : json(nullptr);
  return one;
}

}  // namespace

json examination_json(const Examination& checked) {
  json document = {{key::name, checked.experiment.name},  {key::in_order, checked.good()},
                   {key::seed, checked.experiment.seed},  {key::warnings, json::array()},
                   {key::warning_details, json::array()}, {key::runs, json::array()},
                   {key::notes, checked.notes},           {key::problems, json::array()},
                   {key::paths, json::array()},           {key::understood, json::object()}};
  for (const auto& [test, lines] : checked.understood) document[key::understood][test] = lines;
  for (const auto& path : checked.paths)
    document[key::paths].push_back({{key::test, path.test},
                                    {key::ordered, path.ordered},
                                    {key::past_known, path.past == data::Past::known},
                                    {key::words, path.words}});
  for (const auto& warning : checked.warnings) {
    document[key::warnings].push_back(warning.text());
    document[key::warning_details].push_back(comparison::warning_json(warning));
  }
  for (const auto& run : checked.plan.runs)
    document[key::runs].push_back({{key::label, run.label},
                                   {key::realisations, run.entry->realisations},
                                   {key::max_evaluations, run.entry->stop.max_evaluations}});
  for (const auto& problem : checked.problems) {
    const auto& assembly = *problem.run->assembly;
    json one = {{key::title, problem.title},
                {key::model, checked.experiment.model_name(*problem.run->entry)},
                {key::tests, problem.run->entry->tests},
                {key::constraints, assembly.constraints().count()},
                {key::exact_derivatives, assembly.layout().jacobian_is_exact},
                {key::channels, json::array()}};
    for (const auto& channel : assembly.layout().channels) one[key::channels].push_back(channel_json(channel));
    one[key::parameters] = parameters_json(assembly);
    one[key::initial] = initial_json(problem);
    document[key::problems].push_back(std::move(one));
  }
  return document;
}

}  // namespace tunica::calibration
