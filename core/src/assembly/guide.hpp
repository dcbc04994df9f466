// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "assembly/assembly.hpp"

namespace tunica::assembly {

/// What stands in for a test, with all of its options, see TestFactory::stand_in; none where nothing does. Throws
/// InputError where the plugin's answer cannot be used.
std::optional<StandIn> stand_in(const experiment::TestEntry& test, const plugins::Catalogue& catalogue);

/// The run with each test replaced by the cheaper one that stands in for it, if any, see TestFactory::stand_in; none
/// where the run has no costly test. Data, weights, parameters, constraints and residuals are those of `full`.
///
/// Throws InputError where a costly test has no stand-in, or where one cannot take its place. `label` names the run.
std::unique_ptr<Assembly> make_guide(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                                     const std::string& label, const plugins::Catalogue& catalogue,
                                     const Assembly& full);

}  // namespace tunica::assembly
