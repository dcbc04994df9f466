// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cohort/fitting.hpp"

namespace tunica::cohort {

/// Part k of N of the specimens: every N-th of the table, from the k-th. Parts are disjoint and together all, and what
/// a specimen gives does not depend on the part it is in.
struct Share {
  std::size_t part = 1, of = 1;

  [[nodiscard]] bool holds(std::size_t specimen) const { return specimen % of == part - 1; }
};

/// "2/7". Throws InputError.
Share parse_share(const std::string& text);

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
