// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::nlopt_plugin {

/// Algorithms of NLopt. A global one searches the box, again from other random numbers when it stalls; a local one
/// starts from the problem's start and from random points, side by side, those that cannot be evaluated replaced.
class NloptOptimizer : public Optimizer {
 public:
  explicit NloptOptimizer(const Settings& settings);

  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override;

 private:
  Outcome minimise_globally(Problem& problem) const;
  Outcome minimise_from_starts(Problem& problem) const;

  Settings settings_;
  Needs needs_;
};

}  // namespace tunica::nlopt_plugin
