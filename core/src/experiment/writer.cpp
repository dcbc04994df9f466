// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/quantities.hpp"
#include "experiment/enum_names.hpp"
#include "experiment/materials.hpp"
#include "experiment/reader.hpp"

namespace tunica::experiment {
namespace {

void add_options(Json& json, const Options& options, const std::vector<Option>& declared) {
  for (const Option& option : declared) {
    const Option::Value& value = options.values().find(option.name)->second;
    if (option.kind == Option::Kind::json)
      json[option.name] = Json::parse(std::get<std::string>(value));
    else
      std::visit([&](const auto& v) { json[option.name] = v; }, value);
  }
}

Json to_json(const ParameterSetting& setting) {
  Json json = Json::object();
  const auto add = [&json](const char* key, const std::optional<double>& value) {
    if (value) json[key] = *value;
  };
  add("min", setting.min);
  add("max", setting.max);
  add("initial", setting.initial);
  add("fixed", setting.fixed);
  if (setting.scale) json["scale"] = text::code_of(scale_names, *setting.scale);
  if (setting.share) json["share"] = *setting.share;
  if (setting.prior) json["prior"] = {{"mean", setting.prior->mean}, {"sd", setting.prior->sd}};
  return json;
}

Json to_json(const ParameterSettings& settings) {
  Json json = Json::object();
  for (const auto& [name, setting] : settings) json[name] = to_json(setting);
  return json;
}

std::string to_json(const data::RowRange& range) {
  return fmt::format("{}:{}:{}", range.first, range.last ? fmt::format("{}", *range.last) : "", range.step);
}

Json column_name(const std::string& name) {
  const auto position = data::column_position(name);
  return position ? Json(*position) : Json(name);
}

/// One value stands alone, several in a list.
void add_condition(Json& json, const std::string& value) {
  if (json.is_null())
    json = value;
  else if (json.is_array())
    json.push_back(value);
  else
    json = Json::array({json, value});
}

void add_sizes(Json& json, const data::Sizes& sizes) {
  if (sizes.width) json["width"] = *sizes.width;
  if (sizes.gauge_length) json["gauge_length"] = *sizes.gauge_length;
  if (sizes.grip_distance) json["grip_distance"] = *sizes.grip_distance;
}

std::string delimiter_name(char delimiter) {
  return delimiter == '\t' ? "tab" : delimiter == ' ' ? "space" : std::string(1, delimiter);
}

void add_rig_keys(Json& json, const data::DataRequest& data) {
  const data::TableLayout& layout = data.layout;
  if (layout.skip_lines) json["skip_lines"] = *layout.skip_lines;
  if (layout.delimiter) json["delimiter"] = delimiter_name(*layout.delimiter);
  if (layout.decimal) json["decimal"] = std::string(1, *layout.decimal);
  for (const auto& [column, unit] : layout.units) json["units"][column] = unit;
  const data::Specimen& specimen = data.specimen;
  Json sizes = Json::object();
  if (specimen.thickness) sizes["thickness"] = *specimen.thickness;
  if (specimen.area) sizes["area"] = *specimen.area;
  if (specimen.height) sizes["height"] = *specimen.height;
  add_sizes(sizes, specimen.all);
  if (specimen.gauge_at_preload) sizes["gauge_length"] = "preload";
  for (const auto& [direction, own] : specimen.directions) add_sizes(sizes[direction], own);
  if (!sizes.empty()) json["specimen"] = std::move(sizes);
  if (data.cycle) {
    json["cycle"] = data.cycle->last ? Json("last") : Json("all");
    if (!data.cycle->numbers.empty()) json["cycle"] = data.cycle->numbers;
  }
  if (!data.cycles_from.empty()) json["cycles_from"] = column_name(data.cycles_from);
  if (data.branch != data::BranchChoice::both) json["branch"] = text::code_of(data::branch_names, data.branch);
  if (data.preload) json["preload"] = data.preload->value;
  if (data.compression.all) json["compression"] = "positive";
  for (const std::string& column : data.compression.columns) json["compression"][column] = "positive";
  if (data.resample) json["resample"] = *data.resample;
}

Json to_json(const data::DataRequest& data) {
  Json json = Json::object();
  std::vector<std::string> files;
  for (const auto& file : data.files) files.push_back(std::filesystem::absolute(file).lexically_normal().string());
  if (files.size() == 1)
    json["file"] = files.front();
  else
    json["files"] = files;
  for (const auto& [observable, column] : data.columns) json["columns"][observable] = column_name(column);
  for (const auto& [observable, value] : data.constants) json["constant"][observable] = value;
  json["stress_measure"] = data.stress_measure;
  json["rows"] = to_json(data.rows);
  for (const auto& [column, value] : data.where) add_condition(json["where"][column], value);
  if (data.order != data::Order::unknown) json["order"] = text::code_of(data::order_names, data.order);
  if (data.time_rate) json["time_from"] = {{"rate", *data.time_rate}};
  for (const auto& [channel, noise] : data.noise)
    json["noise"][channel] = {
        {"absolute", noise.absolute}, {"relative", noise.relative}, {"correlation", noise.correlation}};
  add_rig_keys(json, data);
  return json;
}

/// The tables as they were read, with what was since taken out of the whole or changed in it.
Json tables_to_json(const data::DataRequest& data, const std::vector<Observable>& observables) {
  Json list = Json::array();
  const auto gives = [&](const auto& columns, const std::string& observable) {
    return std::ranges::any_of(columns, [&](const auto& column) {
      return data::quantity_named(column.first, observables)->observable->name == observable;
    });
  };
  for (data::DataRequest table : data.tables) {
    std::erase_if(table.columns, [&](const auto& column) {
      return !gives(data.columns, data::quantity_named(column.first, observables)->observable->name);
    });
    table.noise.clear();
    for (const auto& [name, noise] : data.noise)
      if (gives(table.columns, name)) table.noise.emplace_back(name, noise);
    list.push_back(to_json(table));
  }
  return list;
}

Json to_json(const Stop& stop) {
  Json json = Json::object();
  if (stop.max_evaluations != no_own_limit) json["max_evaluations"] = stop.max_evaluations;
  if (stop.max_time) json["max_time"] = *stop.max_time;
  if (stop.target) json["target"] = *stop.target;
  if (stop.stall) json["stall"] = *stop.stall;
  return json;
}

class Writer {
 public:
  explicit Writer(const plugins::Catalogue& catalogue) : catalogue_(catalogue) {}

  [[nodiscard]] Json mechanisms(const std::vector<MechanismEntry>& entries) const {
    Json list = Json::array();
    for (const MechanismEntry& entry : entries) {
      Json json = {{"type", entry.type}};
      if (!entry.as.empty()) json["as"] = entry.as;
      add_options(json, entry.options, catalogue_.mechanisms().find(entry.type)->second.factory.options);
      json["parameters"] = to_json(entry.parameters);
      list.push_back(std::move(json));
    }
    return list;
  }

  [[nodiscard]] Json model(const ModelEntry& entry) const {
    Json json = {{"type", entry.type}};
    if (entry.options.has(material_key)) json[material_key] = entry.options.text(material_key);
    add_options(json, entry.options, catalogue_.models().find(entry.type)->second.factory.options);
    json["parameters"] = to_json(entry.parameters);
    json["mechanisms"] = mechanisms(entry.mechanisms);
    return json;
  }

  /// A measure of stress stands only where there is a stress: without one the reader refuses it.
  [[nodiscard]] Json data(const TestEntry& entry) const {
    const auto& observables = catalogue_.tests().find(entry.type)->second.factory.observables;
    Json json = entry.data.tables.empty() ? to_json(entry.data) : tables_to_json(entry.data, observables);
    const auto has_stress = [&](const data::DataRequest& data) {
      return std::any_of(data.columns.begin(), data.columns.end(), [&](const auto& column) {
        const auto quantity = data::quantity_named(column.first, observables);
        return quantity && quantity->observable->kind == Observable::Kind::stress;
      });
    };
    if (json.is_object()) {
      if (entry.measured && !has_stress(entry.data)) json.erase("stress_measure");
    } else {
      for (std::size_t k = 0; k < json.size(); ++k)
        if (!has_stress(entry.data.tables[k])) json[k].erase("stress_measure");
    }
    return json;
  }

  [[nodiscard]] Json test(const TestEntry& entry) const {
    Json json = {{"type", entry.type}};
    add_options(json, entry.options, catalogue_.tests().find(entry.type)->second.factory.options);
    for (const LayerEntry& layer : entry.layers)
      json["layers"].push_back({{"model", layer.model}, {"thickness", layer.thickness}});
    if (!entry.state.empty()) json["state"] = entry.state;
    json["data"] = data(entry);
    json["weight"] = entry.weights;
    if (entry.hold_out.rows)
      json["hold_out"] = to_json(*entry.hold_out.rows);
    else
      json["hold_out"] = entry.hold_out.all;
    json["parameters"] = to_json(entry.parameters);
    json["mechanisms"] = mechanisms(entry.mechanisms);
    return json;
  }

  [[nodiscard]] static Json state(const StateEntry& entry) {
    Json json = Json::object();
    if (!entry.doc.empty()) json["doc"] = entry.doc;
    json["parameters"] = to_json(entry.differs);
    return json;
  }

  [[nodiscard]] Json optimizer(const OptimizerEntry& entry) const {
    Json json = Json::object();
    if (entry.stages.empty()) {
      json["type"] = entry.type;
      add_options(json, entry.options, catalogue_.optimizers().find(entry.type)->second.factory.options);
    }
    for (const OptimizerEntry::Stage& stage : entry.stages) {
      Json one = {{"optimizer", stage.optimizer}};
      if (stage.stop) one["stop"] = to_json(*stage.stop);
      json["stages"].push_back(std::move(one));
    }
    return json;
  }

 private:
  const plugins::Catalogue& catalogue_;
};

Json to_json(const RunEntry& run) {
  Json constraints = Json::array();
  for (const ConstraintEntry& constraint : run.constraints) constraints.push_back(Json::parse(constraint.json));
  Json json = Json::object();
  if (!run.model.empty()) json["model"] = run.model;
  json["optimizer"] = run.optimizer;
  json["realisations"] = run.realisations;
  json["initial"] = run.random_start ? "random" : "given";
  json["tests"] = run.tests;
  json["objective"] = text::code_of(objective_names, run.objective);
  json["constraints"] = std::move(constraints);
  json["stop"] = to_json(run.stop);
  json["fewer_simulations"] = {{"early_end", run.fewer_simulations.early_end}, {"guide", run.fewer_simulations.guide}};
  return json;
}

/// What every run has stands at the top level too, so that a run that is added or changed by hand has it as well.
void add_shared_by_runs(Json& json, const Json& runs) {
  for (const char* const key : {"objective", "constraints", "stop", "initial", "fewer_simulations"})
    if (std::all_of(runs.begin(), runs.end(), [&](const Json& run) { return run.at(key) == runs.front().at(key); }))
      json[key] = runs.front().at(key);
}

Json to_json(const Analysis& analysis) {
  Json json = Json::object();
  if (analysis.all_profiles)
    json["profiles"] = "all";
  else if (!analysis.profiles.empty())
    json["profiles"] = analysis.profiles;
  if (analysis.bootstrap_draws > 0) json["bootstrap"] = {{"draws", analysis.bootstrap_draws}};
  if (analysis.posterior_draws > 0) json["posterior"] = {{"draws", analysis.posterior_draws}};
  if (analysis.discrepancy) json["posterior"]["discrepancy"] = true;
  if (!analysis.optimizer.empty()) json["optimizer"] = analysis.optimizer;
  if (analysis.stability_to) json["stability"]["to"] = *analysis.stability_to;
  if (!analysis.stability_map.empty()) {
    json["stability"]["map"] = analysis.stability_map;
    json["stability"]["points"] = analysis.map_points;
  }
  return json;
}

Json to_json(const DiagnosisEntry& diagnosis) {
  Json json = Json::object();
  if (diagnosis.model) json["model"] = *diagnosis.model;
  if (diagnosis.optimizer) json["optimizer"] = *diagnosis.optimizer;
  if (diagnosis.alpha) json["alpha"] = *diagnosis.alpha;
  if (diagnosis.all_mechanisms) json["mechanisms"] = "all";
  if (!diagnosis.mechanisms.empty()) json["mechanisms"] = diagnosis.mechanisms;
  if (diagnosis.admissibility) json["admissibility"] = *diagnosis.admissibility;
  if (!diagnosis.groups.empty()) json["groups"] = diagnosis.groups;
  if (diagnosis.wrong_files) json["wrong_files"] = *diagnosis.wrong_files;
  for (const auto& [observable, text] : diagnosis.tolerance)
    (observable.empty() ? json["tolerance"] : json["tolerance"][observable]) = text;
  return json;
}

Json to_json(const DiscoveryEntry& discovery) {
  Json json = {{"from_nothing", discovery.from_nothing}};
  if (discovery.model) json["model"] = *discovery.model;
  if (!discovery.invariants.empty()) json["invariants"] = discovery.invariants;
  if (!discovery.laws.empty()) json["laws"] = discovery.laws;
  if (discovery.most_terms) json["most_terms"] = *discovery.most_terms;
  if (discovery.most_parameters) json["most_parameters"] = *discovery.most_parameters;
  if (discovery.alpha) json["alpha"] = *discovery.alpha;
  return json;
}

}  // namespace

std::string write_input(const Experiment& experiment, const plugins::Catalogue& catalogue) {
  const Writer writer(catalogue);
  Json json = Json::object();
  json["format"] = 1;
  json["name"] = experiment.name;
  json["seed"] = experiment.seed;
  for (const ModelEntry& entry : experiment.models) json["models"][entry.name] = writer.model(entry);
  for (const StateEntry& entry : experiment.states) json["states"][entry.name] = Writer::state(entry);
  for (const TestEntry& entry : experiment.tests) json["tests"][entry.name] = writer.test(entry);
  for (const OptimizerEntry& entry : experiment.optimizers) json["optimizers"][entry.name] = writer.optimizer(entry);
  Json runs = Json::array();
  for (const RunEntry& run : experiment.runs) runs.push_back(to_json(run));
  if (!runs.empty()) add_shared_by_runs(json, runs);
  if (experiment.paired_starts) json["paired_starts"] = true;
  json["runs"] = std::move(runs);
  json["on_failure"] = {{"policy", text::code_of(on_failure_names, experiment.on_failure)}};
  if (experiment.on_failure != OnFailure::stop) json["on_failure"]["max_rate"] = experiment.max_failure_rate;
  json["keep_evaluations"] = text::code_of(kept_evaluations_names, experiment.kept_evaluations);
  if (Json analysis = to_json(experiment.analysis); !analysis.empty()) json["analysis"] = std::move(analysis);
  if (experiment.diagnosis) json["diagnosis"] = to_json(*experiment.diagnosis);
  if (experiment.discovery) json["discovery"] = to_json(*experiment.discovery);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tunica::experiment
