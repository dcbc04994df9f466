// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "execution/plan.hpp"
#include "text/codes.hpp"

namespace tunica::comparison {

struct RunSummary;

/// The outcome of a run, by evidence and not only by the optimiser's claim.
enum class Ending {
  no_result,      ///< nothing could be evaluated
  infeasible,     ///< the best point breaks a constraint
  refuted,        ///< a fresh process did not find the objective again
  mostly_failed,  ///< more than half of the evaluations failed
  not_an_optimum,
  not_a_fit,         ///< every fitted curve lies farther from its data than their mean does
  not_converged,     ///< the optimiser came back without having converged
  at_target,         ///< the search was to stop there
  short_of_optimum,  ///< a limit of the search ended it, and a better point is near
  at_limit,          ///< a limit of the search ended it, and no neighbour is better by what matters
  misses,            ///< at rest, and some fitted curve lies farther from its data than their mean does
  converged,
};

inline constexpr text::Codes<Ending, 12> ending_codes{{
    {Ending::no_result, "no_result"},
    {Ending::infeasible, "infeasible"},
    {Ending::refuted, "refuted"},
    {Ending::mostly_failed, "mostly_failed"},
    {Ending::not_an_optimum, "not_an_optimum"},
    {Ending::not_a_fit, "not_a_fit"},
    {Ending::not_converged, "not_converged"},
    {Ending::at_target, "at_target"},
    {Ending::short_of_optimum, "short_of_optimum"},
    {Ending::at_limit, "at_limit"},
    {Ending::misses, "misses"},
    {Ending::converged, "converged"},
}};

/// By which the program returns 0: from at_target on. A limit that the file states is an end that it asks for.
constexpr bool succeeded(Ending ending) { return ending >= Ending::at_target; }

/// The key of the experiment file that raises the limit which ended a search, and its value.
struct SearchLimit {
  std::string key, value;
};

/// Of the stop block, of a stage's own, or an option of the optimiser that its reason names.
std::optional<SearchLimit> limit_of(const execution::PlannedRun& run, const RunSummary& summary);

Ending ending_of(const RunSummary& run);

/// "converged: it met a tolerance", "not converged: …; max_iterations (2) ended it: raise it to search on".
std::string words_on_ending(const RunSummary& run);

}  // namespace tunica::comparison
