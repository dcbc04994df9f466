// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "assembly/models.hpp"
#include "assembly/parameter_vector.hpp"
#include "experiment/experiment.hpp"
#include "tunica/test.hpp"

namespace tunica::assembly {

/// One test of the run, with everything that can be computed before an evaluation.
struct RunTest {
  std::string name;
  std::unique_ptr<Test> test;
  const Model* model = nullptr;          ///< of the first layer, where there are several
  std::vector<const Model*> layers;      ///< empty = `model` alone
  std::vector<std::string> layer_names;  ///< of their models in the file
  ParameterVector materials;             ///< the parameters of its models, layer after layer
  std::size_t rows = 0, channels = 0;
  std::size_t offset = 0;    ///< of its rows among all predictions, channel after channel
  ParameterVector own;       ///< the test's parameter vector
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

/// Gives a test its models, in its state: the model of the run, or one per layer. Layers that share a model have one
/// copy of its parameters each. The order of models is the same in every state.
void assign_models(RunTest& test, const experiment::TestEntry& entry, const std::vector<RunModel>& models);

/// Fills the chain rule after models and own parameters are set.
void chain_parameters(RunTest& test, std::size_t free_count);

}  // namespace tunica::assembly
