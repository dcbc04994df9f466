// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "calibration/assembly.hpp"
#include "calibration/binding.hpp"
#include "calibration/objective.hpp"
#include "tunica/model.hpp"
#include "tunica/test.hpp"

namespace tunica::calibration {

/// One model of the run, with its mechanisms.
struct BoundModel {
  std::string name, plugin;
  std::unique_ptr<Model> model;
  Bound parameters;
};

/// One test of the run, with everything an evaluation needs worked out beforehand.
struct BoundTest {
  std::string name, plugin, model_plugins;
  std::unique_ptr<Test> test;
  const Model* model = nullptr;      ///< of the first layer, where there are several
  std::vector<const Model*> layers;  ///< empty = `model` alone
  Bound materials;                   ///< the parameters of its models, layer after layer
  std::size_t rows = 0, channels = 0;
  std::size_t offset = 0;    ///< of its rows among all predictions, channel after channel
  Bound own;                 ///< the test's parameter vector
  bool differenced = false;  ///< the host takes differences of whole predictions
  bool costly = false;       ///< simulated last

  // The chain rule from slots (parameters of the models, then the test's) to free parameters. A test's Jacobian holds
  // one row of values per slot; rows of slots that share a free parameter are summed into the first of them.
  std::vector<std::pair<std::size_t, std::size_t>> sums;     ///< {into, from}
  std::vector<std::pair<std::size_t, std::size_t>> columns;  ///< {free parameter, row of the test's Jacobian}
  std::vector<std::size_t> untouched;                        ///< free parameters that the test does not depend on

  [[nodiscard]] std::size_t size() const { return rows * channels; }
  [[nodiscard]] std::size_t slots() const { return materials.values.size() + own.values.size(); }
};

/// A prior of a free parameter as a residual (p − mean)/sd.
struct PriorRow {
  std::size_t index;
  double mean, sd;
};

/// Unit box ↔ parameter: p = min + x·span, or p = exp(log_min + x·log_span).
struct Map {
  double min, max, log_min, log_span;
  bool logarithmic;
};

struct Assembly::Parts {
  std::vector<BoundModel> models;
  std::vector<BoundTest> tests;
  std::vector<FreeParameter> free;
  std::vector<FixedParameter> fixed;
  std::vector<Map> maps;
  std::vector<ChannelView> channels;
  std::vector<FittedChannel> fitted;
  std::vector<PriorRow> priors;
  std::vector<ResidualBlock> blocks;
  std::vector<Combination> combinations;
  std::vector<Strip> strips;
  double largest_stretch = 1;
  std::vector<ModelConstraint> constraints;
  std::size_t constraint_count = 0;
  std::vector<std::string> warnings, data_hashes;
  std::size_t prediction_count = 0, residual_count = 0;

  /// Predictions of one test into `values` and, if wanted, its Jacobian by slots into the workspace, sums done.
  Status predict(const BoundTest& test, std::span<const double> at, std::span<double> values, bool jacobian,
                 Workspace& workspace) const;
  /// The call into the plugin: parameters filled in, exceptions and non-finite numbers turned into a status.
  Status call(const BoundTest& test, std::span<const double> at, std::span<double> values, std::span<double> jacobian,
              Workspace& workspace) const;
  /// Rows of the workspace's Jacobian by free parameter, from differences of `values` (differences.cpp).
  Status difference(const BoundTest& test, std::span<const double> at, std::span<const double> values,
                    Workspace& workspace) const;
  /// Where one evaluation writes; empty = not wanted.
  struct Wanted {
    std::span<double> per_test, residuals, jacobian;
  };
  /// Adds what the tests cost that are costly, or those that are not, one after the other.
  Status add_costs(bool costly, std::span<const double> at, double& total, const Wanted& wanted,
                   Workspace& workspace) const;
  void add_priors(std::span<const double> at, double& total, const Wanted& wanted) const;
  /// Infeasible where a constraint is broken by more than the tolerance.
  Status feasibility(std::span<const double> at, Workspace& workspace) const;
  /// What is broken, with the model's name where there are several.
  [[nodiscard]] std::string words(const ModelConstraint& constraint, std::size_t i, double value) const;
  /// The parameters of a test at these free ones, in the workspace.
  TestInput input(const BoundTest& test, std::span<const double> at, Workspace& workspace) const;
  /// Where among a test's values something lies: "channel 'stress', row 12 (stretch 1.8)".
  [[nodiscard]] std::string place(const BoundTest& test, std::size_t position) const;
};

class Assembly::Workspace {
 public:
  explicit Workspace(const Parts& parts);
  std::vector<std::vector<double>> model_parameters;  ///< by model
  std::vector<std::vector<double>> materials, own;    ///< by test: parameters of its models, and of its own
  std::vector<double> predictions;                    ///< all
  std::vector<double> jacobian;                       ///< of one test by slots, large enough for each
  std::vector<double> ahead, behind, shifted;         ///< for differences
  std::vector<double> constraints;                    ///< values
  std::vector<std::vector<double>> measured;          ///< by fitted channel, in place of the data; empty = the data
};

}  // namespace tunica::calibration
