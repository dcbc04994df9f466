// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "comparison/summary.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::comparison {

/// Throws InputError where the experiment's analysis cannot be made: a parameter that no run searches for, no local
/// optimiser. To be called before anything is searched.
void check_analysis(const execution::Plan& plan, const plugins::Catalogue& catalogue);

/// Makes the experiment's analysis of every run that has a feasible best point: fills in the intervals by profile and
/// by bootstrap and what there is to say of them, and writes
///
///   profile_<parameter>.csv  run, the parameter, Δ(−2 ln L), its threshold, all parameters along the profile
///   bootstrap.csv            run, draw, status, objective, parameters of every draw
///
/// Side by side within the threads of the calling arena, the same for any number of them. Once `interrupted` returns
/// true it ends without writing.
void analyse(const execution::Plan& plan, const plugins::Catalogue& catalogue, const std::filesystem::path& directory,
             const std::function<bool()>& interrupted, const Told& told, Summary& summary);

}  // namespace tunica::comparison
