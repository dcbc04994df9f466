// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "plugins/catalogue.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::uncertainty {

/// A sum of squares (or of norms) to be minimised again and again near a known optimum: on other data, or with other
/// weights. `evaluate` takes free parameter values in base units, like Evaluator::evaluate; its Jacobian is by them.
struct RefitObjective {
  std::vector<ResidualBlock> blocks;
  std::size_t residual_count = 0;
  std::function<Status(std::span<const double> free, double& objective, std::span<double> residuals,
                       std::span<double> jacobian, assembly::Workspace& workspace)>
      evaluate;
};

/// The optimiser of refits.
struct LocalOptimizer {
  const plugins::Catalogue::Entry<OptimizerFactory>* plugin = nullptr;
  Options options;
};

struct Refit {
  Status status;             ///< of the best point; failed where none could be evaluated
  std::vector<double> free;  ///< base units
  double objective = 0;
  std::uint64_t evaluations = 0;
  bool converged = false;
};

/// One minimisation from `start` (base units), within the bounds and constraints of the assembly; with `held` that
/// parameter keeps its value at the start. Deterministic given the seed; may be called side by side, each call with a
/// workspace of its own. A plugin that throws makes the refit a failed one, as a failed evaluation would.
Refit refit(const assembly::Assembly& assembly, const RefitObjective& target, const LocalOptimizer& optimizer,
            std::span<const double> start, std::optional<std::size_t> held, std::uint64_t seed,
            assembly::Workspace& workspace);

/// Evaluations after which a refit ends: far more than a local search needs.
constexpr std::uint64_t refit_evaluations = 2000;

}  // namespace tunica::uncertainty
