// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "assembly/binding.hpp"
#include "assembly/composition.hpp"
#include "assembly/constraint.hpp"
#include "assembly/layout.hpp"
#include "assembly/models.hpp"
#include "assembly/objective.hpp"
#include "assembly/run_test.hpp"
#include "assembly/states.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::assembly {

/// The pieces of an Assembly.
struct Parts {
  Layout layout;
  std::vector<RunModel> models;
  std::vector<Strip> strips;
  double largest_stretch = 1;
  std::vector<ModelConstraint> constraints;
  std::vector<RunTest> tests;
  std::vector<ChannelObjective> fitted;
  std::vector<PriorRow> priors;
};

/// Makes the parts of one run in steps. It composes models and tests, binds their parameters, and then lays out the
/// tests and their channels in order.
class Builder {
 public:
  Builder(const experiment::Experiment& experiment, const experiment::RunEntry& run,
          const plugins::Catalogue& catalogue)
      : experiment_(experiment), run_(run), catalogue_(catalogue) {}

  Parts build();

 private:
  void compose();
  void add_state(const experiment::StateEntry& state, std::size_t models);
  void bind();
  void add_test(std::size_t number);
  /// The fitted rows of the channels of a test as blocks of the objective.
  void add_blocks(std::size_t number, const data::Dataset& dataset, std::vector<MeasuredChannel>& channels);
  void add_priors();
  void add_constraints();

  const experiment::Experiment& experiment_;
  const experiment::RunEntry& run_;
  const plugins::Catalogue& catalogue_;
  Parts parts_;
  std::vector<std::vector<Slot>> slots_;               ///< of the models in every state, then of the tests
  std::deque<experiment::ParameterSetting> settings_;  ///< of parameters that differ in a state
  std::vector<ComposedTest> composed_;
  std::vector<ParameterVector> vectors_;            ///< as the slots
  std::vector<std::string> states_without_effect_;  ///< sentences
  std::vector<std::string> unstated_;               ///< least squares: the source of each channel's weight
};

}  // namespace tunica::assembly
