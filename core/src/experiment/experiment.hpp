// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/dataset.hpp"
#include "plugins/catalogue.hpp"
#include "tunica/options.hpp"
#include "tunica/parameter.hpp"

/// The experiment file as typed values: every name checked against the catalogue, every quantity in base units,
/// every default filled in. What the keys mean: docs/experiment-file.md.
namespace tunica::experiment {

struct Prior {
  double mean = 0, sd = 1;
};

/// The setting of one parameter in the file; an absent member keeps the plugin's declaration.
struct ParameterSetting {
  std::optional<double> min, max, initial, fixed;
  std::optional<Scale> scale;
  std::optional<std::string> share;
  std::optional<Prior> prior;
  std::string pointer;       ///< JSON pointer, for messages
  bool own_initial = false;  ///< the file gives `initial`; else it is the declared one
};
using ParameterSettings = std::map<std::string, ParameterSetting, std::less<>>;

struct MechanismEntry {
  std::string type;
  Options options;
  ParameterSettings parameters;  ///< the mechanism's own names, without its prefix
  std::string as = {};           ///< name of one of several of a type; empty = the type

  /// The prefix of its parameters.
  [[nodiscard]] const std::string& name() const { return as.empty() ? type : as; }
};

struct ModelEntry {
  std::string name, type;
  Options options;
  ParameterSettings parameters;
  std::vector<MechanismEntry> mechanisms;
  std::vector<data::Finding> findings = {};  ///< what the entry says and hardly means
};

/// Rows kept out of the fit and of the naming: none, all, or a range.
struct HoldOut {
  bool all = false;
  std::optional<data::RowRange> rows;
};

/// A layer of a wall, with a model of its own.
struct LayerEntry {
  std::string model;
  double thickness;  ///< mm
};

/// A state of the specimen, of tone, calcium, temperature or treatment: in its tests these parameters of the model
/// have values of their own, and all others are those of the other tests.
struct StateEntry {
  std::string name;
  std::string doc;            ///< what was done to the specimen, for readers; may be empty
  ParameterSettings differs;  ///< by the names that results have; what is silent is as in the model
};

struct TestEntry {
  std::string name, type;
  Options options;
  std::vector<LayerEntry> layers;  ///< from inside; empty = the run's model
  ParameterSettings parameters;
  std::vector<MechanismEntry> mechanisms;
  std::string state = {};  ///< of the specimen, an entry of "states"; empty = that of the models
  data::DataRequest data;
  std::vector<double> weights;  ///< one per mapped channel, in the order of data.columns' channels
  HoldOut hold_out;
  bool measured = true;               ///< false: no measured quantity is mapped, so that its rows are predicted only
  std::filesystem::path folder = {};  ///< where files that options name are looked for, absolute
  std::vector<data::Finding> findings = {};  ///< what the entry says and hardly means
};

enum class ObjectiveType { standardised_quadratic, least_squares, sum_of_norms };
enum class OnFailure { penalise, stop, retry };
/// What evaluations.csv holds once the results are written.
enum class KeptEvaluations { all, improvements };

/// The factor h of the sub-critical stability constraint over stretch; one row = a constant.
using StabilityFactor = std::vector<std::pair<double, double>>;

struct ConstraintEntry {
  std::string type;                     ///< "transverse_stability", "admissible_parameters"
  std::string json = {}, pointer = {};  ///< pointer: with file and line
  // transverse_stability
  StabilityFactor h = {{1, 1}};
  std::optional<std::pair<double, double>> range = {};  ///< stretches, besides the measured ones
  std::optional<std::size_t> points = {};               ///< evenly spaced stretches in place of every measured one
  std::array<bool, 2> directions = {true, true};        ///< circumferential, axial
};

/// max_evaluations of a stage that has no limit of its own: what is left of the shared one.
constexpr std::uint64_t no_own_limit = std::numeric_limits<std::uint64_t>::max();

struct Stop {
  std::uint64_t max_evaluations = 60000;
  std::optional<double> max_time;      ///< s
  std::optional<double> target;        ///< objective
  std::optional<std::uint64_t> stall;  ///< evaluations without improvement
};

struct OptimizerEntry {
  struct Stage {
    std::string optimizer;  ///< name of another entry
    std::optional<Stop> stop;
  };
  std::string name, type;  ///< type is "stages" when stages is not empty
  Options options;
  std::vector<Stage> stages;
};

/// What spares simulations of costly tests; docs/optimizers.md explains both.
struct FewerSimulations {
  bool early_end = true;  ///< an offspring that its cheap tests put out of question is not simulated
  bool guide = false;     ///< cheaper tests stand in while the search looks around
};

struct RunEntry {
  std::string model;  ///< of the tests that name no layers; empty = every one does
  std::string optimizer;
  std::uint64_t realisations = 1;
  bool random_start = false;       ///< every realisation begins at a random point, not at the initial values
  std::vector<std::string> tests;  ///< names, in file order; all unless overridden
  ObjectiveType objective = ObjectiveType::standardised_quadratic;
  std::vector<ConstraintEntry> constraints;
  Stop stop;
  FewerSimulations fewer_simulations;
};

/// The block "diagnosis"; an absent member leaves the diagnosis its default.
struct DiagnosisEntry {
  std::optional<std::string> model, optimizer;  ///< entries of "models", "optimizers"
  std::optional<double> alpha;                  ///< level of significance
  bool all_mechanisms = false;                  ///< "all", said outright
  std::vector<std::string> mechanisms;          ///< those to consider; empty = all
  std::optional<bool> admissibility;            ///< whether lost stability changes the verdict
  std::vector<std::string> groups;              ///< of causes to consider; empty = all
  std::optional<double> wrong_files;            ///< share of files that are expected to say what is not so
  /// The tolerated misfit: observable (empty = all) and "2 %" of its range, or a quantity in its unit.
  std::vector<std::pair<std::string, std::string>> tolerance = {};
};

/// Where causes may lie, as "diagnosis" names it.
inline const std::vector<std::string> cause_groups{"material", "rig", "file"};

/// What a term may be a function of, as "discovery" names it.
inline const std::vector<std::string> discovery_invariants{"I1",
                                                           "I2",
                                                           "stretches",
                                                           "fibre axial",
                                                           "fibre circumferential",
                                                           "fibre diagonal",
                                                           "I1*I2",
                                                           "I1^2*I2",
                                                           "I1*I2^2",
                                                           "I1bar",
                                                           "I2bar",
                                                           "fibrebar axial",
                                                           "fibrebar circumferential",
                                                           "fibrebar diagonal",
                                                           "J"};

/// How a term may grow, as "discovery" names it: the laws of `composed`.
inline const std::vector<std::string> discovery_laws{
    "linear",    "quadratic", "cubic",       "power", "exponential", "exponential_square", "gent", "inverse_langevin",
    "logarithm", "spline",    "logarithmic", "simo",  "ogden"};

/// The block "discovery"; an absent member leaves the discovery its default.
struct DiscoveryEntry {
  std::optional<std::string> model;     ///< an entry of "models"
  bool from_nothing = false;            ///< the terms make up the whole energy
  std::vector<std::string> invariants;  ///< those to consider; empty = what suits the model
  std::vector<std::string> laws;        ///< those to consider; empty = all
  std::optional<std::size_t> most_terms, most_parameters;
  std::optional<double> alpha;  ///< level of significance
};

/// The requested analyses of uncertainty at every run's best point, besides the Laplace intervals.
struct Analysis {
  bool all_profiles = false;
  std::vector<std::string> profiles;  ///< parameters as results name them; checked where the run is planned
  std::uint64_t bootstrap_draws = 0;  ///< 0 = no bootstrap
  std::uint64_t posterior_draws = 0;  ///< of all chains together; 0 = none
  bool discrepancy = false;           ///< the posterior allows for a smooth misfit
  std::string optimizer;              ///< an entry of "optimizers"; empty = ceres_lm from the best point
  std::optional<double>
      stability_to;  ///< judge ellipticity and Drucker to this stretch instead of the largest measured
  std::vector<std::string> stability_map;  ///< two parameters, or none
  std::size_t map_points = 41;             ///< along each

  /// Where the file names a parameter of `profiles` or of `stability_map`, for messages; the command line names the
  /// rest.
  std::map<std::string, std::string, std::less<>> profile_places, map_places;

  [[nodiscard]] std::string profile_place(std::string_view name) const {
    const auto found = profile_places.find(name);
    return found == profile_places.end() ? "--profiles" : found->second;
  }
  /// Whether something is to be fitted again.
  [[nodiscard]] bool refits() const { return all_profiles || !profiles.empty() || bootstrap_draws > 0; }
  [[nodiscard]] bool wanted() const { return refits() || posterior_draws > 0; }
};

struct Experiment {
  std::string name;
  std::filesystem::path file;
  std::uint64_t seed = 1;
  bool paired_starts = false;  ///< runs of the same parameters and bounds begin their searches at the same points
  std::vector<ModelEntry> models;
  std::vector<StateEntry> states = {};
  std::vector<TestEntry> tests;
  std::vector<OptimizerEntry> optimizers;
  std::vector<RunEntry> runs;
  OnFailure on_failure = OnFailure::penalise;
  double max_failure_rate = 1;  ///< share of failed evaluations above which a run stops
  KeptEvaluations kept_evaluations = KeptEvaluations::all;
  Analysis analysis;
  std::optional<DiagnosisEntry> diagnosis;
  std::optional<DiscoveryEntry> discovery;
  std::string input_json;      ///< the file with defaults filled in: input.json
  bool only_predicts = false;  ///< the file has no runs: those here stand in for them

  [[nodiscard]] const ModelEntry& model(std::string_view name) const;
  [[nodiscard]] const TestEntry& test(std::string_view name) const;
  [[nodiscard]] const StateEntry& state(std::string_view name) const;
  /// States of the run's tests, each once.
  [[nodiscard]] std::vector<std::string> states_of(const RunEntry& run) const;
  [[nodiscard]] const OptimizerEntry& optimizer(std::string_view name) const;
  /// The run's own, then those that layers of its tests name, each once.
  [[nodiscard]] std::vector<std::string> models_of(const RunEntry& run) const;
  /// What results call the model of a run: its own, or "media+adventitia" where only layers name some.
  [[nodiscard]] std::string model_name(const RunEntry& run) const;
};

/// Without the tests that have no measured value, and the runs that are left without a test.
Experiment measured_only(Experiment experiment);

/// The purpose of reading an experiment. A search needs optimizers and runs; a prediction needs only models and tests,
/// and where the file has no runs, every model gets one over all tests.
enum class Purpose { search, prediction };

/// Parses, validates and types an experiment file. Throws InputError: each message quotes what was found, names JSON
/// pointer and line, and says what is expected; unknown names list the nearest valid one.
Experiment read_experiment(const std::filesystem::path& file, const plugins::Catalogue& catalogue,
                           Purpose purpose = Purpose::search);

/// The JSON Schema (draft 7) of experiment files, composed from what the loaded plugins declare; JSON text.
std::string compose_schema(const plugins::Catalogue& catalogue);

}  // namespace tunica::experiment
