// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "budget/entrants.hpp"

namespace tunica::budget {

/// One cause more, in the order in which they were added.
struct Step {
  std::string id;  ///< of the mechanism, or "I2 (linear)"
  diagnosis::Place place;
  diagnosis::CauseGroup group = diagnosis::CauseGroup::material;
  bool term = false;
  Belief belief = Belief::plausible;  ///< with all of them fitted
  double share = 0;                   ///< of the misfit that all causes up to this one take
  double shapley = 0;                 ///< of the misfit that it takes, averaged over all orders
  Size rest;                          ///< after it
};

struct Steps {
  std::vector<Step> all;
  std::optional<Mixture> fitted;  ///< all of them; none where there are none
};

/// Causes and terms, each the one that the data say most for beside an unlisted misfit, until the rest is below
/// `tolerance` (share of range), until no further one is worth its price, or four. Once there are two, each makes room
/// for every other lead in turn.
Steps steps_of(const Field& field, const Entrants& entrants, double tolerance);

/// The members of a mixture as steps: first the one that takes most alone, then what takes most beside it, and so on.
std::vector<Step> steps_of(const Field& field, const Mixture& whole);

}  // namespace tunica::budget
