// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "data/loading_path.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"
#include "tunica/mechanism.hpp"

/// The tests of a run that depend on the loading history, and what is known of that history.
namespace tunica::assembly {

/// A test of a run, and the reason why the history of its rows is unknown.
struct TestPast {
  std::string test;
  data::Past past;
};

/// The tests of the run whose history is unknown.
std::vector<TestPast> unknown_pasts(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                                    const plugins::Catalogue& catalogue);

/// Whether a row depends on earlier rows under the mechanism.
bool has_memory(const MechanismFactory& mechanism);

/// The models of a test: that of the run, or those of its layers.
std::vector<std::string> models_of_test(const experiment::TestEntry& test, const experiment::RunEntry& run);

/// Whether a model of the test, or a mechanism of the test or its models, has memory.
bool has_memory(const experiment::Experiment& experiment, const experiment::TestEntry& test,
                const experiment::RunEntry& run, const plugins::Catalogue& catalogue);

/// "nobody says in which order the rows of 'tube' were measured; add "order": "loading" to their data, or map a time
/// column", of all these tests.
std::string words_of(const std::vector<TestPast>& pasts);

/// One sentence on tests with memory that begin under load where the clock has run before: which ramp is assumed, and
/// what to do where the load came otherwise. `sought`: whatever the model, as memory is looked for. Empty for no tests.
std::string ramp_words(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                       const plugins::Catalogue& catalogue, bool sought = false);

/// One sentence on the assumed history of tests with memory; empty for no tests.
std::string assumption_words(const std::vector<TestPast>& pasts);

}  // namespace tunica::assembly
