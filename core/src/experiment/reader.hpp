// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment/experiment.hpp"
#include "experiment/json_node.hpp"

/// The parts of the reader; each takes the node of its block and gives it typed, or throws through the node.
namespace tunica::experiment {

/// The names in one part of the catalogue, for messages and look-up.
template <class Entries>
std::vector<std::string> names_of(const Entries& entries) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const auto& entry : entries) names.push_back(entry.first);
  return names;
}

template <class Entry>
std::vector<std::string> entry_names(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

// reader_options.cpp
/// The options of a plugin object stand as plain keys beside `reserved` ones; declared ones that are absent take their
/// default. `owner` is "model 'gho'".
Options read_options(const Node& entry, const std::vector<Option>& declared, std::vector<std::string> reserved,
                     std::string_view owner);

// reader_parameters.cpp
/// One parameter in a share group, wherever in the file it stands.
struct SharedParameter {
  std::string group, unit;  ///< unit "" = not known before the test is built
  ParameterSetting setting;
  Node node;
};

/// The block "parameters" of `entry`, completed: every declared parameter is fixed, or has bounds, initial and scale.
ParameterSettings read_parameters(const Node& entry, const std::vector<Parameter>& declared, std::string_view owner,
                                  std::vector<SharedParameter>& shared);
/// The same for the own parameters of a test, but those that the file mentions only: an imperfection that it does not
/// mention stays at its null.
ParameterSettings read_mentioned_parameters(const Node& entry, const std::vector<Parameter>& declared,
                                            std::string_view owner, std::vector<SharedParameter>& shared);
void check_shared(const std::vector<SharedParameter>& shared);
/// One parameter as the file has it, nothing filled in. `name` is for messages.
ParameterSetting read_setting(const Node& node, const std::string& name, std::string_view unit);

// angles.cpp
/// Angles of an entry that stand without a unit and look like radians.
std::vector<data::Finding> bare_angles(const Node& entry, const std::vector<Option>& options,
                                       const std::vector<Parameter>& parameters, std::string_view owner);

// sizes.cpp
/// Lengths of a test and its specimen that none has, as a wrong unit makes them.
std::vector<data::Finding> odd_sizes(const Node& entry, const TestEntry& test, const std::vector<Option>& options,
                                     std::string_view owner);

// reader_models.cpp
ModelEntry read_model(const std::string& name, const Node& entry, const plugins::Catalogue& catalogue,
                      std::vector<SharedParameter>& shared);
/// Test mechanisms; `test_type` decides which apply.
std::vector<MechanismEntry> read_test_mechanisms(const Node& entry, const std::string& test_type,
                                                 std::string_view owner, const plugins::Catalogue& catalogue,
                                                 std::vector<SharedParameter>& shared,
                                                 std::vector<data::Finding>& findings);

// reader_states.cpp
std::vector<StateEntry> read_states(const Node& node, const std::vector<ModelEntry>& models,
                                    const plugins::Catalogue& catalogue);
/// That the names of states begin no other names, and that every state has a test.
void check_states(const Node& node, const Experiment& experiment);

// reader_tests.cpp
/// What a test may name: models for its layers, and a state.
struct NamedEntries {
  std::vector<std::string> models, states;
};
inline NamedEntries entries_to_name(const Experiment& experiment) {
  return {entry_names(experiment.models), entry_names(experiment.states)};
}
TestEntry read_test(const std::string& name, const Node& entry, const std::filesystem::path& folder,
                    const NamedEntries& named, const plugins::Catalogue& catalogue,
                    std::vector<SharedParameter>& shared);

// reader_tables.cpp
/// The block "data" of a test, one table or several; relative names of files begin at `folder`.
data::DataRequest read_data(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                            const std::filesystem::path& folder);

// reader_data.cpp
/// A file of a series and its number, which is the first prescribed quantity that every row needs and nothing gives.
using Numbered = std::pair<double, std::filesystem::path>;
data::DataRequest read_table(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                             const std::filesystem::path& folder, const std::optional<Numbered>& numbered);
/// "0:240:6", "-50:".
data::RowRange read_row_range(const Node& node);

// reader_rig.cpp
/// The keys of "data" for files as a testing machine writes them, and how to read them; after "columns".
const std::vector<std::string>& rig_keys();
void read_rig_keys(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                   data::DataRequest& data);
/// A name, or the number of a column as data::column_position has it.
std::string read_column_name(const Node& node);
void read_where(const Node& node, data::DataRequest& data);

// reader_optimizers.cpp
/// `default_evaluations`: the limit where the block names none.
Stop read_stop(const Node& node, std::uint64_t default_evaluations = Stop{}.max_evaluations);
std::vector<OptimizerEntry> read_optimizers(const Node& node, const plugins::Catalogue& catalogue);

// reader_runs.cpp
ObjectiveType read_objective(const Node& node);
std::vector<ConstraintEntry> read_constraints(const Node& node);
void read_on_failure(const Node& node, Experiment& experiment);
KeptEvaluations read_kept_evaluations(const Node& node);
/// What a run takes where it overrides nothing.
struct RunDefaults {
  std::vector<std::string> tests;
  ObjectiveType objective = ObjectiveType::standardised_quadratic;
  std::vector<ConstraintEntry> constraints;
  Stop stop;
  bool random_start = false;
  FewerSimulations fewer_simulations;
};
FewerSimulations read_fewer_simulations(const Node& node);
/// "given" or "random": true for random.
bool read_initial(const Node& node);
/// Tests that a run defines for itself are added to the experiment.
void read_runs(const Node& node, const RunDefaults& defaults, const plugins::Catalogue& catalogue,
               std::vector<SharedParameter>& shared, Experiment& experiment);
/// "analysis": profiles, bootstrap, optimizer; needs the optimizers.
void read_analysis(const Node& node, Experiment& experiment);
DiagnosisEntry read_diagnosis(const Node& node, const Experiment& experiment, const plugins::Catalogue& catalogue);
DiscoveryEntry read_discovery(const Node& node, const Experiment& experiment);

// writer.cpp
/// input.json: the experiment with every default filled in, numbers in base units, file names absolute.
std::string write_input(const Experiment& experiment, const plugins::Catalogue& catalogue);

}  // namespace tunica::experiment
