// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/constraints.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::calibration {

/// Which of the rows of a test are fitted: those that are not held out.
std::vector<bool> fitted_rows(const experiment::TestEntry& entry, std::size_t count);

/// Bounds that the owner of a parameter declares: outside of them it may mean nothing.
struct DeclaredRange {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool contains(double value) const { return value >= min && value <= max; }
};

/// A parameter the run searches for, with its name as the outside sees it: "mu", "viscoelasticity.tau",
/// "circumferential_strip.force_offset.value"; base units.
struct FreeParameter {
  std::string name, unit;
  double min, max, initial;
  Scale scale;
  std::optional<experiment::Prior> prior;
  DeclaredRange declared = {};
};

struct FixedParameter {
  std::string name, unit;
  double value;
  DeclaredRange declared = {};
};

/// One channel of one test: where its rows lie in the vector of all predictions.
struct ChannelView {
  std::string test, observable, unit;
  std::size_t offset = 0, count = 0;  ///< rows [offset, offset + count) of the predictions
  std::vector<double> measured;       ///< count
  std::vector<double> abscissa;       ///< count; the test's first abscissa, for plots and messages
  std::string abscissa_name, abscissa_unit;
  /// "name [unit]" → count values
  std::vector<std::pair<std::string, std::vector<double>>> other_abscissae;
  std::vector<bool> fitted;  ///< count; false = held out
  double weight = 1;
  std::optional<data::Noise> noise;  ///< of `measured`, as stated; a mean over m replicates has 1/√m of it
};

/// One run's models (with mechanisms) and tests (bound to their data), from parameters to predictions, residuals and
/// objective. Const and thread-safe after construction; each thread brings a workspace, evaluation allocates nothing.
class Assembly {
 public:
  class Workspace;  ///< scratch of one thread
  struct WorkspaceDeleter {
    void operator()(Workspace* workspace) const;
  };
  using WorkspacePointer = std::unique_ptr<Workspace, WorkspaceDeleter>;

  /// Reads the data, builds model and tests through the plugins' factories, binds names, shares and fixed values.
  /// Throws InputError, and plugins::PluginFailure where a plugin breaks its promise.
  Assembly(const experiment::Experiment& experiment, const experiment::RunEntry& run,
           const plugins::Catalogue& catalogue);
  ~Assembly();

  [[nodiscard]] const std::vector<FreeParameter>& parameters() const;
  [[nodiscard]] const std::vector<FixedParameter>& fixed_parameters() const;
  [[nodiscard]] const std::vector<ChannelView>& channels() const;
  [[nodiscard]] std::size_t test_count() const;                    ///< tests of the run: entries of per_test
  [[nodiscard]] std::size_t prediction_count() const;              ///< Σ channel counts, held-out rows included
  [[nodiscard]] const std::vector<ResidualBlock>& blocks() const;  ///< one a fitted channel, one more for priors
  [[nodiscard]] std::size_t residual_count() const;                ///< fitted rows and priors
  [[nodiscard]] const std::vector<std::string>& warnings() const;
  [[nodiscard]] const std::vector<std::string>& data_hashes() const;  ///< "circ.csv sha256:…"
  /// Known invariances of the models, arguments as indices into parameters(); value() takes the free values.
  [[nodiscard]] const std::vector<Combination>& combinations() const;
  [[nodiscard]] bool jacobian_is_exact() const;  ///< false: some test's predictions are differenced
  [[nodiscard]] bool has_costly_tests() const;   ///< some fitted test declares itself costly

  [[nodiscard]] WorkspacePointer make_workspace() const;

  /// All predictions (prediction_count) and, unless empty, their Jacobian by the free parameters, row-major
  /// [i·n + j]. `free` are parameter values in base units. Exact where the model has parameter derivatives; else
  /// central differences of whole predictions, one-sided (second order) at bounds, step ε^(1/3)·|p| (linear scale: of
  /// at least a hundredth of the range).
  Status predict(std::span<const double> free, std::span<double> predictions, std::span<double> jacobian,
                 Workspace& workspace) const;
  /// Puts a question to one test at these parameters; what it throws becomes a failure.
  Status ask(std::size_t test, std::span<const double> free,
             const std::function<Status(const Test&, const TestInput&)>& question) const;
  /// Diagnostics of one test at these parameters, name → row values (transverse stretch, iterations).
  Status diagnostics(std::size_t test, std::span<const double> free,
                     std::vector<std::pair<std::string, std::vector<double>>>& rows) const;
  /// Objective, per-test cost (one per test of the run, holding out excluded) and, unless empty, residuals and their
  /// Jacobian by the free parameters, row-major. Never NaN under ok. Infeasible, with all of these set, where a
  /// constraint exceeds Problem::constraint_tolerance; the reason names the one that is broken most.
  ///
  /// Cheap tests come first, then the constraints, costly tests last (Canales et al. 2023, Figure 7). With
  /// `skip_costly` and no residuals asked for, an infeasible point is not simulated in costly tests: their per_test is
  /// NaN and the objective that of the others.
  Status evaluate(std::span<const double> free, double& objective, std::span<double> per_test,
                  std::span<double> residuals, std::span<double> jacobian, Workspace& workspace,
                  bool skip_costly = false) const;

  /// From now on evaluate() in this workspace compares with these values, in the layout of the predictions, instead of
  /// the data: draws of a bootstrap, synthetic data. σ and ranges stay those of the data. Empty = the data again.
  void measure(std::span<const double> values, Workspace& workspace) const;

  /// A residual row is r = own e_k − previous e_{k−1}, e = prediction − measured: the transpose of that map, from one
  /// value a residual (priors left out) to one a prediction.
  void transpose_residuals(std::span<const double> by_residual, std::span<double> by_prediction) const;

  [[nodiscard]] std::size_t constraint_count() const;
  /// c(p) ≤ 0 (constraint_count) and, unless empty, its Jacobian by the free parameters, row-major.
  Status constraints(std::span<const double> free, std::span<double> values, std::span<double> jacobian) const;
  /// Infeasible, with its violation, where a constraint exceeds Problem::constraint_tolerance: evaluate()'s verdict.
  Status feasibility(std::span<const double> free, Workspace& workspace) const;
  /// What is broken when constraint i is positive, in words.
  [[nodiscard]] std::string constraint_words(std::size_t i, double value) const;

  /// Models of the run with their mechanisms: its own first, then those of layers.
  [[nodiscard]] std::size_t model_count() const;
  [[nodiscard]] const std::string& model_name(std::size_t model) const;
  [[nodiscard]] const Model& model(std::size_t model) const;
  /// All parameters of a model, in its order.
  [[nodiscard]] std::vector<double> model_parameters(std::size_t model, std::span<const double> free) const;
  [[nodiscard]] const std::vector<Strip>& strips() const;  ///< free strips among the tests
  [[nodiscard]] double largest_stretch() const;  ///< among the abscissae of all tests and stated ranges; 1 = none

  /// Unit box ↔ parameters: linear or logarithmic between the bounds.
  void from_unit(std::span<const double> x, std::span<double> free) const;
  void to_unit(std::span<const double> free, std::span<double> x) const;
  [[nodiscard]] std::vector<double> initial_unit() const;
  /// Turns a Jacobian by the free parameters, row-major, into one by the unit box: times max − min, or p log(max/min).
  void jacobian_to_unit(std::span<const double> free, std::span<double> jacobian, Workspace& workspace) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tunica::calibration
