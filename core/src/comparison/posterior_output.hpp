// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "comparison/summary.hpp"
#include "posterior/posterior.hpp"

namespace tunica::comparison {

/// Puts quantiles, bands and what a reader of them must know into the summary of a run: what is not known of the noise,
/// an objective that is no likelihood, simulations that failed. Warns of chains that disagree, and of limits elsewhere
/// than those of the linearised interval by more than half of its half width.
void add_posterior(const assembly::Assembly& assembly, const posterior::Posterior& made, RunSummary& summary,
                   std::vector<execution::Warning>& warnings);

/// posterior_<run>.json: {"posterior": {parameter: chains × draws}, "sample_stats": {"lp": …, "acceptance_rate": …}},
/// in base units, as arviz.from_json() reads it. Returns its name.
std::string write_posterior(const std::filesystem::path& directory, const assembly::Assembly& assembly,
                            const posterior::Posterior& made, const std::string& label);

}  // namespace tunica::comparison
