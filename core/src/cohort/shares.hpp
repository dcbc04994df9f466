// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cohort/fitting.hpp"
#include "execution/share.hpp"

namespace tunica::cohort {

/// Of the specimens of the table.
using execution::parse_share;
using execution::Share;

struct ShareOutcome {
  std::size_t specimens = 0;  ///< of the share
  std::size_t fitted = 0;     ///< now, or before from the same inputs
  bool interrupted = false;
};

/// Fits the specimens of a share side by side; those that have a record of the same inputs are not fitted again. May be
/// repeated and killed at will. `told` is called by any thread after each.
ShareOutcome fit_share(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                       const plugins::Catalogue& catalogue, const FitSettings& settings, const Share& share,
                       const std::function<void(std::size_t done, std::size_t of)>& told = {});

}  // namespace tunica::cohort
