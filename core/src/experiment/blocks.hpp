// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "experiment/block.hpp"
#include "experiment/experiment.hpp"
#include "experiment/reader.hpp"

/// The blocks of an experiment file. What a key may name depends on the file and on the plugins; for the schema an
/// empty experiment will do.
namespace tunica::experiment {

// option_keys.cpp
Option::Value read_option(const Node& node, const Option& option);
Json write_option(const Option& option, const Options& options);
/// The defaults of options; throws InputError where the entry lacks one that has none.
Options default_options(const Node& entry, const std::vector<Option>& declared, std::string_view owner);

/// "type" and the options of an entry that a plugin serves, which are plain keys beside others.
template <class T>
std::vector<Key<T>> keys_of_plugin(const std::string& type, const std::vector<Option>& options) {
  std::vector<Key<T>> keys = {required<T>({"type",
                                           [type] {
                                             Json schema = Json::object();
                                             schema["const"] = type;
                                             return schema;
                                           },
                                           {},
                                           [](const T& entry) { return Json(entry.type); }})};
  for (const Option& option : options) {
    Key<T> key{option.name, [&option] { return option_schema(option); },
               [&option](const Node& node, T& entry) { entry.options.set(option.name, read_option(node, option)); },
               [&option](const T& entry) { return write_option(option, entry.options); }};
    key.required = !option.fallback;
    keys.push_back(std::move(key));
  }
  return keys;
}

// model_block.cpp, mechanism_block.cpp
Json write_model(const ModelEntry& entry, const plugins::Catalogue& catalogue);
void define_models(Json& definitions, const plugins::Catalogue& catalogue);
Json write_mechanisms(const std::vector<MechanismEntry>& entries, const plugins::Catalogue& catalogue);
Json model_mechanisms_schema(const plugins::Catalogue& catalogue);
Json test_mechanisms_schema(const std::string& test_type, const plugins::Catalogue& catalogue);
void define_mechanisms(Json& definitions, const plugins::Catalogue& catalogue);

// state_block.cpp
Json write_state(const StateEntry& entry);
Json states_schema();

// test_block.cpp, layer_block.cpp
Json write_test(const TestEntry& entry, const plugins::Catalogue& catalogue);
void define_tests(Json& definitions, const plugins::Catalogue& catalogue);
std::vector<LayerEntry> read_layers(const Node& entry, const std::string& type, const std::vector<std::string>& models,
                                    const plugins::Catalogue& catalogue);
Key<TestEntry> layers_key();

// optimizer_block.cpp
Json write_optimizer(const OptimizerEntry& entry, const plugins::Catalogue& catalogue);
void define_optimizers(Json& definitions, const plugins::Catalogue& catalogue);

// search_blocks.cpp
Block<Stop> stop_block();
Block<FewerSimulations> fewer_simulations_block();
/// As an object; a policy alone is text.
Block<Experiment> on_failure_block();

// constraint_block.cpp
Json constraints_schema();

// run_block.cpp
/// What a run may state for itself, and the file for all that do not.
std::vector<Key<RunEntry>> keys_of_all_runs();
Json runs_schema(const plugins::Catalogue& catalogue);
Json write_runs(const Experiment& experiment, const plugins::Catalogue& catalogue);

// analysis_block.cpp, diagnosis_blocks.cpp
Block<Analysis> analysis_block(const Experiment& experiment);
Block<DiagnosisEntry> diagnosis_block(const Experiment& experiment, const plugins::Catalogue& catalogue);
Block<DiscoveryEntry> discovery_block(const Experiment& experiment);

// tables.cpp, table_block.cpp: measured data
Json write_data(const data::DataRequest& data, const std::vector<Observable>& observables);
void define_data(Json& definitions);
Json table_schema(const std::vector<Observable>& observables);
Json write_table(const data::DataRequest& data, const std::vector<Observable>& observables);
std::string write_row_range(const data::RowRange& range);

// column_keys.cpp
Key<data::DataRequest> columns_key(const std::vector<Observable>& observables, const std::string& owner);
Key<data::DataRequest> constant_key(const std::vector<Observable>& observables, const std::string& owner);
void read_number(const Node& block, const std::vector<Observable>& observables, std::string_view owner, double number,
                 data::DataRequest& data);

// noise_block.cpp
Json noise_schema();
Key<data::DataRequest> noise_key(const std::vector<Observable>& observables);

// rig_keys.cpp: files as a testing machine writes them
std::vector<Key<data::DataRequest>> rig_keys(const std::vector<Observable>& observables);
Json column_schema(std::string_view description);
/// A name, or the number of a column as data::column_position has it.
std::string read_column_name(const Node& node);
Json write_column_name(const std::string& name);

// specimen_block.cpp
/// `at_preload`: there is a preload that a gauge length may refer to.
Block<data::Specimen> specimen_block(const std::vector<Observable>& observables, bool at_preload);
void check_specimen(const Node& node, const data::Specimen& specimen);
/// Every size that is needed is there, and none that nothing reads.
void check_sizes(const Node& block, std::string_view owner, const std::vector<Observable>& observables,
                 const data::DataRequest& data);

// parameter_block.cpp
Json parameter_schema();
Json write_parameters(const ParameterSettings& settings);

}  // namespace tunica::experiment
