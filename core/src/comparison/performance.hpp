// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// One optimizer over all problems it was run on: a distribution function as steps (x, share solved up to x).
struct ProfileCurve {
  std::string optimizer;  ///< a second run of one optimizer on the same problem is "es#2"
  std::size_t problems = 0;
  std::vector<std::pair<double, double>> steps;
};

/// How often optimizers succeed, and how soon, over problems (success.hpp) that weigh the same each.
struct Profiles {
  /// Share of realisations that succeeded within τ times the least expected running time of any optimizer on the
  /// problem; the first step is at τ = 1. With one realisation each this is the performance profile of E. D. Dolan,
  /// J. J. Moré, Math. Program. 91:201 (2002).
  std::vector<ProfileCurve> performance;
  /// Share of realisations that succeeded within so many evaluations, counted in units of n + 1 for n free parameters
  /// (J. J. Moré, S. M. Wild, SIAM J. Optim. 20:172, 2009).
  std::vector<ProfileCurve> data;
};
Profiles profiles(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                  const std::vector<RunSummary>& runs);

}  // namespace tunica::comparison
