// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "budget/budget.hpp"

namespace tunica::budget {

inline constexpr double most_of_it = 0.5;   ///< of the misfit: what leads takes so much at least
inline constexpr double ahead = 0.15;       ///< of the misfit: of the next cause that is another one
inline constexpr double sure_enough = 0.9;  ///< probability, with "no listed cause" among the rivals
/// Of "no listed cause", where the causes that are listed are sure among themselves: what leads then says so.
inline constexpr double may_be_unlisted = 0.75;

/// What the contenders allow to say: `leading`, `indistinguishable` or `unknown`.
struct Decision {
  diagnosis::Verdict verdict = diagnosis::Verdict::unknown;
  std::vector<const Contender*> first;  ///< what leads, or is about as good; best first
};

/// The rules of docs/diagnosis.md, "What leads", over contenders, steps and tolerance of a budget, which outlives the
/// answer.
Decision decided(const Budget& budget);

}  // namespace tunica::budget
