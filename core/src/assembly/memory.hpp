// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "data/loading_path.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"
#include "tunica/mechanism.hpp"

/// Which tests of a run have to do with the past, and what is known of it.
namespace tunica::assembly {

/// A test of a run, and why the past of its rows is not known.
struct TestPast {
  std::string test;
  data::Past past;
};

/// The tests of the run whose past is not known.
std::vector<TestPast> unknown_pasts(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                                    const plugins::Catalogue& catalogue);

/// Whether a row of what the mechanism makes depends on the rows before it.
bool has_memory(const MechanismFactory& mechanism);

/// The models that a test is made of: that of the run, or those of its layers.
std::vector<std::string> models_of_test(const experiment::TestEntry& test, const experiment::RunEntry& run);

/// Whether a model of the test, or a mechanism of either, has memory.
bool has_memory(const experiment::Experiment& experiment, const experiment::TestEntry& test,
                const experiment::RunEntry& run, const plugins::Catalogue& catalogue);

/// "nobody says in which order the rows of 'tube' were measured; add "order": "loading" to their data, or map a time
/// column", of all these tests.
std::string words_of(const std::vector<TestPast>& pasts);

/// What is taken for the past of tests in which something has memory: one sentence; empty for no tests.
std::string assumption_words(const std::vector<TestPast>& pasts);

}  // namespace tunica::assembly
