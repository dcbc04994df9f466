// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "assembly/assembly.hpp"

namespace tunica::assembly {

/// The stand-in of a test with all its options, see TestFactory::stand_in; none if it has no stand-in. Throws
/// InputError if the plugin's answer is unusable.
std::optional<StandIn> stand_in(const experiment::TestEntry& test, const plugins::Catalogue& catalogue);

/// The run with each test replaced by its cheaper stand-in, if it has one, see TestFactory::stand_in; none if the run
/// has no costly test. Data, weights, parameters, constraints and residuals are those of `full`.
///
/// Throws InputError if a costly test has no stand-in, or if the stand-in does not match the test. `label` names the
/// run.
std::unique_ptr<Assembly> make_guide(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                                     const std::string& label, const plugins::Catalogue& catalogue,
                                     const Assembly& full);

}  // namespace tunica::assembly
