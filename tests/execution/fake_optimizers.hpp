// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

/// Optimisers small enough to reason about:
///
///   walk      random points from the seed in batches of 8, until it is stopped; never converges
///   compass   from problem.start(), tries ± a step along each axis and halves it; converges
///   residual  needs residuals; linearises at the start, and returns
///   descent   the same, and meets constraints
///   thrower   evaluates the start and throws
///   narrow    searches two parameters at most
namespace tunica::fakes {

void register_optimizers(plugins::Catalogue::Registration& stage);
/// The fakes of tests/calibration and these.
plugins::Catalogue full_catalogue();

/// An entry of `optimizers`, named like its type.
experiment::OptimizerEntry optimizer_entry(const std::string& type);

}  // namespace tunica::fakes
