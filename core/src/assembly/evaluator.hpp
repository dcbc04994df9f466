// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "assembly/layout.hpp"
#include "tunica/status.hpp"
#include "tunica/test.hpp"

namespace tunica::assembly {

class Constraints;
class Models;
struct ChannelObjective;
struct PriorRow;
struct RunTest;
struct SecantMemory;

class Workspace;  ///< scratch of one thread
struct WorkspaceDeleter {
  void operator()(Workspace* workspace) const;
};
using WorkspacePointer = std::unique_ptr<Workspace, WorkspaceDeleter>;

/// Where costly tests are simulated.
enum class CostlyTests {
  everywhere,
  where_feasible,  ///< not where a constraint is violated
  nowhere          ///< the objective is then a lower bound
};

/// Maps free parameter values, in base units, to predictions, residuals and objective of a run. Const and thread-safe:
/// each thread passes its own workspace. Evaluation allocates nothing unless it has to difference a test. It keeps
/// references to its constructor's arguments.
class Evaluator {
 public:
  Evaluator(const Layout& layout, const Models& models, const Constraints& constraints, std::vector<RunTest> tests,
            std::vector<ChannelObjective> fitted, std::vector<PriorRow> priors);
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;
  ~Evaluator();

  [[nodiscard]] WorkspacePointer make_workspace() const;

  /// All predictions (prediction_count) and, unless empty, their Jacobian by the free parameters, row-major
  /// [i·n + j]. Exact where the model has parameter derivatives; else central differences of whole predictions,
  /// one-sided (second order) at bounds, step ε^(1/3)·|p| (linear scale: of at least a hundredth of the range).
  Status predict(std::span<const double> free, std::span<double> predictions, std::span<double> jacobian,
                 Workspace& workspace) const;
  /// Objective, per-test cost (one per test of the run, holding out excluded) and, unless empty, residuals and their
  /// Jacobian by the free parameters, row-major. Never NaN under ok. Infeasible, with all of these set, where a
  /// constraint exceeds Problem::constraint_tolerance; the reason names the most violated one.
  ///
  /// Cheap tests come first, then the constraints, costly tests last (Canales et al. 2023, Figure 7). Where `costly`
  /// leaves them out and no residuals are asked for, their per_test is NaN and the objective that of the others. It is
  /// at most the whole objective, rounding included, since no test costs less than 0 and terms are added in one order.
  Status evaluate(std::span<const double> free, double& objective, std::span<double> per_test,
                  std::span<double> residuals, std::span<double> jacobian, Workspace& workspace,
                  CostlyTests costly = CostlyTests::everywhere) const;

  /// From now on evaluate() in this workspace compares with these values, in the layout of the predictions, instead of
  /// the data: draws of a bootstrap, synthetic data. σ and ranges stay those of the data. Empty = the data again.
  void measure(std::span<const double> values, Workspace& workspace) const;

  /// From now on Jacobians in this workspace may be updates of the last one in the search's memory. The memory then
  /// keeps each new Jacobian, see Differencing::updates. None = differences each time.
  void remember(SecantMemory* memory, Workspace& workspace) const;
  /// What the tests have done so far, one entry a test of the run.
  [[nodiscard]] std::vector<std::pair<std::string, std::vector<Effort>>> efforts() const;

  /// A residual row is r = own e_k − previous e_{k−1}, e = prediction − measured: the transpose of that map, from one
  /// value a residual (priors left out) to one a prediction.
  void transpose_residuals(std::span<const double> by_residual, std::span<double> by_prediction) const;

  /// Calls one test at these parameters; an exception becomes a failure.
  Status ask(std::size_t test, std::span<const double> free,
             const std::function<Status(const Test&, const TestInput&)>& question) const;
  /// Diagnostics of one test at these parameters, name → row values (transverse stretch, iterations).
  Status diagnostics(std::size_t test, std::span<const double> free,
                     std::vector<std::pair<std::string, std::vector<double>>>& rows) const;

 private:
  /// Predictions of one test into `values` and, if wanted, its Jacobian by slots into the workspace, sums done.
  Status predict_test(const RunTest& test, std::span<const double> at, std::span<double> values, bool jacobian,
                      Workspace& workspace) const;
  /// The call into the plugin: parameters filled in, exceptions and non-finite numbers turned into a status.
  Status call(const RunTest& test, std::span<const double> at, std::span<double> values, std::span<double> jacobian,
              Workspace& workspace) const;
  /// Rows of the workspace's Jacobian by free parameter, from differences of `values` (differences.cpp).
  Status difference(const RunTest& test, std::span<const double> at, std::span<const double> values,
                    Workspace& workspace) const;
  /// The same for a test that declares its Differencing: in parallel, or by an update of the search's last Jacobian.
  Status difference_as_stated(const RunTest& test, std::span<const double> at, std::span<const double> values,
                              Workspace& workspace) const;
  /// Where one evaluation writes; empty = not wanted.
  struct Wanted {
    std::span<double> per_test, residuals, jacobian;
  };
  /// Adds the costs of the costly tests, or of the other tests, in order.
  Status add_costs(bool costly, std::span<const double> at, double& total, const Wanted& wanted,
                   Workspace& workspace) const;
  void add_priors(std::span<const double> at, double& total, const Wanted& wanted) const;
  /// The parameters of a test at these free ones, in the workspace.
  TestInput input(const RunTest& test, std::span<const double> at, Workspace& workspace) const;
  /// The place of an entry among a test's values: "channel 'stress', row 12 (stretch 1.8)".
  [[nodiscard]] std::string place(const RunTest& test, std::size_t position) const;

  const Layout& layout_;
  const Models& models_;
  const Constraints& constraints_;
  std::vector<RunTest> tests_;
  std::vector<ChannelObjective> fitted_;  ///< sorted by test
  std::vector<PriorRow> priors_;
};

}  // namespace tunica::assembly
