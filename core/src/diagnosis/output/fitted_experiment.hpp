// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "experiment/experiment.hpp"

namespace tunica::diagnosis {

/// The experiment with its parameters at these values and one run of whitened least squares, as extended.json has it.
/// `optimizer` is the requested one; without one it is Levenberg–Marquardt, which converges at once from fitted values.
experiment::Experiment fitted_experiment(experiment::Experiment experiment, experiment::RunEntry run,
                                         const assembly::Assembly& assembly, std::span<const double> free,
                                         const std::string& optimizer, const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
