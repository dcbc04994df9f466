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

// parameters.cpp, parameter_block.cpp
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

// model_block.cpp, mechanism_block.cpp
ModelEntry read_model(const std::string& name, const Node& entry, const plugins::Catalogue& catalogue,
                      std::vector<SharedParameter>& shared);
std::vector<MechanismEntry> read_model_mechanisms(const Node& entry, const std::string& owner,
                                                  const plugins::Catalogue& catalogue,
                                                  std::vector<SharedParameter>& shared,
                                                  std::vector<data::Finding>& findings);
/// `test_type` decides which apply.
std::vector<MechanismEntry> read_test_mechanisms(const Node& entry, const std::string& test_type,
                                                 const std::string& owner, const plugins::Catalogue& catalogue,
                                                 std::vector<SharedParameter>& shared,
                                                 std::vector<data::Finding>& findings);

// state_block.cpp
std::vector<StateEntry> read_states(const Node& node, const std::vector<ModelEntry>& models,
                                    const plugins::Catalogue& catalogue);
/// That the names of states begin no other names, and that every state has a test.
void check_states(const Node& node, const Experiment& experiment);

// test_block.cpp
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

// tables.cpp
/// The block "data" of a test, one table or several; relative names of files begin at `folder`.
data::DataRequest read_data(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                            const std::filesystem::path& folder);

// table_block.cpp
/// A file of a series and its number, which is the first prescribed quantity that every row needs and nothing gives.
using Numbered = std::pair<double, std::filesystem::path>;
data::DataRequest read_table(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                             const std::filesystem::path& folder, const std::optional<Numbered>& numbered);
/// "0:240:6", "-50:".
data::RowRange read_row_range(const Node& node);

// optimizer_block.cpp
std::vector<OptimizerEntry> read_optimizers(const Node& node, const plugins::Catalogue& catalogue);

// constraint_block.cpp
std::vector<ConstraintEntry> read_constraints(const Node& node);

// run_block.cpp
/// `defaults`: what a run has that does not state it. Tests that a run defines for itself are added to the experiment.
void read_runs(const Node& node, const RunEntry& defaults, const plugins::Catalogue& catalogue,
               std::vector<SharedParameter>& shared, Experiment& experiment);

// experiment_file.cpp
/// input.json: the experiment with every default filled in, numbers in base units, file names absolute.
std::string write_input(const Experiment& experiment, const plugins::Catalogue& catalogue);

}  // namespace tunica::experiment
