// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::ceres_lm {

/// Bounded Levenberg–Marquardt (Ceres) from the problem's start and from points spread over the box.
///
/// The starts are independent and run through for_each_start. One that cannot be evaluated is replaced by a new
/// point. With screening every start first gets a few iterations, and only the best are continued.
class MultiStart : public Optimizer {
 public:
  explicit MultiStart(const Settings& settings) : settings_(settings) {}

  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override;

 private:
  Settings settings_;
  Needs needs_{.residuals = true, .gradient = true, .constraints = true, .random = true, .infeasible = true};
};

}  // namespace tunica::ceres_lm
