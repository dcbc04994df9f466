// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::es {

/// (μ/ρ +, λ) evolution strategy with self-adapted steps and, by default, self-adapted covariance.
///
/// A generation: λ offspring, each a recombinant of the parents plus a mutation, are evaluated in one batch; the best
/// μ of parents and offspring (plus) or of the offspring (comma) are the next parents. A search that has converged
/// or stalled is followed by a restart from new random points. Failed evaluations rank last and are never parents.
class EvolutionStrategy : public Optimizer {
 public:
  explicit EvolutionStrategy(const Settings& settings) : settings_(settings) {}

  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override;

 private:
  Settings settings_;
  Needs needs_{.constraints = true, .batch = true, .random = true};
};

}  // namespace tunica::es
