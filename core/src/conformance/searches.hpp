// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "conformance/function_problem.hpp"
#include "conformance/optimizer_properties.hpp"

namespace tunica::conformance {

/// One search of the candidate.
inline Optimizer::Outcome search(const Candidate& candidate, FunctionProblem& problem) {
  return candidate.make()->minimise(problem);
}

/// At most as many parameters as the optimiser can search.
inline std::size_t dimensions(const Candidate& candidate, std::size_t wanted) {
  return std::min(wanted, candidate.make()->needs().most_parameters);
}

inline std::string ended(const Optimizer::Outcome& outcome) {
  return outcome.reason.empty() ? " (it gave no reason for ending)" : " (it ended with '" + outcome.reason + "')";
}

}  // namespace tunica::conformance
